#pragma once
/// Compressible polyconvex Mooney-Rivlin material (4):
///   W = xi (F:F - 3) + zeta (H:H - 3) - 2 (xi + 2 zeta) ln J + lambda_hat/2 (J - 1)^2,
/// with xi + zeta = mu/2, lambda = lambda_hat + 4 zeta. Conditions: xi > 0, zeta >= 0,
/// lambda_hat > 0. NeoHookean is its zeta = 0 limit, without the work of H.
/// Conjugate stresses (11). Tests: tests/common/physics.

#include "common/physics/moduli.hpp"
#include "common/physics/response.hpp"

namespace diptych::physics {

template <bool with_zeta>
struct MooneyRivlinFamily {
  static constexpr bool has_H = with_zeta;  ///< Sigma_H != 0, G branches possible
  static constexpr bool has_W_FJ = false;
  double xi = 0;          ///< Pa
  double zeta = 0;        ///< Pa
  double lambda_hat = 0;  ///< Pa

  /// @throws base::InputError where the energy would not be polyconvex (moduli.hpp)
  static MooneyRivlinFamily from(const LameConstants& lame, double zeta_ratio) {
    const auto p = mooney_rivlin_parameters(lame, with_zeta ? zeta_ratio : 0);
    return {p.xi, p.zeta, p.lambda_hat};
  }

  double b() const { return 2.0 * (xi + 2.0 * zeta); }

  /// Moduli that Maxwell branches scale: xi^alpha = beta_C xi, zeta^alpha = beta_G zeta.
  double branch_xi() const { return xi; }
  double branch_zeta() const { return with_zeta ? zeta : 0; }

  /// Below this J the logarithm stays with the J of nodes, which nothing else keeps positive where
  /// volumes carry the pressure: at the corners of strips that are pulled to several times their
  /// length it falls to 0.04, while the volumes of cells are five times that (notes 3.9).
  static constexpr double least_bulk_J = 0.05;

  /// The part of the energy that carries bulk pressure, with b = 2 (xi + 2 zeta)
  ///   U(J) = lambda_hat/2 (J - 1)^2 - b (ln J - (J - 1))  [Pa],
  /// the logarithm going on along its tangent below least_bulk_J, and its derivative. What stays
  /// with F and H is linear in J above that, so that a body at rest has no stress in either part.
  template <class T>
  DIPTYCH_INLINE T volumetric_energy(const T& J) const {
    const T J_0 = T{} + least_bulk_J, above = algebra::larger(J, J_0);
    const T logarithm = algebra::natural_log(above) + algebra::smaller(J, J_0) / J_0 - 1.0;
    return 0.5 * lambda_hat * (J - 1.0) * (J - 1.0) - b() * (logarithm - (J - 1.0));
  }
  template <class T>
  DIPTYCH_INLINE T volumetric_stress(const T& J) const {
    return lambda_hat * (J - 1.0) + b() * (1.0 - 1.0 / algebra::larger(J, T{} + least_bulk_J));
  }
  double volumetric_modulus() const { return lambda_hat + b(); }  ///< U''(1)

  /// Energy density (4)  [Pa]
  template <class T>
  DIPTYCH_INLINE T energy(const Deformation<T>& X) const {
    T W = xi * (algebra::contract(X.F, X.F) - 3.0) + 0.5 * lambda_hat * (X.J - 1.0) * (X.J - 1.0) -
          b() * algebra::natural_log(X.J);
    if constexpr (with_zeta) W += zeta * (algebra::contract(X.H, X.H) - 3.0);
    return W;
  }

  template <class T>
  DIPTYCH_INLINE Response<T> response(const Deformation<T>& X) const {
    const T inverse_J = 1.0 / X.J;
    Response<T> r;
    r.Sigma_F = (2.0 * xi) * X.F;
    r.Sigma_J = lambda_hat * (X.J - 1.0) - b() * inverse_J;
    r.A_tot = (2.0 * xi) * algebra::symmetric_identity<T>();
    r.W_JJ = b() * inverse_J * inverse_J + lambda_hat;
    r.W_FJ = T{};
    if constexpr (with_zeta) {
      r.Sigma_H = (2.0 * zeta) * X.H;
      r.S_tot = (2.0 * zeta) * algebra::symmetric_identity<T>();
    } else {
      r.Sigma_H = Tensor<T>{};
      r.S_tot = SymmetricTensor<T>{};
    }
    return r;
  }
};

using MooneyRivlin = MooneyRivlinFamily<true>;
using NeoHookean = MooneyRivlinFamily<false>;

}  // namespace diptych::physics
