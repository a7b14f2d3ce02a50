#include "common/physics/step_dissipation.hpp"

#include "common/physics/viscous_evolution.hpp"

namespace diptych::physics {

ExcessWeights excess_weights(double z) {
  ExcessWeights w;
  if (!(z > 0)) return w;  // nothing relaxes
  // int_0^1 of e^(-zv) against 1 and, over the pairs u < s of s - u = v, against P_j(u) P_k(s):
  // 1 - v, v - v^2 and 1/3 - v + 2/3 v^3
  double c[4];
  exponential_moments(z, c);
  w.start[0] = c[0] / z;
  w.start[1] = (2 * c[1] - c[0]) / z;
  w.start[2] = (6 * (c[2] - c[1]) + c[0]) / z;
  w.lag = (c[0] - c[1]) / z;
  w.lag_01 = (c[1] - c[2]) / z;
  w.lag_11 = (c[0] / 3 - c[1] + 2 * c[3] / 3) / z;
  return w;
}

}  // namespace diptych::physics
