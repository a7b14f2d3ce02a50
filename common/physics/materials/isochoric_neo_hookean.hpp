#pragma once
/// Neo-Hookean materials split into an isochoric and a volumetric part (benchmarks of the public
/// toolkits; polyconvex, since J^(-2/3) F:F is jointly convex in F and J):
///   W = mu/2 (J^(-2/3) F:F - 3) + U(J),
///   U = kappa/2 (J - 1)^2                    (pressure kappa (J - 1)), or
///   U = kappa/4 (J^2 - 1 - 2 ln J)           (J U' = kappa/2 (J^2 - 1)).
/// kappa = lambda + 2 mu/3. Branches scale xi = mu/2 with zeta = 0.

#include "common/physics/moduli.hpp"
#include "common/physics/response.hpp"

namespace diptych::physics {

template <bool squared_J>
struct IsochoricNeoHookeanFamily {
  static constexpr bool has_H = false;
  static constexpr bool has_W_FJ = true;
  double mu = 0;     ///< Pa
  double kappa = 0;  ///< Pa

  static IsochoricNeoHookeanFamily from(const LameConstants& lame, double) {
    return {lame.mu, lame.lambda + 2 * lame.mu / 3};
  }

  double branch_xi() const { return 0.5 * mu; }
  double branch_zeta() const { return 0; }

  /// U(J), the part of the energy that carries bulk pressure  [Pa], and its derivative.
  template <class T>
  DIPTYCH_INLINE T volumetric_energy(const T& J) const {
    if constexpr (squared_J) {
      return 0.25 * kappa * (J * J - 1.0 - 2.0 * algebra::natural_log(J));
    } else {
      return 0.5 * kappa * (J - 1.0) * (J - 1.0);
    }
  }
  template <class T>
  DIPTYCH_INLINE T volumetric_stress(const T& J) const {
    if constexpr (squared_J) {
      return 0.5 * kappa * (J - 1.0 / J);
    } else {
      return kappa * (J - 1.0);
    }
  }
  double volumetric_modulus() const { return kappa; }  ///< its second derivative at J = 1

  template <class T>
  DIPTYCH_INLINE T energy(const Deformation<T>& X) const {
    const T cbrt_J = algebra::cube_root(X.J);
    return 0.5 * mu * (algebra::contract(X.F, X.F) / (cbrt_J * cbrt_J) - 3.0) +
           volumetric_energy(X.J);
  }

  template <class T>
  DIPTYCH_INLINE Response<T> response(const Deformation<T>& X) const {
    const T inverse_J = 1.0 / X.J;
    const T cbrt_J = algebra::cube_root(X.J);
    const T m = mu / (cbrt_J * cbrt_J);  // mu J^(-2/3)
    const T I1 = algebra::contract(X.F, X.F);
    Response<T> r;
    r.Sigma_F = m * X.F;
    r.Sigma_J = (-1.0 / 3.0) * m * inverse_J * I1;
    r.W_JJ = (5.0 / 9.0) * m * inverse_J * inverse_J * I1;
    r.Sigma_J += volumetric_stress(X.J);
    if constexpr (squared_J) {
      r.W_JJ += 0.5 * kappa * (1.0 + inverse_J * inverse_J);
    } else {
      r.W_JJ += T{} + kappa;
    }
    r.Sigma_H = Tensor<T>{};
    r.A_tot = m * algebra::symmetric_identity<T>();
    r.S_tot = SymmetricTensor<T>{};
    r.W_FJ = (-2.0 / 3.0) * m * inverse_J;
    return r;
  }
};

using IsochoricNeoHookean = IsochoricNeoHookeanFamily<false>;
using IsochoricNeoHookeanJ2 = IsochoricNeoHookeanFamily<true>;

}  // namespace diptych::physics
