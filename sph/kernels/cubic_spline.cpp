/// Cubic B-spline, support 2h: f = 2/3 - q^2 + q^3/2 (q <= 1), (2-q)^3/6 (q <= 2)
/// (Monaghan and Lattanzio 1985; notes 3.1).

#include "sph/kernels/kernel.hpp"

#include <numbers>

namespace diptych::sph {

namespace {

double f(double q) {
  if (q >= 2) return 0;
  return q <= 1 ? 2. / 3 - q * q * (1 - q / 2) : (2 - q) * (2 - q) * (2 - q) / 6;
}

double f_slope(double q) {
  if (q >= 2) return 0;
  return q <= 1 ? -2 * q + 1.5 * q * q : -(2 - q) * (2 - q) / 2;
}

}  // namespace

Kernel cubic_spline() {
  return {2, 15 / (7 * std::numbers::pi), 3 / (2 * std::numbers::pi), f, f_slope};
}

}  // namespace diptych::sph
