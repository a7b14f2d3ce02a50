#pragma once
/// A compressible neo-Hookean rubber whose pressure grows with J^2, as an example of a material:
///   W = mu/2 (F:F - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J).

#include "common/physics/moduli.hpp"
#include "common/physics/response.hpp"

namespace diptych::physics {

struct PlainRubber {
  static constexpr bool has_H = false;
  static constexpr bool has_W_FJ = false;
  double mu = 0;      ///< Pa
  double lambda = 0;  ///< Pa

  static PlainRubber from(const LameConstants& lame, double) { return {lame.mu, lame.lambda}; }
  double branch_xi() const { return 0.5 * mu; }
  double branch_zeta() const { return 0; }

  template <class T>
  DIPTYCH_INLINE T volumetric_energy(const T& J) const {
    return 0.25 * lambda * (J * J - 1.0 - 2.0 * algebra::natural_log(J));
  }
  template <class T>
  DIPTYCH_INLINE T volumetric_stress(const T& J) const {
    return 0.5 * lambda * (J - 1.0 / J);
  }
  double volumetric_modulus() const { return lambda; }

  template <class T>
  DIPTYCH_INLINE T energy(const Deformation<T>& X) const {
    return 0.5 * mu * (algebra::contract(X.F, X.F) - 3.0) + volumetric_energy(X.J) -
           mu * algebra::natural_log(X.J);
  }

  template <class T>
  DIPTYCH_INLINE Response<T> response(const Deformation<T>& X) const {
    const T inverse_J = 1.0 / X.J;
    Response<T> r;
    r.Sigma_F = mu * X.F;
    r.Sigma_H = Tensor<T>{};
    r.Sigma_J = volumetric_stress(X.J) - mu * inverse_J;
    r.A_tot = mu * algebra::symmetric_identity<T>();
    r.S_tot = SymmetricTensor<T>{};
    r.W_JJ = (mu + 0.5 * lambda) * inverse_J * inverse_J + 0.5 * lambda;
    r.W_FJ = T{};
    return r;
  }
};

}  // namespace diptych::physics
