#include "benchmarks/study/study_verb.hpp"

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/run/run_case.hpp"
#include "benchmarks/study/variant_quantities.hpp"
#include "benchmarks/study/variants.hpp"
#include "benchmarks/study/work_precision.hpp"
#include "benchmarks/terminal/output.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/io/atomic_file.hpp"
#include "common/run/exact_survey.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

std::vector<cases::Case> cases_of_study(const StudyRequest& request,
                                        const std::vector<Variant>& variants) {
  std::vector<cases::Case> cases;
  for (const Variant& variant : variants)
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
  for (const cases::Case& setup : cases)
    require_memory(setup, request.run.methods, request.run.levels);
  return cases;
}

namespace {

/// What holds for a study whatever the case has. @return with its defaults
StudyRequest checked(StudyRequest request, const cases::Case& setup) {
  if (request.repeats == StudyRequest::by_default)
    request.repeats = run::ExactSurvey::is_for(setup) ? 3 : 1;
  if (request.repeats < 1) throw base::InputError("--repeats must be 1 or more");
  if (!run::ExactSurvey::is_for(setup) && !request.field.empty()) {
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
                    run::ExactSurvey::is_for(setup) ? "\n" : "", setup.name));
  print(quantities_table(study));
  write_output(request.run.directory, "quantities.csv", quantities_csv(study));
  write_output(request.run.directory, "quantities.html", quantities_html(title, study));
}

}  // namespace

StudyRuns study_variants(const StudyRequest& asked) {
  auto variants = variants_of(asked.variations);
  for (Variant& one : variants_of_columns(asked.run.variants))
    variants.push_back(std::move(one));
  const auto cases = cases_of_study(asked, variants);
  const cases::Case& setup = cases.front();
  const StudyRequest request = checked(asked, setup);
  check_quantities(setup, request.quantities);
  const cases::Case base_case = harness::read_case(request.case_file, request.overrides);
  OutputFolder output(request.run.directory, base_case, OutputKind::study, request.run.force);
  const StudyRuns runs = runs_of_study(request, variants, cases, output);
  if (!runs.curves.empty()) {  // else interrupted in the first run, or none came to its end
    if (run::ExactSurvey::is_for(setup)) show_errors(request, setup, runs);
    if (!run::ExactSurvey::is_for(setup) || !request.quantities.empty())
      show_quantities(request, setup, variants, runs);
  }
  print(cut_short_table(runs.cut_short, true) + breakdown_table(runs.breakdowns));
  return runs;
}

}  // namespace diptych::harness
