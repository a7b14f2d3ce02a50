#include "benchmarks/study/study.hpp"

#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/run/resumption.hpp"
#include "common/base/text.hpp"
#include "common/cases/reader.hpp"
#include "common/run/field_norms.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Differences of the final states of two runs on the same nodes, relative to the largest norms
/// that errors are relative to as well.
std::map<std::string, double> differences_of(const RunResult& a, const RunResult& b) {
  if (a.final_state.u.empty() || b.final_state.u.empty()) return {};
  auto differences = run::difference_norms(a.graph, a.final_state, b.final_state);
  for (auto& [field, difference] : differences) {
    const double scale = std::max(a.scales.at(field), b.scales.at(field));
    if (scale > 0) difference /= scale;
  }
  return differences;
}

Schedule schedule_of(const cases::Case& setup, const StudyOptions& options) {
  std::vector<PlannedRun> runs;
  for (const int level : options.levels) {
    for (const std::string& method : options.methods)
      runs.push_back({method, method, level, cases::dimension_of(setup.mesh)});
  }
  return Schedule(std::move(runs));
}

std::string run_directory(const StudyOptions& options, int level, const std::string& method) {
  if (options.directory.empty()) return {};
  std::filesystem::path path = options.directory;
  if (options.levels.size() > 1) path /= fmt::format("level_{}", level);
  return (path / method).string();
}

/// What the options ask of one run.
RunOptions run_options(const StudyOptions& options, int level, const std::string& method) {
  RunOptions run;
  run.method = method;
  run.level = level;
  run.threads = options.threads;
  run.directory = run_directory(options, level, method);
  run.fields = options.fields;
  run.quiet = options.quiet;
  run.shapes = options.shapes && level == options.levels.back();
  run.scales = options.methods.size() == 2 && level == options.levels.back();
  return run;
}

void add_run(Study& study,
             const RunOptions& options,
             const io::RunSummary& summary,
             const std::vector<io::HistoryRow>& history,
             const std::vector<io::HistoryColumn>& exact) {
  study.runs.push_back(summary);
  study.directories.push_back(options.directory);
  study.histories[options.method] = history;
  study.exact[options.method] = exact;
}

/// All methods on one level.
void run_level(const cases::Case& setup,
               const StudyOptions& options,
               int level,
               OutputFolder& output,
               Schedule& schedule,
               Study& study) {
  std::vector<RunResult> results;
  for (const std::string& method : options.methods) {
    RunOptions run = run_options(options, level, method);
    if (const auto finished = options.resume ? finished_run(setup, run) : std::nullopt) {
      add_run(study, run, finished->summary, finished->history, finished->exact);
      study.taken_over.push_back(run.directory);
      schedule.finish(finished->summary.wall_seconds);
      continue;
    }
    run.schedule = &schedule;
    run.before_writing = [&output] { output.prepare(); };
    RunResult result = attempt_case(setup, run);
    if (result.summary.status == "breakdown") {
      schedule.finish(std::nullopt);
      study.breakdowns.push_back(breakdown_of(result.summary));
    } else {
      schedule.finish(result.summary.wall_seconds);
      add_run(study, run, result.summary, result.history, result.exact);
      if (run.shapes) study.shapes[method] = std::move(result.shapes);
      results.push_back(std::move(result));
    }
    if (interrupt_requested()) return;
  }
  // of the finest level only, and only where both were run now
  if (results.size() == 2 && level == options.levels.back())
    study.differences = differences_of(results[0], results[1]);
}

}  // namespace

Study run_study(const cases::Case& setup, const StudyOptions& options) {
  require_memory(setup, options.methods, options.levels);
  const bool has_levels = options.levels.size() > 1;
  OutputFolder output(options.directory, setup, has_levels ? OutputKind::levels : OutputKind::runs,
                      options.force);
  if (has_levels) output.ask_for(options.levels, options.methods, !options.resume);
  Study study;
  Schedule schedule = schedule_of(setup, options);
  try {
    for (const int level : options.levels) {
      run_level(setup, options, level, output, schedule, study);
      if (interrupt_requested()) return study;
    }
    output.prepare();  // where all runs were taken over
  } catch (const base::Interruption&) {
    // while a mesh was made: what was finished before stands
  }
  return study;
}

