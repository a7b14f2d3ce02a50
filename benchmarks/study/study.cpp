#include "benchmarks/study/study.hpp"

#include "benchmarks/campaign/campaign.hpp"
#include "benchmarks/run/breakdowns.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/study/refinement.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/run/field_norms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

/// What is kept of the finest run of a column.
struct FinestRun {
  std::string column;
  bool is_method = false;  ///< at the settings of the case
  RunResult result;
};

/// Whether two runs have their values at the same places.
bool have_the_same_nodes(const RunResult& a, const RunResult& b) {
  return !a.final_state.u.empty() && a.graph.X == b.graph.X;
}

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

/// How far the runs of the finest level are apart: one method from the other, and each variant from
/// each method whose nodes it has.
void add_differences(const std::vector<FinestRun>& finest, Study& study) {
  std::vector<const FinestRun*> methods;
  for (const FinestRun& one : finest) {
    if (one.is_method) methods.push_back(&one);
  }
  if (methods.size() == 2)
    study.differences = differences_of(methods[0]->result, methods[1]->result);
  for (const FinestRun& one : finest) {
    for (const FinestRun* method : methods) {
      if (one.is_method || !have_the_same_nodes(one.result, method->result)) continue;
      study.distances.push_back(
          {one.column, method->column, differences_of(one.result, method->result)});
    }
  }
}

std::string run_directory(const StudyOptions& options, int level, const std::string& column) {
  if (options.directory.empty()) return {};
  std::filesystem::path path = options.directory;
  if (options.levels.size() > 1) path /= fmt::format("level_{}", level);
  return (path / column).string();
}

/// What the options ask of one run.
RunOptions run_options(const StudyOptions& options, int level, const Column& column) {
  const bool is_finest = level == options.levels.back();
  RunOptions run;
  run.method = column.method;
  run.variant = column.variant;
  run.level = level;
  run.threads = options.threads;
  run.partition = options.partition;
  run.directory = run_directory(options, level, column.name());
  run.fields = options.fields;
  run.quiet = options.quiet;
  run.shapes = options.shapes && is_finest && column.variant.empty();
  const bool has_others = options.methods.size() == 2 || !options.variants.empty();
  run.scales = run.final_state = options.differences && has_others && is_finest;
  run.checkpoints = options.keeps_checkpoints;
  if (const auto found = options.checkpoints.find(run.column()); found != options.checkpoints.end())
    run.checkpoint = found->second;
  return run;
}

/// All columns on all levels, coarse to fine.
std::vector<CampaignRun> plan_of(const std::vector<Column>& columns,
                                 const StudyOptions& options,
                                 OutputFolder& output) {
  std::vector<CampaignRun> plan;
  for (const int level : options.levels) {
    for (const Column& column : columns) {
      plan.push_back(
          {&column.setup, run_options(options, level, column), column.name(), column.method});
      plan.back().may_be_refused =
          !column.variant.empty() || (options.goes_past_refusals && options.methods.size() == 2);
      plan.back().options.before_writing = [&output] { output.prepare(); };
    }
  }
  return plan;
}

/// Told at once, as the other method may take long.
void tell(const Refusal& one) {
  std::fputs(
      fmt::format("{} level {} is refused: {}\n", one.column, one.level, one.message).c_str(),
      stderr);
}

/// What both methods say is said once.
[[noreturn]] void refuse_all(const std::vector<Refusal>& refusals) {
  std::vector<std::string> messages;
  for (const Refusal& one : refusals)
    messages.push_back(one.message);
  const bool is_one = std::equal(messages.begin() + 1, messages.end(), messages.begin());
  if (is_one) throw base::InputError(messages.front());
  std::string all = "no method takes the case";
  const char* before = ": ";
  for (const Refusal& one : refusals) {
    all += fmt::format("{}{} level {}: {}", before, one.column, one.level, one.message);
    before = "; ";
  }
  throw base::InputError(all);
}

}  // namespace

const io::RunSummary* Study::run_of(const std::string& column) const {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [&](const auto& run) { return run.column() == column; });
  return found == runs.end() ? nullptr : &*found;
}

std::vector<report::Breakdown> Study::breakdowns() const {
  std::vector<report::Breakdown> all;
  for (const BrokenRun& run : broken)
    all.push_back(breakdown_of(run.summary));
  return all;
}

