#include "common/run/observers/fields.hpp"

#include "common/cases/stress_measures.hpp"

#include <utility>

namespace diptych::run {

namespace {

/// An empty field of so many components at n nodes.
io::NodeField blank(const char* name, int n_components, size_t n) {
  return {name, n_components, std::vector<double>(n * static_cast<size_t>(n_components))};
}

void set(io::NodeField& field, size_t a, const algebra::Vec3& value) {
  for (int i = 0; i < 3; ++i)
    field.values[3 * a + static_cast<size_t>(i)] = value[i];
}

void set(io::NodeField& field, size_t a, const algebra::Mat3& value) {
  for (int k = 0; k < 9; ++k)
    field.values[9 * a + static_cast<size_t>(k)] = value(k / 3, k % 3);
}

}  // namespace

std::vector<io::NodeField> frame_fields(const Snapshot& state) {
  const size_t n = state.u.size();
  io::NodeField u = blank("displacement [m]", 3, n), v = blank("velocity [m/s]", 3, n);
  io::NodeField F = blank("deformation_gradient [-]", 9, n);
  io::NodeField P = blank("first_piola_stress [Pa]", 9, n);
  io::NodeField sigma = blank("cauchy_stress [Pa]", 9, n);
  io::NodeField mises = blank("von_mises_stress [Pa]", 1, n);
  io::NodeField J = blank("jacobian [-]", 1, n), p = blank("pressure [Pa]", 1, n);
  for (size_t a = 0; a < n; ++a) {
    const algebra::Mat3 stress = cases::cauchy_stress(state.P[a], state.F[a], state.J[a]);
    set(u, a, state.u[a]);
    set(v, a, state.v[a]);
    set(F, a, state.F[a]);
    set(P, a, state.P[a]);
    set(sigma, a, stress);
    mises.values[a] = cases::von_mises(stress);
    J.values[a] = state.J[a];
    p.values[a] = cases::pressure(stress);
  }
  std::vector<io::NodeField> fields;
  for (io::NodeField* field : {&u, &v, &F, &P, &sigma, &mises, &J, &p})
    fields.push_back(std::move(*field));
  return fields;
}

Fields::Fields(const std::vector<std::int32_t>& order,
               std::vector<std::string> columns,
               const History& history)
    : order_(order), columns_(std::move(columns)), history_(history) {}

void Fields::write_with(io::FieldWriter writer) {
  writer_.emplace(std::move(writer));
  nodes_.resize(order_.size());
  for (size_t a = 0; a < order_.size(); ++a)
    nodes_[static_cast<size_t>(order_[a])] = static_cast<std::int32_t>(a);
}

void Fields::at_output(const Output& output) {
  if (!writer_) return;
  const auto fields = [&](std::int64_t begin, std::int64_t end) {
    return frame_fields(output.state.fields_of(
        std::span(nodes_).subspan(static_cast<size_t>(begin), static_cast<size_t>(end - begin))));
  };
  std::vector<io::NamedValue> values;
  const std::vector<double>& probes = history_.rows().back().probes;
  for (size_t k = 0; k < probes.size(); ++k)
    values.push_back({columns_[k], probes[k]});
  last_frame_ = {writer_->write(output.state.time(), fields, values), output.state.time()};
  times_.push_back(output.state.time());
}

}  // namespace diptych::run
