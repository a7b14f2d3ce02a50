#include "benchmarks/harness/study_verb.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/breakdowns.hpp"
#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/harness/output_folder.hpp"
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
#include "common/parallel/thread_count.hpp"
#include "common/run/case_reader.hpp"
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
  OutputFolder output(request.directory, cases.front(), OutputKind::stability, request.force);
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
  output.prepare();
  write(request, "stability.csv", stability_csv(limits));
}

namespace {

/// A run that was finished before, whose times are those of this machine.
std::optional<io::RunSummary> timed_before(const run::Case& setup, const RunOptions& options) {
  const auto finished = finished_run(setup, options);
  if (!finished) return std::nullopt;
  const io::RunSummary& run = finished->summary;
  const bool same = run.threads == parallel::running_threads() &&
                    run.provenance.cpu == provenance(setup.hash).cpu;
  return same ? std::optional(run) : std::nullopt;
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

/// Curves that grow level by level, and what broke down on the way.
struct Measurement {
  const StudyRequest& request;
  const std::vector<run::Case>& cases;
  OutputFolder& output;
  std::vector<WorkCurve> curves;
  std::vector<report::Breakdown> breakdowns;
  std::string field;
  int n_taken_over = 0;

  const run::Case& case_of(size_t curve) const { return cases[curve / request.methods.size()]; }
};

/// Adds a repetition of one level to a curve, unless the first one broke down.
void add_run(Measurement& all, size_t curve, const RunOptions& options) {
  const run::Case& setup = all.case_of(curve);
  std::vector<WorkPoint>& points = all.curves[curve].points;
  const bool has_level = !points.empty() && points.back().run.level == options.level;
  const auto before = all.request.fresh ? std::nullopt : timed_before(setup, options);
  if (before) ++all.n_taken_over;
  const io::RunSummary run = before ? *before : attempt_case(setup, options).summary;
  if (interrupt_requested()) return;
  if (all.field.empty()) all.field = field_of(all.request, run);
  if (run.status == "breakdown") {
    all.breakdowns.push_back(breakdown_of(run));
    const std::string& variant = all.curves[curve].variant;
    std::string& message = all.breakdowns.back().message;
    if (!variant.empty()) message = variant + ": " + message;
  } else if (!has_level) {
    points.push_back({run, run.loop_seconds, run.loop_seconds, setup.scheme.face_correction});
  } else {
    WorkPoint& point = points.back();
    point.most = std::max(point.most, run.loop_seconds);
    if (run.loop_seconds < point.least) {
      point.least = run.loop_seconds;
      point.run = run;
    }
  }
}

/// One repetition of one level of all curves; those that broke down in the first one are left out.
void repeat(Measurement& all, RunOptions options, int repetition, StatusLine& status) {
  const std::filesystem::path runs = std::filesystem::path(all.request.directory) / "runs";
  for (size_t i = 0; i < all.curves.size() && !interrupt_requested(); ++i) {
    const std::vector<WorkPoint>& points = all.curves[i].points;
    if (repetition > 0 && (points.empty() || points.back().run.level != options.level)) continue;
    options.method = all.curves[i].method;
    status.show(fmt::format("{} level {}, repetition {} of {}", all.curves[i].name(), options.level,
                            repetition + 1, all.request.repeats));
    // the very first run tells whether what was asked makes sense: nothing is written before
    if (!all.field.empty()) {
      options.directory = (runs / fmt::format("{}_{}_level_{}_{}", input_hash(all.case_of(i), {}),
                                              options.method, options.level, repetition + 1))
                              .string();
    }
    add_run(all, i, options);
    if (!interrupt_requested()) all.output.prepare();  // nothing is wrong with what was asked
  }
}

/// All levels of all curves. The first run, the shortest, sets the field and makes the folder.
void measure(Measurement& all) {
  const StudyRequest& request = all.request;
  StatusLine status(request.quiet);
  RunOptions options;
  options.threads = request.threads;
  options.fields = false;
  options.quiet = request.quiet;
  for (options.level = request.level; options.level < request.level + request.n_levels;
       ++options.level) {
    for (int repetition = 0; repetition < request.repeats; ++repetition) {
      repeat(all, options, repetition, status);
      if (interrupt_requested()) return;
    }
    status.keep(fmt::format("level {} done: {} runs, {} of them taken over", options.level,
                            request.repeats * static_cast<int>(all.curves.size()),
                            all.n_taken_over));
    all.n_taken_over = 0;
  }
}

}  // namespace

std::vector<report::Breakdown> study_work_precision(const StudyRequest& request) {
  if (request.n_levels < 1) throw base::InputError("--levels must be 1 or more");
  if (request.repeats < 1) throw base::InputError("--repeats must be 1 or more");
  std::vector<run::Case> cases;
  std::vector<WorkCurve> curves;
  for (const Variant& variant : variants_of(request.variations)) {
    cases.push_back(case_of_variant(request.case_file, request.overrides, variant));
    for (const std::string& method : request.methods)
      curves.push_back({variant.label, method, {}});
  }
  const run::Case base_case = run::read_case(request.case_file, request.overrides);
  OutputFolder output(request.directory, base_case, OutputKind::study, request.force);
  Measurement all{request, cases, output, curves, {}, "", 0};
  try {
    measure(all);
  } catch (const base::Interruption&) {
    // while a mesh was made: what was finished before stands
  }
  std::erase_if(all.curves, [](const WorkCurve& curve) { return curve.points.empty(); });
  const std::string broken = breakdown_table(all.breakdowns);
  if (all.curves.empty()) {  // interrupted in the first run, or all broke down
    print(broken);
    return all.breakdowns;
  }
  const auto machine = probes::measure_machine(request.threads);
  const std::string title =
      fmt::format("Work and precision: {}",
                  cases.front().title.empty() ? cases.front().name : cases.front().title);
  print(cases.front().name + "\n" + work_precision_table(all.curves, all.field, machine) + broken);
  write(request, "work_precision.csv", work_precision_csv(all.curves));
  write(request, "work_precision.html", work_precision_html(title, all.curves, all.field, machine));
  return all.breakdowns;
}

}  // namespace diptych::harness
