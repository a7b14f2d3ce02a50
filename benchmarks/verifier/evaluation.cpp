/// Values, orders and verdicts of the rows of a verification table.

#include "benchmarks/terminal/text.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Letters and digits, '_' for what is neither.
std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

/// A probe "tip displacement" as tip_displacement (at the end), tip_displacement_least, _greatest;
/// where it oscillates _period, _amplitude, _mean, _decrement, else these are no numbers.
void add_quantity(const io::QuantitySummary& quantity, std::map<std::string, double>& numbers) {
  const std::string name = plain_name(quantity.name);
  const bool swings = quantity.n_periods > 0;
  numbers[name] = quantity.final_value;
  numbers[name + "_least"] = quantity.least;
  numbers[name + "_greatest"] = quantity.greatest;
  numbers[name + "_period"] = swings ? quantity.period : nothing;
  numbers[name + "_amplitude"] = swings ? quantity.amplitude : nothing;
  numbers[name + "_mean"] = swings ? quantity.mean : nothing;
  numbers[name + "_decrement"] = quantity.decrement.value_or(nothing);
}

/// A reference of the probe "tip x" as tip_x_off (largest distance), tip_x_off_rms, tip_x_off_end.
void add_reference(const io::ReferenceSummary& one, std::map<std::string, double>& numbers) {
  const std::string name = plain_name(one.name) + "_off";
  numbers[name] = one.greatest;
  numbers[name + "_rms"] = one.rms;
  numbers[name + "_end"] = one.at_end;
}

/// The numbers of a run under the names that columns use.
std::map<std::string, double> numbers_of(const VerificationTable& table,
                                         const io::RunSummary& run) {
  std::map<std::string, double> numbers = table.parameters;
  const auto pairs = static_cast<double>(run.pairs), stages = static_cast<double>(run.stages);
  for (const auto& [field, norms] : run.errors) {
    numbers["error_" + field] = norms.l2;
    numbers["error_" + field + "_l1"] = norms.l1;
    numbers["error_" + field + "_linf"] = norms.linf;
  }
  for (const auto& [name, value] : run.measures)
    numbers[name] = value;
  numbers["kinetic"] = run.energy.kinetic;
  numbers["strain"] = run.energy.strain;
  numbers["viscous"] = run.energy.viscous_dissipation;
  numbers["numerical"] = run.energy.numerical_dissipation;
  numbers["work"] = run.energy.external_work;
  numbers["projection"] = run.energy.projection_work;
  numbers["residual"] = run.energy.relative_residual;
  numbers["angular_drift"] = run.angular_momentum_drift;
  numbers["nodes"] = static_cast<double>(run.nodes);
  numbers["steps"] = static_cast<double>(run.steps);
  numbers["pairs"] = pairs;
  numbers["stages"] = stages;
  numbers["pair_updates"] = pairs * stages;  // a directed pair in a stage
  numbers["neighbours"] = run.mean_neighbours;
  numbers["seconds"] = run.loop_seconds;
  numbers["spacing"] = run.spacing;
  numbers["end_time"] = run.end_time;
  numbers["min_jacobian"] = run.min_jacobian;
  numbers["least_cell_J"] = run.least_cell_J;
  for (const io::QuantitySummary& quantity : run.quantities)
    add_quantity(quantity, numbers);
  for (const io::ReferenceSummary& one : run.references)
    add_reference(one, numbers);
  return numbers;
}

/// Whether the expression asks for an error that the run does not have.
bool asks_for_missing_error(const std::string& text, const std::map<std::string, double>& numbers) {
  for (size_t at = text.find("error_"); at != std::string::npos; at = text.find("error_", at + 1)) {
    size_t end = at;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
      ++end;
    if (numbers.count(text.substr(at, end - at)) == 0) return true;
  }
  return false;
}

/// Whether a run that came to its end lacks what an optional column asks for.
bool lacks(const VerificationTable& table,
           const VerificationColumn& column,
           const VerificationRow& row) {
  return column.optional && row.failure.empty() &&
         asks_for_missing_error(column.value, numbers_of(table, row.summary));
}

