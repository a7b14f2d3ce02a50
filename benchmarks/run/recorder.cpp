#include "benchmarks/run/recorder.hpp"

#include "benchmarks/run/frame_fields.hpp"
#include "benchmarks/run/quantities.hpp"
#include "common/run/field_norms.hpp"

#include <algorithm>
#include <utility>

namespace diptych::harness {

Recorder::Recorder(const cases::Case& setup,
                   const RunOptions& options,
                   const CaseMesh& mesh,
                   run::Solver& solver,
                   RunResult& result)
    : setup_(setup),
      options_(options),
      solver_(solver),
      result_(result),
      errors_(setup, result.graph, solver),
      probes_(setup.probes, result.graph),
      exact_(setup, result.graph, probes_),
      initial_(solver.balance()),
      energy_(initial_),
      cells_(mesh.mesh) {
  if (options.shapes) {
    const auto n_outputs = static_cast<size_t>(setup.output.frames) + 1;
    shapes_ = std::make_unique<ShapeRecorder>(mesh.mesh, n_outputs);
  }
}

void Recorder::open(const CaseMesh& mesh) {
  if (!options_.directory.empty()) log_ = std::make_unique<RunLog>(options_.directory, setup_);
  if (!options_.directory.empty() && options_.fields && setup_.output.fields) {
    writer_ = std::make_unique<io::FieldWriter>(options_.directory, visual_mesh(mesh));
  }
}

io::HistoryRow Recorder::row_of(const run::StepReport& step, const scheme::Balance& balance) {
  io::HistoryRow row;
  row.time = solver_.time();
  row.step = step.step;
  row.dt = step.dt;
  row.energy = energy_.at(balance, solver_.audit());
  for (int i = 0; i < 3; ++i) {
    row.linear_momentum[i] = balance.linear_momentum[i];
    row.angular_momentum[i] = balance.angular_momentum[i];
  }
  row.min_jacobian = balance.least_J;
  row.involution_H = balance.involution_H;
  row.involution_J = balance.involution_J;
  if (!probes_.empty()) row.probes = probes_.values(solver_);
  return row;
}

void Recorder::record(const run::StepReport& step) {
  const scheme::Balance balance = solver_.balance();
  result_.history.push_back(row_of(step, balance));
  update_drifts(balance, solver_.audit());
  scheme::Snapshot snapshot = solver_.snapshot();
  check_cells(snapshot);
  if (log_) log_->row(result_.history.back());
  const bool keeps_shape = shapes_ && shapes_->wants(result_.history.size() - 1);
  if (options_.scales) raise_scales(run::field_norms(result_.graph, snapshot));
  if (errors_.available()) {
    errors_.measure(snapshot);
    exact_.take(errors_.exact());
  }
  if (writer_) write_frame(snapshot);
  if (keeps_shape) shapes_->take(snapshot, result_.history.back().time);
  result_.final_state = std::move(snapshot);
}

void Recorder::record_step(const run::StepReport& step) {
  if (!probes_.has_stepped()) return;
  result_.steps.push_back({step.time, step.step, probes_.stepped_values(solver_)});
  if (log_) log_->step(result_.steps.back());
}

void Recorder::finish() {
  if (log_) log_->finish();
}

double Recorder::energy_residual() {
  return energy_.at(solver_.balance(), solver_.audit()).relative_residual;
}

void Recorder::fill(io::RunSummary& s) const {
  s.errors = errors_.relative();
  s.energy = result_.history.back().energy;
  s.linear_momentum_drift = linear_drift_;
  s.angular_momentum_drift = angular_drift_;
  s.quantities = quantities_of(setup_.probes, result_);
  s.least_cell_J = least_cell_J_;
  s.most_inverted_cells = most_inverted_cells_;
  s.inverted_from = inverted_from_;
  if (shapes_) result_.shapes = shapes_->record();
  result_.exact = exact_.columns();
  if (options_.scales) {
    for (const auto& [field, norm] : errors_.scales())  // of errors too, where there are any
      result_.scales[field] = norm;
  }
  for (const io::HistoryRow& row : result_.history) {
    s.involution_H = std::max(s.involution_H, row.involution_H);
    s.involution_J = std::max(s.involution_J, row.involution_J);
  }
}

void Recorder::raise_scales(const std::map<std::string, double>& norms) {
  for (const auto& [field, norm] : norms)
    result_.scales[field] = std::max(result_.scales[field], norm);
}

/// Largest change of momentum beyond the impulse of loads and constraints, relative to sum |p|.
void Recorder::update_drifts(const scheme::Balance& now, const scheme::Audit& audit) {
  momentum_scale_ = std::max(momentum_scale_, now.momentum_scale);
  angular_scale_ = std::max(angular_scale_, now.angular_scale);
  const auto drift = [](const algebra::Vec3& p, double scale) {
    return scale > 0 ? p.norm() / scale : 0;
  };
  const algebra::Vec3 p = now.linear_momentum - initial_.linear_momentum - audit.impulse.linear;
  const algebra::Vec3 L = now.angular_momentum - initial_.angular_momentum - audit.impulse.angular;
  linear_drift_ = std::max(linear_drift_, drift(p, momentum_scale_));
  angular_drift_ = std::max(angular_drift_, drift(L, angular_scale_));
}

void Recorder::check_cells(const scheme::Snapshot& state) {
  const auto least = cells_.least(state.u);
  io::HistoryRow& row = result_.history.back();
  row.least_cell_J = least.J;
  least_cell_J_ = std::min(least_cell_J_, least.J);
  most_inverted_cells_ = std::max(most_inverted_cells_, least.n_inverted);
  if (least.n_inverted > 0 && !inverted_from_) inverted_from_ = row.time;
}

void Recorder::write_frame(const scheme::Snapshot& state) {
  std::vector<io::NamedValue> values;
  const std::vector<double>& probes = result_.history.back().probes;
  for (size_t k = 0; k < probes.size(); ++k)
    values.push_back({setup_.probes[k].column(), probes[k]});
  writer_->write(state.time, frame_fields(state, result_.order), values);
}

}  // namespace diptych::harness
