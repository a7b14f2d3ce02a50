#include "benchmarks/study/study.hpp"

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "common/base/text.hpp"
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
  run.partition = options.partition;
  run.directory = run_directory(options, level, method);
  run.fields = options.fields;
  run.quiet = options.quiet;
  run.shapes = options.shapes && level == options.levels.back();
  run.scales =
      (options.methods.size() == 2 && level == options.levels.back()) || options.keeps_checkpoints;
  run.checkpoints = options.keeps_checkpoints;
  if (const auto found = options.checkpoints.find(method); found != options.checkpoints.end())
    run.checkpoint = found->second;
  return run;
}

/// All methods on all levels, coarse to fine.
std::vector<CampaignRun> plan_of(const cases::Case& setup,
                                 const StudyOptions& options,
                                 OutputFolder& output) {
  std::vector<CampaignRun> plan;
  for (const int level : options.levels) {
    for (const std::string& method : options.methods) {
      plan.push_back({&setup, run_options(options, level, method), method, method});
      plan.back().options.before_writing = [&output] { output.prepare(); };
    }
  }
  return plan;
}

}  // namespace

Study run_study(const cases::Case& setup, const StudyOptions& options) {
  require_memory(setup, options.methods, options.levels);
  const bool has_levels = options.levels.size() > 1;
  OutputFolder output(options.directory, setup, has_levels ? OutputKind::levels : OutputKind::runs,
                      options.force);
  if (has_levels) output.ask_for(options.levels, options.methods, !options.resume);
  if (options.goes_on) output.go_on();
  if (options.resume || !has_levels) output.refuse_to_replace(options.force);
  Study study;
  std::vector<RunResult> finest;  // those that were run now
  const auto plan = plan_of(setup, options, output);
  const auto add = [&](size_t number, CampaignResult made, const Schedule&) {
    const RunOptions& run = plan[number].options;
    RunResult& result = made.run;
    if (result.summary.status == "breakdown") {
      study.breakdowns.push_back(breakdown_of(result.summary));
      return;
    }
    study.runs.push_back(result.summary);
    study.directories.push_back(run.directory);
    study.histories[run.method] = result.history;
    study.exact[run.method] = result.exact;
    if (made.taken_over) study.taken_over.push_back(run.directory);
    if (made.taken_over || run.level != options.levels.back()) return;
    if (run.shapes) study.shapes[run.method] = std::move(result.shapes);
    finest.push_back(std::move(result));
  };
  if (!make_runs(plan, options.resume ? TakeOver::finished : TakeOver::nothing, add)) return study;
  if (finest.size() == 2) study.differences = differences_of(finest[0], finest[1]);
  output.prepare();  // where all runs were taken over
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

/// Scalars of one method with the error bars that each level and those before it give.
void add_quantities(const MethodConvergence& method, report::StudyReport& report) {
  for (const Quantity& scalar : method.scalars) {
    report::GridSeries series{method.method, {}, std::nullopt, formal_order(method.levels.back())};
    for (size_t i = 0; i < scalar.values.size(); ++i) {
      if (!std::isfinite(scalar.values[i])) continue;
      series.estimate = estimate(method, scalar, i);
      const double bar = error_bar(method, scalar, i);
      series.points.push_back({method.levels[i].level, method.levels[i].spacing, scalar.values[i],
                               std::isfinite(bar) ? bar : 0});
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
