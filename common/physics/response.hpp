#pragma once
/// What a material answers to a deformation at frozen internal variables: conjugate stresses (7),
/// and the coefficients of the acoustic tensor (notes 2). Materials and Maxwell branches
/// add to it; stress and wave speeds are read off it.

#include "common/physics/deformation.hpp"

namespace diptych::physics {

template <class T>
struct Response {
  // conjugate stresses, Pa
  Tensor<T> Sigma_F;
  Tensor<T> Sigma_H;
  T Sigma_J;
  // second derivatives, Pa: W_FF = A_tot (right factor), W_HH = S_tot, W_JJ, W_FJ (x F)
  SymmetricTensor<T> A_tot;  ///< 2 xi I + sum 2 xi^a A
  SymmetricTensor<T> S_tot;  ///< 2 zeta I + sum 2 zeta^a S
  T W_JJ;
  T W_FJ;  ///< d2W/dF dJ = W_FJ F
};

/// First Piola-Kirchhoff stress (9), P = Sigma_F + Sigma_H x F + Sigma_J H  [Pa].
/// @tparam has_H false where Sigma_H vanishes identically (its cross product is then left out)
template <bool has_H, class T>
DIPTYCH_INLINE Tensor<T> piola_stress(const Response<T>& r, const Deformation<T>& X) {
  Tensor<T> P = r.Sigma_F + r.Sigma_J * X.H;
  if constexpr (has_H) P = P + algebra::cross(r.Sigma_H, X.F);
  return P;
}

}  // namespace diptych::physics
