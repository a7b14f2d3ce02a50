#include "common/physics/viscous_evolution.hpp"

#include <cmath>

namespace diptych::physics {

LinearRelaxation linear_relaxation(double z) {
  LinearRelaxation w;
  w.old = std::exp(-z);
  if (z < 1e-3) {
    // phi = (1 - e^-z)/z by series: the difference of nearly equal numbers loses digits
    w.begin = z / 2 - z * z / 3 + z * z * z / 8 - z * z * z * z / 30;
    w.end = z / 2 - z * z / 6 + z * z * z / 24 - z * z * z * z / 120;
  } else {
    const double phi = -std::expm1(-z) / z;
    w.begin = phi - w.old;
    w.end = 1 - phi;
  }
  return w;
}

void exponential_moments(double z, double c[4]) {
  if (z < 2) {
    for (int k = 0; k < 4; ++k) {
      double term = 1, sum = 0;
      for (int j = 0; j < 40; ++j) {
        sum += term / (k + j + 1);
        term *= -z / (j + 1);
      }
      c[k] = z * sum;
    }
    return;
  }
  const double E = std::exp(-z);
  c[0] = -std::expm1(-z);
  for (int k = 1; k < 4; ++k)
    c[k] = k / z * c[k - 1] - E;
}

GaussRelaxation gauss_relaxation(double z) {
  GaussRelaxation rule;
  rule.old = std::exp(-z);
  double c[4];
  exponential_moments(z, c);
  if (!(c[0] > 0)) {  // z = 0: nothing relaxes
    rule.old = 1;
    return rule;
  }
  // Orthogonal polynomial u^2 + alpha u + beta of the weight. Scaled by the mean m = c1/c0 so that
  // small and large z are treated alike.
  double m = c[1] / c[0];
  double k2 = c[2] / (c[0] * m * m), k3 = c[3] / (c[0] * m * m * m);
  if (z > 50) {  // e^-z is below rounding: c_k = k!/z^k, whose powers of z would underflow
    m = 1 / z;
    k2 = 2;
    k3 = 6;
  }
  // [1 1; k2 1] [alpha; beta] = -[k2; k3] for u/m: alpha + beta = -k2, k2 alpha + beta = -k3
  const double alpha = (k2 - k3) / (k2 - 1), beta = -k2 - alpha;
  const double root = std::sqrt(alpha * alpha / 4 - beta);
  const double far = -alpha / 2 + root, near = beta / far;  // beta = near * far, no cancellation
  rule.weight[0] = c[0] * (1 - far) / (near - far);
  rule.weight[1] = c[0] * (near - 1) / (near - far);
  rule.theta[0] = 1 - m * near;
  rule.theta[1] = 1 - m * far;
  return rule;
}

}  // namespace diptych::physics
