/// Bell f = (1 - (q/2)^2)^4, support 2h.

#include "sph/kernels/kernel.hpp"

#include <numbers>

namespace diptych::sph {

namespace {

double f(double q) {
  const double s = 1 - q * q / 4;
  return q < 2 ? s * s * s * s : 0;
}

double f_slope(double q) {
  const double s = 1 - q * q / 4;
  return q < 2 ? -2 * q * s * s * s : 0;
}

}  // namespace

Kernel quartic_bell() {
  return {2, 5 / (4 * std::numbers::pi), 3465 / (4096 * std::numbers::pi), f, f_slope};
}

}  // namespace diptych::sph
