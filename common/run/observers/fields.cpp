#include "common/run/observers/fields.hpp"

#include "common/cases/stress_measures.hpp"

#include <utility>

namespace diptych::run {

namespace {

/// An empty field of so many components at as many nodes as `order` has.
io::NodeField blank(const char* name, int n_components, const std::vector<std::int32_t>& order) {
  return {name, n_components,
          std::vector<double>(order.size() * static_cast<size_t>(n_components))};
}

void set(io::NodeField& field, std::int32_t node, const algebra::Vec3& value) {
  for (int i = 0; i < 3; ++i)
    field.values[3 * static_cast<size_t>(node) + static_cast<size_t>(i)] = value[i];
}

void set(io::NodeField& field, std::int32_t node, const algebra::Mat3& value) {
  for (int k = 0; k < 9; ++k)
    field.values[9 * static_cast<size_t>(node) + static_cast<size_t>(k)] = value(k / 3, k % 3);
}

}  // namespace

std::vector<io::NodeField> frame_fields(const Snapshot& state,
                                        const std::vector<std::int32_t>& order) {
  io::NodeField u = blank("displacement [m]", 3, order), v = blank("velocity [m/s]", 3, order);
  io::NodeField F = blank("deformation_gradient [-]", 9, order);
  io::NodeField P = blank("first_piola_stress [Pa]", 9, order);
  io::NodeField sigma = blank("cauchy_stress [Pa]", 9, order);
  io::NodeField mises = blank("von_mises_stress [Pa]", 1, order);
  io::NodeField J = blank("jacobian [-]", 1, order), p = blank("pressure [Pa]", 1, order);
  for (size_t a = 0; a < order.size(); ++a) {
    const std::int32_t node = order[a];
    const algebra::Mat3 stress = cases::cauchy_stress(state.P[a], state.F[a], state.J[a]);
    set(u, node, state.u[a]);
    set(v, node, state.v[a]);
    set(F, node, state.F[a]);
    set(P, node, state.P[a]);
    set(sigma, node, stress);
    mises.values[static_cast<size_t>(node)] = cases::von_mises(stress);
    J.values[static_cast<size_t>(node)] = state.J[a];
    p.values[static_cast<size_t>(node)] = cases::pressure(stress);
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

void Fields::at_output(const Output& output) {
  if (!writer_) return;
  std::vector<io::NamedValue> values;
  const std::vector<double>& probes = history_.rows().back().probes;
  for (size_t k = 0; k < probes.size(); ++k)
    values.push_back({columns_[k], probes[k]});
  last_frame_ = {
      writer_->write(output.state.time(), frame_fields(output.state.fields(), order_), values),
      output.state.time()};
  times_.push_back(output.state.time());
}

}  // namespace diptych::run
