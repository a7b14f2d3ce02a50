#pragma once
/// Numerical inversion of a Laplace transform by the fixed Talbot contour (Abate and Valko 2004,
/// Int. J. Numer. Meth. Eng. 60, 979): s(theta) = r theta (cot theta + i), r = 2N/(5t),
///   f(t) = r/N [ 1/2 G(r) e^(rt) + sum_k Re( e^(t s_k) G(s_k) (1 + i sigma_k) ) ].
/// About 0.6 N digits, less N/6 lost to cancellation: 24 points leave ten digits in double.
/// Conditions: t > 0; singularities of G on the negative real axis and at 0 only.
/// Test: tests/common/exact/zener_bar_test.cpp.

#include <cmath>
#include <complex>

namespace diptych::exact {

/// @param G  transform, complex -> any type with + and scaling by a complex number
/// @param t  s, > 0
/// @return   sum of the contour; its real part is f(t)
template <class Real, class Transform>
auto talbot_sum(const Transform& G, Real t, int n_points) {
  using Complex = std::complex<Real>;
  const Real pi = std::acos(Real(-1));
  const Real r = 2 * Real(n_points) / (5 * t);
  auto sum = G(Complex(r)) * Complex(std::exp(r * t) / 2);
  for (int k = 1; k < n_points; ++k) {
    const Real theta = k * pi / n_points;
    const Real cot = 1 / std::tan(theta);
    const Complex s(r * theta * cot, r * theta);
    const Real sigma = theta + (theta * cot - 1) * cot;
    sum += G(s) * (std::exp(s * t) * Complex(1, sigma));
  }
  return sum * Complex(r / n_points);
}

}  // namespace diptych::exact
