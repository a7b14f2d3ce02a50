/// Wendland C2, support 2h: f = (1 - q/2)^4 (1 + 2q) (Wendland 1995; Dehnen and Aly 2012).

#include "sph/kernels/kernel.hpp"

#include <numbers>

namespace diptych::sph {

namespace {

double f(double q) {
  if (q >= 2) return 0;
  const double s = (1 - q / 2) * (1 - q / 2);
  return s * s * (1 + 2 * q);
}

double f_slope(double q) {
  if (q >= 2) return 0;
  const double s = 1 - q / 2;
  return -5 * q * s * s * s;
}

}  // namespace

Kernel wendland_c2() {
  return {2, 7 / (4 * std::numbers::pi), 21 / (16 * std::numbers::pi), f, f_slope};
}

}  // namespace diptych::sph
