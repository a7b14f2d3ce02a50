#include "benchmarks/harness/frame_fields.hpp"

#include <string>
#include <utility>

namespace diptych::harness {

namespace {

io::NodeField vectors(const std::string& name,
                      const std::vector<algebra::Vec3>& field,
                      const std::vector<std::int32_t>& order) {
  io::NodeField f{name, 3, std::vector<double>(3 * field.size())};
  for (size_t a = 0; a < field.size(); ++a) {
    for (int i = 0; i < 3; ++i)
      f.values[3 * order[a] + i] = field[a][i];
  }
  return f;
}

io::NodeField tensors(const std::string& name,
                      const std::vector<run::Mat3>& field,
                      const std::vector<std::int32_t>& order) {
  io::NodeField f{name, 9, std::vector<double>(9 * field.size())};
  for (size_t a = 0; a < field.size(); ++a) {
    for (int k = 0; k < 9; ++k)
      f.values[9 * order[a] + k] = field[a](k / 3, k % 3);
  }
  return f;
}

}  // namespace

std::vector<io::NodeField> frame_fields(const run::Snapshot& s,
                                        const std::vector<std::int32_t>& order) {
  io::NodeField J{"jacobian [-]", 1, std::vector<double>(s.J.size())};
  io::NodeField pressure{"pressure [Pa]", 1, std::vector<double>(s.J.size())};
  for (size_t a = 0; a < s.J.size(); ++a) {
    J.values[order[a]] = s.J[a];
    // p = -1/3 tr sigma, sigma = P F^T / J
    pressure.values[order[a]] = -(s.P[a] * s.F[a].transpose()).trace() / (3 * s.J[a]);
  }
  return {vectors("displacement [m]", s.u, order),
          vectors("velocity [m/s]", s.v, order),
          tensors("deformation_gradient [-]", s.F, order),
          tensors("first_piola_stress [Pa]", s.P, order),
          std::move(J),
          std::move(pressure)};
}

}  // namespace diptych::harness
