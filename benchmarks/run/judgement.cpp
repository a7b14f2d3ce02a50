#include "benchmarks/run/judgement.hpp"

#include "benchmarks/run/run_quantities.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

/// NaN where the body was at rest at the start.
double kinetic_growth(const std::vector<io::HistoryRow>& history) {
  double greatest = 0;
  for (const io::HistoryRow& row : history)
    greatest = std::max(greatest, row.energy.kinetic);
  const double start = history.empty() ? 0 : history.front().energy.kinetic;
  return start > 0 ? greatest / start : std::numeric_limits<double>::quiet_NaN();
}

cases::BoundCase at_most(const std::string& figure, double value) {
  return {fmt::format("{} <= {}", figure, value), figure, true, value, {}};
}

}  // namespace

double numerical_share(const io::RunSummary& run) {
  return run.largest_energy > 0 ? run.energy.numerical_dissipation / run.largest_energy : 0;
}

std::map<std::string, double> run_figures(const io::RunSummary& run,
                                          const std::vector<io::HistoryRow>& history) {
  std::map<std::string, double> figures{
      {"inverted cells", static_cast<double>(run.most_inverted_cells)},
      {"least cell J", run.least_cell_J},
      {"kinetic growth", kinetic_growth(history)},
      {"numerical share", numerical_share(run)},
      {"linear momentum drift", run.linear_momentum_drift},
      {"angular momentum drift", run.angular_momentum_drift}};
  for (const RunQuantity& q : common_quantities(run))
    figures[q.name] = q.value;
  figures["energy residual"] = std::abs(run.energy.relative_residual);
  for (const io::QuantitySummary& probe : run.quantities) {
    for (const RunQuantity& q : quantities_of_probe(probe))
      figures[q.name] = q.value;
  }
  return figures;
}

const std::vector<cases::BoundCase>& guard_bounds() {
  static const std::vector<cases::BoundCase> bounds{at_most("energy residual", 1e-2),
                                                    at_most("inverted cells", 0)};
  return bounds;
}

std::string AskedBound::text() const {
  const char* relation = bound.at_most ? "<=" : ">=";
  if (std::isnan(measured)) {
    const char* why = bound.figure == "kinetic growth" ? " (the body begins at rest)" : "";
    return fmt::format("{} has no value here{}, asked {} {:.3g}", bound.figure, why, relation,
                       bound.value);
  }
  // digits enough to tell a value from its bound
  std::string value, limit;
  for (int digits = 3; digits <= 17 && value == limit; ++digits) {
    value = fmt::format("{:.{}g}", measured, digits);
    limit = fmt::format("{:.{}g}", bound.value, digits);
  }
  return fmt::format("{} {}, asked {} {}", bound.figure, value, relation, limit);
}

std::vector<AskedBound> asked_of(const io::RunSummary& run,
                                 const std::vector<io::HistoryRow>& history,
                                 const std::vector<cases::BoundCase>& bounds) {
  const std::map<std::string, double> figures = run_figures(run, history);
  std::vector<cases::BoundCase> all = guard_bounds();
  all.insert(all.end(), bounds.begin(), bounds.end());
  std::vector<AskedBound> asked;
  for (const cases::BoundCase& bound : all) {
    const auto found = figures.find(bound.figure);
    if (found == figures.end()) {
      std::vector<std::string> names;
      for (const auto& [name, value] : figures)
        names.push_back(name);
      throw base::InputError(fmt::format("{}'{}' is no figure of a run{}",
                                         functions::prefix(bound.where), bound.figure,
                                         base::suggestion(bound.figure, names)));
    }
    asked.push_back({bound, found->second});
  }
  return asked;
}

namespace {

/// "numerical share 0.02, asked <= 0.01; ...", empty where all bounds hold.
std::string missed(const std::vector<AskedBound>& all) {
  std::vector<std::string> texts;
  for (const AskedBound& asked : all) {
    if (!asked.is_met()) texts.push_back(asked.text());
  }
  return base::joined(texts, "; ");
}

}  // namespace

std::string unmet_of(const cases::ExpectCase& expect,
                     const io::RunSummary& run,
                     const std::vector<io::HistoryRow>& history) {
  if (!expect.is_given) return "";
  if (!expect.stops.empty())
    return fmt::format("came to its end, asked to be stopped with \"{}\"", expect.stops);
  return missed(asked_of(run, history, expect.holds));
}

void check_figures(const cases::Case& setup) {
  io::RunSummary run;
  for (const cases::ProbeCase& probe : setup.probes)
    run.quantities.emplace_back().name = probe.name;
  asked_of(run, {}, setup.expect.holds);
  for (const cases::BoundCase& bound : setup.expect.holds) {
    for (const cases::ProbeCase& probe : setup.probes) {
      const bool is_of_swing =
          bound.figure == probe.name + ", period" || bound.figure == probe.name + ", amplitude";
      if (is_of_swing && !probe.oscillation)
        throw base::InputError(fmt::format("{}'{}' asks for oscillation = true in the probe",
                                           functions::prefix(bound.where), bound.figure));
    }
  }
}

const char* word_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::stable:
      return "stable";
    case Outcome::stopped:
      return "stopped";
    case Outcome::wrong:
      return "wrong";
    case Outcome::unfinished:
      return "unfinished";
    default:
      return "refused";
  }
}

Judgement judged(const io::RunSummary& run,
                 const std::vector<io::HistoryRow>& history,
                 const std::vector<cases::BoundCase>& bounds) {
  if (run.status == "step limit") {
    const std::string so_far = missed(asked_of(run, history, bounds));
    return {Outcome::unfinished,
            fmt::format("step limit (time.max_steps) at step {}, t = {:.4g} s{}", run.steps,
                        run.end_time, so_far.empty() ? "" : "; so far " + so_far)};
  }
  if (!run.is_ended()) {
    const std::string message = run.failure ? run.failure->message : run.status;
    return {run.status == "breakdown" ? Outcome::stopped : Outcome::refused,
            message.substr(0, message.find('\n'))};
  }
  const std::string unmet = missed(asked_of(run, history, bounds));
  return {unmet.empty() ? Outcome::stable : Outcome::wrong, unmet};
}

}  // namespace diptych::harness
