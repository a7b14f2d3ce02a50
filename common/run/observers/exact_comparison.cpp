#include "common/run/observers/exact_comparison.hpp"

#include "common/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace diptych::run {

ExactComparison::ExactComparison(const cases::Case& setup,
                                 const Solver& solver,
                                 size_t survey,
                                 const Probes& probes,
                                 const NaturalSizes& sizes)
    : setup_(setup), solver_(solver), survey_(survey), probes_(probes), errors_(sizes) {
  if (is_available()) this->survey().read_at(probes.nodes(), probes.places());
}

void ExactComparison::at_output(const Output& output) {
  if (!is_available()) return;
  const ExactSums sums = sums_of(solver_.ask(survey_, {}));
  errors_.measure(sums);
  add_row(output.state.time(), sums);
}

std::optional<std::string> ExactComparison::notice() const {
  std::vector<std::string> fields;
  for (const std::string& field : errors_.at_rest())
    if (field == "velocity" || field == "displacement" || field == "stress")
      fields.push_back(field);
  if (fields.empty()) return std::nullopt;
  return fmt::format(
      "the exact {} zero at all output times: errors of it are relative to the speed of pressure "
      "waves, the size of the body and density times the square of that speed",
      base::joined(fields) + (fields.size() == 1 ? " is" : " are"));
}

/// Of the same fields each time.
void ExactComparison::add_row(double time, const ExactSums& sums) {
  std::vector<io::HistoryColumn> now{{"time", "s", {time}}};
  if (sums.has_velocity) {
    momentum_scale_ = std::max(momentum_scale_, sums.momentum_scale);
    now.push_back({"kinetic energy", "J", {sums.kinetic}});
    for (int i = 0; i < 3; ++i)
      now.push_back({std::string("linear momentum ") + "xyz"[i], "kg m/s", {sums.momentum[i]}});
  }
  const auto probes = probes_.exact_values(survey().at_nodes());
  for (size_t k = 0; k < probes.size(); ++k) {
    if (probes[k]) now.push_back({setup_.probes[k].name, setup_.probes[k].unit, {*probes[k]}});
  }
  if (columns_.empty()) {
    columns_ = std::move(now);
    return;
  }
  for (size_t k = 0; k < columns_.size(); ++k)
    columns_[k].values.push_back(now.at(k).values.front());
}

void ExactComparison::archive(algebra::Archive& archive) {
  if (!is_available()) return;
  errors_.archive(archive);
  archive.real("exact/momentum scale", "kg m/s", momentum_scale_);
  std::vector<std::string> names, units;
  for (const io::HistoryColumn& column : columns_) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  archive.texts("exact/names of columns", names);
  archive.texts("exact/units of columns", units);
  columns_.resize(names.size());
  for (size_t k = 0; k < columns_.size(); ++k) {
    columns_[k].name = names[k];
    columns_[k].unit = units.at(k);
    archive.reals(fmt::format("exact/column {}", k), units[k], columns_[k].values);
  }
}

std::vector<io::HistoryColumn> ExactComparison::columns() const {
  std::vector<io::HistoryColumn> kept;
  for (const io::HistoryColumn& column : columns_) {
    double most = 0;
    for (const double value : column.values)
      most = std::max(most, std::abs(value));
    const bool is_momentum = column.name.starts_with("linear momentum");
    // what cancels between nodes leaves the rounding of sums
    if (!is_momentum || most > 1e-12 * momentum_scale_) kept.push_back(column);
  }
  return kept;
}

}  // namespace diptych::run
