#pragma once
/// Evolution of the internal variables (14): A' = (C^-1 - A)/tau, S' = (G^-1 - S)/tau. Both updates
/// are convex combinations of symmetric positive definite tensors, hence symmetric positive
/// definite for every dt/tau; both are exact for a constant deformation and keep the first-order
/// lag as tau -> 0 (notes 5). Weights depend on dt/tau only: once per branch and step.
/// Tests: tests/common/physics/viscous_evolution_test.cpp.

#include "common/physics/deformation.hpp"

namespace diptych::physics {

/// A(t+dt) = old A(t) + begin B(t) + end B(t+dt): exact for B = C^-1 linear in time (LIN).
struct LinearRelaxation {
  double old = 1, begin = 0, end = 0;
};

/// @param z dt/tau >= 0
LinearRelaxation linear_relaxation(double z);

/// A(t+dt) = old A(t) + weight[0] B(theta[0]) + weight[1] B(theta[1]): two-point Gauss rule of the
/// exponential weight (GEXP), exact for B cubic in time; theta in (0, 1) is the fraction of the
/// step.
struct GaussRelaxation {
  double old = 1;
  double weight[2] = {0, 0};
  double theta[2] = {0.5, 0.5};
};

/// @param z dt/tau >= 0
GaussRelaxation gauss_relaxation(double z);

/// Moments c_k = int_0^1 z e^(-z u) u^k du, k = 0..3, of the exponential weight.
void exponential_moments(double z, double c[4]);

template <class T>
DIPTYCH_INLINE SymmetricTensor<T> relaxed(const LinearRelaxation& w,
                                          const SymmetricTensor<T>& A_old,
                                          const SymmetricTensor<T>& B_begin,
                                          const SymmetricTensor<T>& B_end) {
  return w.old * A_old + w.begin * B_begin + w.end * B_end;
}

template <class T>
DIPTYCH_INLINE SymmetricTensor<T> relaxed(const GaussRelaxation& w,
                                          const SymmetricTensor<T>& A_old,
                                          const SymmetricTensor<T>& B_first,
                                          const SymmetricTensor<T>& B_second) {
  return w.old * A_old + w.weight[0] * B_first + w.weight[1] * B_second;
}

/// Hermite cubic of F over a step from values and rates at its ends, at fraction theta.
template <class T>
DIPTYCH_INLINE Tensor<T> hermite(double theta,
                                 double dt,
                                 const Tensor<T>& F_begin,
                                 const Tensor<T>& rate_begin,
                                 const Tensor<T>& F_end,
                                 const Tensor<T>& rate_end) {
  const double t2 = theta * theta, t3 = t2 * theta;
  const double a = 2 * t3 - 3 * t2 + 1, b = (t3 - 2 * t2 + theta) * dt;
  const double c = 3 * t2 - 2 * t3, d = (t3 - t2) * dt;
  Tensor<T> F;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      F(i, j) = a * F_begin(i, j) + b * rate_begin(i, j) + c * F_end(i, j) + d * rate_end(i, j);
  return F;
}

}  // namespace diptych::physics
