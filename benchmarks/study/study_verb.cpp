#include "benchmarks/study/study_verb.hpp"

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/run/scene.hpp"
#include "benchmarks/study/variant_quantities.hpp"
#include "benchmarks/study/variants.hpp"
#include "benchmarks/study/work_precision.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/time/integrator.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// All are read, and what they ask of the machine is known, before the first is run.
std::vector<cases::Case> cases_of(const StudyRequest& request,
                                  const std::vector<Variant>& variants) {
  std::vector<cases::Case> cases;
  for (const Variant& variant : variants)
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
  for (const cases::Case& setup : cases)
    require_memory(setup, request.run.methods, request.run.levels);
  return cases;
}

/// Limits of one variant with one method, integrator by integrator.
void add_limits(const StudyRequest& request,
                const cases::Case& setup,
                const std::string& label,
                const std::string& method,
                StatusLine& status,
                std::vector<StabilityLimit>& limits) {
  const scheme::PairGraph graph = graph_of(setup, method, request.run.levels.front()).graph;
  for (const std::string& integrator : request.integrators) {
    const std::string name =
        fmt::format("{}{}{} {}", label, label.empty() ? "" : " ", method, integrator);
    int n_trials = 0;
    status.show(name + ": first trial");
    StabilityLimit limit = stability_limit(
        setup, graph, integrator, request.stability, [&](double cfl, const StabilityTrial& trial) {
          status.show(fmt::format("{}: trial {}, cfl {:.3f} is {}", name, ++n_trials, cfl,
                                  trial.stable ? "stable" : "unstable"));
        });
    if (interrupt_requested()) return;
    limit.variant = label;
    limit.method = method;
    status.keep(limit.limit > 0 ? fmt::format("{}: largest stable cfl {:.3f}", name, limit.limit)
                                : fmt::format("{}: no stable cfl", name));
    limits.push_back(limit);
  }
}

}  // namespace

void study_stability(const StudyRequest& asked) {
  StudyRequest request = asked;
  if (!request.run.resume) {
    throw base::InputError(
        "--fresh has no effect with --stability, which keeps no runs; remove it");
  }
  if (!request.quantities.empty()) {
    throw base::InputError(
        "--quantity has no effect with --stability, which shows limits; remove it");
  }
  if (!request.run.variants.empty()) {
    throw base::InputError(
        "--with has no effect with --stability; --vary gives the limits of variants");
  }
  if (request.integrators.empty()) request.integrators = time::integrator_menu().names();
  for (const std::string& integrator : request.integrators)
    time::integrator_menu().at(integrator);
  if (request.stability.n_steps < 40) throw base::InputError("--steps must be 40 or more");
  const auto variants = variants_of(request.variations);
  const auto cases = cases_of(request, variants);
  OutputFolder output(request.run.directory, cases.front(), OutputKind::stability,
                      request.run.force);
  parallel::set_threads(request.run.threads);
  std::vector<StabilityLimit> limits;
  StatusLine status(request.run.quiet);
  for (size_t i = 0; i < variants.size(); ++i) {
    for (const std::string& method : request.run.methods) {
      if (interrupt_requested()) break;
      add_limits(request, cases[i], variants[i].label, method, status, limits);
    }
  }
  print(fmt::format("{}, level {}: largest stable time step, as a factor on the graph bound\n",
                    cases.front().name, request.run.levels.front()));
  print(stability_table(limits));
  output.prepare();
  write_output(request.run.directory, "stability.csv", stability_csv(limits));
}

namespace {

/// What holds for a study whatever the case has. @return with its defaults
StudyRequest checked(StudyRequest request, const cases::Case& setup) {
  if (request.repeats == StudyRequest::by_default) request.repeats = has_exact(setup) ? 3 : 1;
  if (request.repeats < 1) throw base::InputError("--repeats must be 1 or more");
  if (!has_exact(setup) && !request.field.empty()) {
    throw base::InputError(setup.name +
                           " has no exact solution to measure errors against: --field has no "
                           "effect; --quantity chooses what is shown");
  }
  return request;
}

void show_errors(const StudyRequest& request, const cases::Case& setup, const StudyRuns& runs) {
  const auto machine = probes::measure_machine(request.run.threads);
  const std::string title =
      fmt::format("Work and precision: {}", setup.title.empty() ? setup.name : setup.title);
  print(setup.name + "\n" + work_precision_table(runs.curves, runs.field, machine));
  write_output(request.run.directory, "work_precision.csv", work_precision_csv(runs.curves));
  write_output(request.run.directory, "work_precision.html",
               work_precision_html(title, runs.curves, runs.field, machine));
}

/// Variants of either method that share a name share a row.
std::vector<Variant> one_of_each_label(const std::vector<Variant>& variants) {
  std::vector<Variant> rows;
  for (const Variant& variant : variants) {
    const bool is_there = std::any_of(
        rows.begin(), rows.end(), [&](const Variant& row) { return row.label == variant.label; });
    if (!is_there) rows.push_back(variant);
  }
  return rows;
}

void show_quantities(const StudyRequest& request,
                     const cases::Case& setup,
                     const std::vector<Variant>& variants,
                     const StudyRuns& runs) {
  const VariantStudy study{runs.curves, one_of_each_label(variants),
                           chosen_quantities(setup, request.quantities, runs)};
  const std::string title =
      fmt::format("Quantities: {}", setup.title.empty() ? setup.name : setup.title);
  print(fmt::format("{}{}: quantities of each variant, method and level\n",
                    has_exact(setup) ? "\n" : "", setup.name));
  print(quantities_table(study));
  write_output(request.run.directory, "quantities.csv", quantities_csv(study));
  write_output(request.run.directory, "quantities.html", quantities_html(title, study));
}

}  // namespace

StudyRuns study_variants(const StudyRequest& asked) {
  auto variants = variants_of(asked.variations);
  for (Variant& one : variants_of_columns(asked.run.variants))
    variants.push_back(std::move(one));
  const auto cases = cases_of(asked, variants);
  const cases::Case& setup = cases.front();
  const StudyRequest request = checked(asked, setup);
  check_quantities(setup, request.quantities);
  const cases::Case base_case = harness::read_case(request.case_file, request.overrides);
  OutputFolder output(request.run.directory, base_case, OutputKind::study, request.run.force);
  const StudyRuns runs = runs_of_study(request, variants, cases, output);
  if (!runs.curves.empty()) {  // else interrupted in the first run, or all broke down
    if (has_exact(setup)) show_errors(request, setup, runs);
    if (!has_exact(setup) || !request.quantities.empty())
      show_quantities(request, setup, variants, runs);
  }
  print(breakdown_table(runs.breakdowns));
  return runs;
}

}  // namespace diptych::harness
