#include "benchmarks/harness/study_verb.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/harness/provenance.hpp"
#include "benchmarks/harness/resumption.hpp"
#include "benchmarks/harness/run_case.hpp"
#include "benchmarks/harness/status_line.hpp"
#include "benchmarks/harness/variants.hpp"
#include "benchmarks/harness/work_precision.hpp"
#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/time/integrator.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace diptych::harness {

namespace {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void write(const StudyRequest& request, const std::string& name, const std::string& text) {
  const std::string file = (std::filesystem::path(request.directory) / name).string();
  io::write_file_atomically(file, text);
  print("output: " + file + "\n");
}

/// Limits of one variant with one method, integrator by integrator.
void add_limits(const StudyRequest& request,
                const run::Case& setup,
                const std::string& label,
                const std::string& method,
                StatusLine& status,
                std::vector<StabilityLimit>& limits) {
  const CaseMesh mesh =
      mesh_of(setup, request.level, std::filesystem::temp_directory_path().string());
  const scheme::PairGraph graph = method_menu().at(method)(mesh.mesh, setup);
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
  if (request.fresh) {
    throw base::InputError(
        "--fresh has no effect with --stability, which keeps no runs; remove it");
  }
  if (request.integrators.empty()) request.integrators = time::integrator_menu().names();
  for (const std::string& integrator : request.integrators)
    time::integrator_menu().at(integrator);
  if (request.stability.n_steps < 40) throw base::InputError("--steps must be 40 or more");
  const auto variants = variants_of(request.variations);
  std::vector<run::Case> cases;  // all are read before the first runs
  for (const Variant& variant : variants)
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
  io::make_directory(request.directory);
  parallel::set_threads(request.threads);
  std::vector<StabilityLimit> limits;
  StatusLine status(request.quiet);
  for (size_t i = 0; i < variants.size(); ++i) {
    for (const std::string& method : request.methods) {
      if (interrupt_requested()) break;
      add_limits(request, cases[i], variants[i].label, method, status, limits);
    }
  }
  print(fmt::format("{}, level {}: largest stable time step, as a factor on the graph bound\n",
                    cases.front().name, request.level));
  print(stability_table(limits));
  write(request, "stability.csv", stability_csv(limits));
}

namespace {

/// A run that was finished before, whose times are those of this machine.
std::optional<io::RunSummary> timed_before(const run::Case& setup, const RunOptions& options) {
  const auto finished = finished_run(setup, options);
  if (!finished) return std::nullopt;
  const io::RunSummary& run = finished->summary;
  const bool same =
      run.threads == parallel::n_threads() && run.provenance.cpu == provenance(setup.hash).cpu;
  return same ? std::optional(run) : std::nullopt;
}

/// Adds a repetition of one level to a curve. @return false after an interrupt
bool add_run(const run::Case& setup,
             const RunOptions& options,
             bool first,
             bool fresh,
             int& n_taken_over,
             WorkCurve& curve) {
  const auto before = fresh ? std::nullopt : timed_before(setup, options);
  if (before) ++n_taken_over;
  const io::RunSummary run = before ? *before : run_case(setup, options).summary;
  if (interrupt_requested()) return false;
  if (first) {
    curve.points.push_back({run, run.loop_seconds, run.loop_seconds, setup.scheme.face_correction});
    return true;
  }
  WorkPoint& point = curve.points.back();
  point.most = std::max(point.most, run.loop_seconds);
  if (run.loop_seconds < point.least) {
    point.least = run.loop_seconds;
    point.run = run;
  }
  return true;
}

/// The field to show: the one asked for, or the first of the case.
std::string field_of(const StudyRequest& request, const io::RunSummary& run) {
  const std::vector<std::string> fields = report::fields_of({run});
  if (fields.empty()) {
    throw base::InputError(run.case_name +
                           " has no exact solution to measure errors against; study a case with "
                           "[exact] or [manufactured]");
  }
  if (request.field.empty()) return fields.front();
  if (std::find(fields.begin(), fields.end(), request.field) == fields.end()) {
    throw base::InputError("--field " + request.field + " is not measured" +
                           base::suggestion(request.field, fields));
  }
  return request.field;
}

/// All levels of all curves. The first run, the shortest, sets the field and makes the folder.
void measure(const StudyRequest& request,
             const std::vector<run::Case>& cases,
             std::string& field,
             std::vector<WorkCurve>& curves) {
  StatusLine status(request.quiet);
  RunOptions options;
  options.threads = request.threads;
  options.fields = false;
  options.quiet = request.quiet;
  const std::filesystem::path runs = std::filesystem::path(request.directory) / "runs";
  int n_taken_over = 0;
  for (options.level = request.level; options.level < request.level + request.n_levels;
       ++options.level) {
    for (int repetition = 0; repetition < request.repeats; ++repetition) {
      for (size_t i = 0; i < curves.size(); ++i) {
        options.method = curves[i].method;
        const run::Case& setup = cases[i / request.methods.size()];
        status.show(fmt::format("{} level {}, repetition {} of {}", curves[i].name(), options.level,
                                repetition + 1, request.repeats));
        // the very first run tells whether what was asked makes sense: nothing is written before
        if (!field.empty()) {
          options.directory = (runs / fmt::format("{}_{}_level_{}_{}", input_hash(setup, {}),
                                                  options.method, options.level, repetition + 1))
                                  .string();
        }
        if (!add_run(setup, options, repetition == 0, request.fresh, n_taken_over, curves[i])) {
          return;
        }
        if (!field.empty()) continue;
        field = field_of(request, curves[i].points.back().run);
        io::make_directory(request.directory);  // now that nothing is wrong with what was asked
      }
    }
    status.keep(fmt::format("level {} done: {} runs, {} of them taken over", options.level,
                            request.repeats * static_cast<int>(curves.size()), n_taken_over));
    n_taken_over = 0;
  }
}

}  // namespace

void study_work_precision(const StudyRequest& request) {
  if (request.n_levels < 1) throw base::InputError("--levels must be 1 or more");
  if (request.repeats < 1) throw base::InputError("--repeats must be 1 or more");
  std::vector<run::Case> cases;
  std::vector<WorkCurve> curves;
  for (const Variant& variant : variants_of(request.variations)) {
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
    for (const std::string& method : request.methods)
      curves.push_back({variant.label, method, {}});
  }
  std::string field;
  measure(request, cases, field, curves);
  curves.erase(std::remove_if(curves.begin(), curves.end(),
                              [](const WorkCurve& curve) { return curve.points.empty(); }),
               curves.end());
  if (curves.empty()) return;  // interrupted in the first run
  const auto machine = probes::measure_machine(request.threads);
  const std::string title =
      fmt::format("Work and precision: {}",
                  cases.front().title.empty() ? cases.front().name : cases.front().title);
  print(cases.front().name + "\n" + work_precision_table(curves, field, machine));
  write(request, "work_precision.csv", work_precision_csv(curves));
  write(request, "work_precision.html", work_precision_html(title, curves, field, machine));
}

}  // namespace diptych::harness
