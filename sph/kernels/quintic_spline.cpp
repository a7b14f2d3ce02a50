/// Quintic B-spline, support 3h: f = (3-q)_+^5 - 6 (2-q)_+^5 + 15 (1-q)_+^5
/// (Morris, Fox and Zhu 1997).

#include "sph/kernels/kernel.hpp"

#include <algorithm>
#include <numbers>

namespace diptych::sph {

namespace {

double fourth(double x) {
  const double y = std::max(x, 0.0) * std::max(x, 0.0);
  return y * y;
}

double f(double q) {
  return fourth(3 - q) * (3 - q) - 6 * fourth(2 - q) * (2 - q) + 15 * fourth(1 - q) * (1 - q);
}

double f_slope(double q) {
  return -5 * fourth(3 - q) + 30 * fourth(2 - q) - 75 * fourth(1 - q);
}

}  // namespace

Kernel quintic_spline() {
  return {3, 7 / (478 * std::numbers::pi), 1 / (120 * std::numbers::pi), f, f_slope};
}

}  // namespace diptych::sph