Study run_study(const cases::Case& setup, const StudyOptions& options) {
  Study study;
  study.columns = method_columns(setup, options.methods);
  study.columns.insert(study.columns.end(), options.variants.begin(), options.variants.end());
  for (const Column& column : study.columns)
    require_memory(column.setup, {column.method}, options.levels);
  const bool has_levels = options.levels.size() > 1;
  const OutputKind kind = options.goes_on ? OutputKind::continued
                          : has_levels    ? OutputKind::levels
                                          : OutputKind::runs;
  OutputFolder output(options.directory, setup, kind, options.force);
  if (has_levels) output.ask_for(options.levels, study.columns, !options.resume);
  if (options.resume || !has_levels) output.refuse_to_replace(options.force);
  std::vector<FinestRun> finest;  // those that were run now
  const auto plan = plan_of(study.columns, options, output);
  const auto add = [&](size_t number, CampaignResult made, const Schedule&) {
    const RunOptions& run = plan[number].options;
    const std::string column = run.column();
    RunResult& result = made.run;
    if (result.summary.status == "failed") {
      study.refusals.push_back({column, run.level, result.summary.failure->message});
      if (!options.quiet && number + 1 < plan.size()) tell(study.refusals.back());
      return;
    }
    if (result.summary.status == "breakdown") {
      study.broken.push_back({result.summary, std::move(result.history), std::move(result.shapes)});
      return;
    }
    for (const io::RunSummary& before : study.runs) {
      if (before.column() == column) require_refined(*plan[number].setup, before, result.summary);
    }
    study.runs.push_back(result.summary);
    study.directories.push_back(run.directory);
    study.histories[column] = result.history;
    study.exact[column] = result.exact;
    if (made.taken_over) study.taken_over.push_back(run.directory);
    if (made.taken_over || run.level != options.levels.back()) return;
    if (result.summary.status == "step limit") return;  // of another time than the others
    if (run.shapes) study.shapes[column] = std::move(result.shapes);
    finest.push_back({column, run.variant.empty(), std::move(result)});
  };
  if (!make_runs(plan, options.resume ? TakeOver::finished : TakeOver::nothing, add)) return study;
  if (study.is_empty() && !study.refusals.empty()) refuse_all(study.refusals);
  if (options.differences) add_differences(finest, study);
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

/// Scalars of one column with the error bars that each level and those before it give.
void add_quantities(const ColumnConvergence& column, report::StudyReport& report) {
  for (const Quantity& scalar : column.scalars) {
    report::GridSeries series{
        column.column, {}, std::nullopt, report::formal_order(column.levels.back()), scalar.scale};
    for (size_t i = 0; i < scalar.values.size(); ++i) {
      if (!std::isfinite(scalar.values[i])) continue;
      series.estimate = estimate(column, scalar, i);
      const double bar = error_bar(column, scalar, i);
      series.points.push_back({column.levels[i].level, column.levels[i].spacing, scalar.values[i],
                               std::isfinite(bar) ? bar : 0});
    }
    if (!series.points.empty())
      report.quantities[{scalar.name, scalar.unit}].push_back(std::move(series));
  }
}

/// Without what would stand beside values at the ends of runs, where it was cut short.
io::RunSummary shown(io::RunSummary run) {
  if (run.is_ended()) return run;
  run.errors.clear();
  for (io::QuantitySummary& one : run.quantities)
    one.final_value = std::numeric_limits<double>::quiet_NaN();
  return run;
}

/// What probes and energies are drawn against: the exact solution as the first of the columns met
/// it, and the values from elsewhere.
report::References references_of(const cases::Case& setup, const Study& study) {
  report::References references;
  for (const Column& column : study.columns) {
    const auto found = study.exact.find(column.name());
    if (found != study.exact.end() && references.exact.empty()) references.exact = found->second;
  }
  for (const cases::ReferenceCase& one : setup.references)
    references.points.push_back({one.probe, one.source, one.points});
  return references;
}

std::map<std::string, std::string> causes_of(const cases::Case& setup) {
  std::map<std::string, std::string> causes;
  for (const cases::ApartCase& one : setup.apart)
    causes[one.quantity] = one.because;
  return causes;
}

/// Runs that broke down stand among the others, without values at the end; their curves and bodies
/// where there are no others.
void add_broken(const Study& study, report::StudyReport& report) {
  for (auto run = study.broken.rbegin(); run != study.broken.rend(); ++run) {  // finest first
    const std::string column = run->summary.column();
    report.runs.push_back(shown(run->summary));
    report.histories.try_emplace(column, run->history);
    if (study.shapes.empty() && !run->shapes.frames.empty() && run->summary.variant.empty())
      report.shapes.try_emplace(column, run->shapes);
  }
}

report::StudyReport report_of(const cases::Case& setup,
                              const Study& study,
                              const std::vector<ColumnConvergence>& convergence) {
  report::StudyReport report;
  report.title = setup.title.empty() ? setup.name : setup.title;
  report.description =
      fmt::format("Case {}{}", setup.name,
                  setup.overrides.empty() ? "" : ", with " + base::joined(setup.overrides));
  report.material = material_lines(setup.material);
  for (const io::RunSummary& run : study.runs)
    report.runs.push_back(shown(run));
  report.histories = study.histories;
  report.breakdowns = study.breakdowns();
  for (report::Breakdown& one : report.breakdowns)
    one.message = one.message.substr(0, one.message.find('\n'));
  report.differences = study.differences;
  report.distances = study.distances;
  for (const Column& column : study.columns) {
    if (!column.variant.empty()) report.settings[column.name()] = base::joined(column.set);
  }
  report.references = references_of(setup, study);
  report.causes = causes_of(setup);
  report.shapes = study.shapes;
  add_broken(study, report);
  for (const ColumnConvergence& column : convergence)
    add_quantities(column, report);
  return report;
}

}  // namespace diptych::harness