double value_of(const VerificationTable& table,
                const VerificationColumn& column,
                const VerificationRow& row) {
  if (!row.failure.empty() || lacks(table, column, row)) return nothing;
  return functions::constant_value(column.value, numbers_of(table, row.summary), column.where);
}

/// Value of a column in the same row of the run that it is divided by.
double divisor(const VerificationResult& result,
               const VerificationSequence& sequence,
               size_t row,
               size_t column) {
  const VerificationTable& table = result.table;
  for (const VerificationSequence& other : result.sequences) {
    if (table.runs[other.run].name != table.columns[column].ratio_to) continue;
    if (other.method == sequence.method && row < other.rows.size())
      return value_of(table, table.columns[column], other.rows[row]);
  }
  return nothing;
}

void evaluate_sequence(VerificationResult& result, VerificationSequence& sequence) {
  const VerificationTable& table = result.table;
  for (size_t i = 0; i < sequence.rows.size(); ++i) {
    VerificationRow& row = sequence.rows[i];
    row.value.clear();
    row.order.clear();
    for (size_t c = 0; c < table.columns.size(); ++c) {
      double value = value_of(table, table.columns[c], row);
      if (!table.columns[c].ratio_to.empty()) value /= divisor(result, sequence, i, c);
      row.value.push_back(value);
      double order = nothing;
      if (i > 0 && table.columns[c].order) {
        const VerificationRow& before = sequence.rows[i - 1];
        const auto size = [&](const io::RunSummary& run) {
          return table.order_in_steps ? 1.0 / static_cast<double>(run.steps) : run.spacing;
        };
        order =
            report::observed_order(before.value[c], value, size(before.summary), size(row.summary));
      }
      row.order.push_back(order);
    }
  }
}

/// What a bound looks at in a sequence.
double measured(const VerificationBound& bound, const VerificationSequence& s, size_t column) {
  using Kind = VerificationBound::Kind;
  const VerificationRow& last = s.rows.back();
  if (bound.kind == Kind::least_order) return last.order[column];
  if (bound.kind != Kind::most_spread) return last.value[column];
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const VerificationRow& row : s.rows) {
    if (!std::isfinite(row.value[column])) return nothing;
    least = std::min(least, std::abs(row.value[column]));
    most = std::max(most, std::abs(row.value[column]));
  }
  return most / least;
}

VerificationVerdict verdict_of(const VerificationResult& result,
                               const VerificationBound& bound,
                               const VerificationSequence& sequence,
                               size_t column) {
  using Kind = VerificationBound::Kind;
  const double value = measured(bound, sequence, column);
  VerificationVerdict verdict;
  verdict.run = result.table.runs[sequence.run].name;
  verdict.column = result.table.columns[column].title;
  verdict.method = sequence.method;
  const bool is_order = bound.kind == Kind::least_order;
  const bool at_least = is_order || bound.kind == Kind::least;
  const std::string what = is_order                          ? "order "
                           : bound.kind == Kind::most_spread ? "largest/smallest "
                                                             : "";
  verdict.asked = fmt::format("{}{} {:g}", what, at_least ? ">=" : "<=", bound.asked);
  verdict.measured = number_text(value, is_order ? "{:.2f}" : "{:.3g}", "none");
  verdict.met = std::isfinite(value) && (at_least ? value >= bound.asked : value <= bound.asked);
  return verdict;
}

}  // namespace

void evaluate(VerificationResult& result) {
  const VerificationTable& table = result.table;
  for (VerificationSequence& sequence : result.sequences)
    evaluate_sequence(result, sequence);
  result.verdicts.clear();
  for (const VerificationBound& bound : table.bounds) {
    for (size_t c = 0; c < table.columns.size(); ++c) {
      if (!contains(bound.columns, table.columns[c].title)) continue;
      for (const VerificationSequence& sequence : result.sequences) {
        if (!contains(bound.runs, table.runs[sequence.run].name)) continue;
        if (!lacks(table, table.columns[c], sequence.rows.back()))
          result.verdicts.push_back(verdict_of(result, bound, sequence, c));
      }
    }
  }
}

}  // namespace diptych::harness
