#pragma once
/// The deformation triplet {F, H, J} of (1b-d) and its conjugate stresses (7).

#include "common/algebra/tensor.hpp"

namespace diptych::physics {

using algebra::SymmetricTensor;
using algebra::Tensor;
using algebra::Vector;

template <class T>
struct Deformation {
  Tensor<T> F;  ///< deformation gradient [-]
  Tensor<T> H;  ///< its cofactor [-]
  T J;          ///< its determinant [-], > 0
};

/// {F, cof F, det F}
template <class T>
DIPTYCH_INLINE Deformation<T> deformation_of(const Tensor<T>& F) {
  Deformation<T> X;
  X.F = F;
  X.H = algebra::cofactor(F);
  X.J = algebra::determinant(F, X.H);
  return X;
}

/// C^-1 = adj(C) / det C with C = F^T F, from F alone.
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> inverse_C(const Deformation<T>& X) {
  const SymmetricTensor<T> C = algebra::transpose_times_self(X.F);
  const SymmetricTensor<T> adj = algebra::cofactor(C);
  const T det = C(0, 0) * adj(0, 0) + C(0, 1) * adj(0, 1) + C(0, 2) * adj(0, 2);
  return (1.0 / det) * adj;
}

/// G^-1 = C / det C (since G = H^T H = adj C), from F alone.
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> inverse_G(const Deformation<T>& X) {
  const SymmetricTensor<T> C = algebra::transpose_times_self(X.F);
  return (1.0 / algebra::determinant(C)) * C;
}

}  // namespace diptych::physics