std::vector<std::string> material_lines(const cases::MaterialCase& m) {
  std::vector<std::string> lines{
      fmt::format("{}, density {:g} kg/m^3", m.model, m.density),
      fmt::format("mu = {:g} Pa, lambda = {:g} Pa", m.shear_modulus, m.lame)};
  if (m.zeta_ratio > 0) lines.push_back(fmt::format("zeta / (xi + zeta) = {:g}", m.zeta_ratio));
  for (size_t k = 0; k < m.branches.size(); ++k) {
    const cases::BranchCase& b = m.branches[k];
    std::string line = fmt::format("branch {}:", k + 1);
    if (b.beta_C > 0) line += fmt::format(" beta_C = {:g}, tau_C = {:g} s", b.beta_C, b.tau_C);
    if (b.beta_G > 0) line += fmt::format(" beta_G = {:g}, tau_G = {:g} s", b.beta_G, b.tau_G);
    lines.push_back(line);
  }
  return lines;
}

/// Of the second level; zero where the two levels have no ratio of spacings.
double two_level_bar(const MethodConvergence& method, const Quantity& scalar) {
  const double coarse = method.levels[0].spacing, fine = method.levels[1].spacing;
  if (!(fine < coarse) || !std::isfinite(scalar.values[0])) return 0;
  return report::two_grid_error_bar({fine, coarse}, {scalar.values[1], scalar.values[0]});
}

/// Scalars of one method with the error bars that each level and those before it give.
void add_quantities(const MethodConvergence& method, report::StudyReport& report) {
  for (const Quantity& scalar : method.scalars) {
    report::GridSeries series{method.method, {}, std::nullopt};
    for (size_t i = 0; i < scalar.values.size(); ++i) {
      if (!std::isfinite(scalar.values[i])) continue;
      series.estimate = estimate(method, scalar, i);
      double bar = series.estimate ? series.estimate->error_bar : 0;
      if (i == 1) bar = two_level_bar(method, scalar);
      series.points.push_back(
          {method.levels[i].level, method.levels[i].spacing, scalar.values[i], bar});
    }
    if (!series.points.empty())
      report.quantities[{scalar.name, scalar.unit}].push_back(std::move(series));
  }
}

/// What probes and energies are drawn against: the exact solution as one of the methods met it, and
/// the values from elsewhere.
report::References references_of(const cases::Case& setup, const Study& study) {
  report::References references;
  for (const auto& [method, columns] : study.exact) {
    if (!columns.empty()) references.exact = columns;
  }
  for (const cases::ReferenceCase& one : setup.references)
    references.points.push_back({one.probe, one.source, one.points});
  return references;
}

report::StudyReport report_of(const cases::Case& setup,
                              const Study& study,
                              const std::vector<MethodConvergence>& convergence) {
  report::StudyReport report;
  report.title = setup.title.empty() ? setup.name : setup.title;
  report.description =
      fmt::format("Case {}{}", setup.name,
                  setup.overrides.empty() ? "" : ", with " + base::joined(setup.overrides));
  report.material = material_lines(setup.material);
  report.runs = study.runs;
  report.histories = study.histories;
  report.breakdowns = study.breakdowns;
  for (report::Breakdown& one : report.breakdowns)
    one.message = one.message.substr(0, one.message.find('\n'));
  report.differences = study.differences;
  report.references = references_of(setup, study);
  report.shapes = study.shapes;
  for (const MethodConvergence& method : convergence)
    add_quantities(method, report);
  return report;
}

}  // namespace diptych::harness
