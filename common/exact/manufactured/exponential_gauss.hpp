#pragma once
/// n-point Gauss rule of the exponential weight, for the exact solution of (14):
///   A(t+dt) = old A(t) + sum w_i B(t + theta_i dt),   A' = (B - A)/tau,
/// exact for B of degree 2n - 1 in time, for every dt/tau (notes 5.3 with more points; the
/// scheme itself uses two). Test: tests/common/exact/manufactured_test.cpp.

#include <vector>

namespace diptych::exact {

struct ExponentialGauss {
  double old = 1;              ///< e^-z
  std::vector<double> weight;  ///< positive, sum 1 - e^-z
  std::vector<double> theta;   ///< in (0, 1), fraction of the interval
};

/// @param z dt/tau > 0
ExponentialGauss exponential_gauss(int n_points, double z);

/// The rule with given points, exact for B of degree n - 1: for times tau that share the values of
/// B.
ExponentialGauss exponential_rule(const std::vector<double>& theta, double z);

}  // namespace diptych::exact
