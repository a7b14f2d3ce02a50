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

/// C = F^T F and G = cof C with their inverses, from F alone.
template <class T>
struct RightTensors {
  SymmetricTensor<T> C, inverse_C, G, inverse_G;
};

template <class T>
DIPTYCH_INLINE RightTensors<T> right_tensors(const Tensor<T>& F) {
  RightTensors<T> r;
  r.C = algebra::transpose_times_self(F);
  r.G = algebra::cofactor(r.C);
  const T inverse_det =
      1.0 / (r.C(0, 0) * r.G(0, 0) + r.C(0, 1) * r.G(0, 1) + r.C(0, 2) * r.G(0, 2));
  r.inverse_C = inverse_det * r.G;
  r.inverse_G = inverse_det * r.C;
  return r;
}

}  // namespace diptych::physics
