#include "common/run/observers/history.hpp"

#include <algorithm>
#include <utility>

namespace diptych::run {

History::History(Solver& solver,
                 const Probes& probes,
                 const Cells& cells,
                 const EnergyUnits& units,
                 const MomentumUnits& rounding)
    : solver_(solver),
      probes_(probes),
      cells_(cells),
      energy_(solver.balance(), units),
      momenta_(solver.balance(), rounding) {}

void History::write_to(const std::string& path, const std::vector<std::string>& columns) {
  file_ = std::make_unique<io::RowFile>(path, io::history_header(columns));
  for (const io::HistoryRow& row : rows_)
    file_->append(io::history_line(row));
  file_->flush();
}

void History::at_output(const Output& output) {
  const scheme::Balance& balance = output.balance;
  io::HistoryRow row;
  row.time = output.state.time();
  row.step = output.step.step;
  row.dt = output.step.dt;
  row.energy = energy_.at(balance, output.audit);
  for (int i = 0; i < 3; ++i) {
    row.linear_momentum[i] = balance.linear_momentum[i];
    row.angular_momentum[i] = balance.angular_momentum[i];
  }
  row.min_jacobian = balance.least_J;
  row.involution_H = balance.involution_H;
  row.involution_J = balance.involution_J;
  row.least_cell_J = cells_.now().J;
  if (!probes_.empty()) row.probes = probes_.values(solver_);
  rows_.push_back(std::move(row));
  momenta_.at(balance, output.audit);
  linear_drift_ = std::max(linear_drift_, momenta_.linear_drift());
  angular_drift_ = std::max(angular_drift_, momenta_.angular_drift());
  if (!file_) return;
  file_->append(io::history_line(rows_.back()));
  file_->flush();
}

void History::end(Ending) {
  if (file_) file_->finish();
}

/// One row after the other; all have as many probes.
void History::archive(algebra::Archive& archive) {
  std::vector<double> values;
  std::vector<std::int64_t> steps;
  for (io::HistoryRow& row : rows_) {
    io::for_each_value(row, [&](double& value) { values.push_back(value); });
    values.insert(values.end(), row.probes.begin(), row.probes.end());
    steps.push_back(row.step);
  }
  io::HistoryRow blank;
  blank.probes.resize(probes_.size());
  int n_columns = 0;
  io::for_each_value(blank, [&](double&) { ++n_columns; });
  n_columns += static_cast<int>(blank.probes.size());
  archive.integers("history/steps", steps);
  archive.reals("history/rows", "as history.csv", values, n_columns,
                static_cast<std::int64_t>(steps.size()));
  rows_.assign(steps.size(), blank);
  size_t k = 0;
  for (io::HistoryRow& row : rows_) {
    io::for_each_value(row, [&](double& value) { value = values[k++]; });
    for (double& probe : row.probes)
      probe = values[k++];
    row.step = steps[static_cast<size_t>(&row - rows_.data())];
  }
  energy_.archive("history", archive);
  momenta_.archive("history", archive);
  archive.real("history/linear drift", "-", linear_drift_);
  archive.real("history/angular drift", "-", angular_drift_);
}

double History::energy_residual() const {
  // of a copy: what is shown in between is no part of the record
  return EnergyRecord(energy_).at(solver_.balance(), solver_.audit()).relative_residual;
}

/// Largest change of momentum beyond the impulse of loads and constraints, relative to sum |p|.
void History::fill(io::RunSummary& summary) const {
  summary.energy = rows_.back().energy;
  summary.largest_energy = energy_.scale() > energy_.rounding() ? energy_.scale() : 0;
  summary.mobile_energy = energy_.mobile();
  summary.contact_loss = solver_.audit().contact_loss;
  summary.linear_momentum_drift = linear_drift_;
  summary.angular_momentum_drift = angular_drift_;
  for (const io::HistoryRow& row : rows_) {
    summary.involution_H = std::max(summary.involution_H, row.involution_H);
    summary.involution_J = std::max(summary.involution_J, row.involution_J);
  }
}

}  // namespace diptych::run
