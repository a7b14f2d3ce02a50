#pragma once
/// Formulae in 3x3, dimension in the storage: which components a tensor keeps. Plane strain stores
/// in-plane components and those out of plane that change; the rest are constants put in on load.
///
///            3-D                        plane strain
///   F        all nine                   11 12 21 22          (F_33 = 1)
///   H        all nine                   11 12 21 22 33       (H_33 = J)
///   A        11 22 33 12 13 23          11 22 12             (A_33 = 1 stays)
///   S        11 22 33 12 13 23          11 22 12 33          (S_33 evolves)

#include "common/algebra/tensor.hpp"

namespace diptych::algebra {

template <int Dim>
struct Layout {
  static constexpr int n_F = Dim * Dim;
  static constexpr int n_H = Dim == 3 ? 9 : 5;
  static constexpr int n_A = Dim == 3 ? 6 : 3;
  static constexpr int n_S = Dim == 3 ? 6 : 4;
};

/// In-plane part of a tensor, row-major; out-of-plane diagonal as given (1 for F, 0 for rates).
template <int Dim>
DIPTYCH_INLINE Tensor<Lanes> load_tensor(const double* block, double diagonal_33) {
  Tensor<Lanes> T{};
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j)
      T(i, j) = load(block + (i * Dim + j) * n_lanes);
  if constexpr (Dim == 2) T(2, 2) = Lanes{} + diagonal_33;
  return T;
}
template <int Dim>
DIPTYCH_INLINE void store_tensor(double* block, const Tensor<Lanes>& T) {
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      store(block + (i * Dim + j) * n_lanes, T(i, j));
}

template <int Dim>
DIPTYCH_INLINE SymmetricTensor<Lanes> load_A(const double* block) {
  SymmetricTensor<Lanes> A{};
  if constexpr (Dim == 3) {
    for (int k = 0; k < 6; ++k)
      A.s[k] = load(block + k * n_lanes);
  } else {
    A.s[0] = load(block);
    A.s[1] = load(block + n_lanes);
    A.s[2] = Lanes{} + 1.0;
    A.s[3] = load(block + 2 * n_lanes);
  }
  return A;
}
template <int Dim>
DIPTYCH_INLINE void store_A(double* block, const SymmetricTensor<Lanes>& A) {
  if constexpr (Dim == 3) {
    for (int k = 0; k < 6; ++k)
      store(block + k * n_lanes, A.s[k]);
  } else {
    store(block, A.s[0]);
    store(block + n_lanes, A.s[1]);
    store(block + 2 * n_lanes, A.s[3]);
  }
}

template <int Dim>
DIPTYCH_INLINE SymmetricTensor<Lanes> load_S(const double* block) {
  SymmetricTensor<Lanes> S = load_A<Dim>(block);
  if constexpr (Dim == 2) S.s[2] = load(block + 3 * n_lanes);
  return S;
}
template <int Dim>
DIPTYCH_INLINE void store_S(double* block, const SymmetricTensor<Lanes>& S) {
  store_A<Dim>(block, S);
  if constexpr (Dim == 2) store(block + 3 * n_lanes, S.s[2]);
}

}  // namespace diptych::algebra
