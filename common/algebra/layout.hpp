#pragma once
/// Formulae in 3x3, dimension in the storage: which components a tensor keeps. Plane strain stores
/// in-plane components and those out of plane that change; the rest are constants put in on load.
/// What is I at rest is stored as its deviation from I, so that small strains keep their digits in
/// single precision too.
///
///            3-D                        plane strain
///   F        all nine                   11 12 21 22          (F_33 = 1)
///   H        all nine                   11 12 21 22 33       (H_33 = J)
///   A        11 22 33 12 13 23          11 22 12             (A_33 = 1 stays)
///   S        11 22 33 12 13 23          11 22 12 33          (S_33 evolves)

#include "common/algebra/lanes.hpp"
#include "common/algebra/tensor.hpp"

namespace diptych::algebra {

template <int Dim>
struct Layout {
  static constexpr int n_F = Dim * Dim;
  static constexpr int n_H = Dim == 3 ? 9 : 5;
  static constexpr int n_A = Dim == 3 ? 6 : 3;
  static constexpr int n_S = Dim == 3 ? 6 : 4;
};

/// A tensor of block b from components c.. of a table or field: in-plane part row-major.
/// @param diagonal  added to the whole diagonal: 1 where the deviation from I is stored (F - I,
///                  H - I), 0 for rates and stresses
template <int Dim, class Field>
DIPTYCH_INLINE Tensor<Lanes> get_tensor(const Field& field,
                                        std::int64_t b,
                                        int c,
                                        double diagonal = 0) {
  Tensor<Lanes> T{};
  field.template get_each<Dim * Dim>(b, c, [&](int k, const Lanes& value) DIPTYCH_INLINE_LAMBDA {
    T(k / Dim, k % Dim) = k % (Dim + 1) == 0 ? value + diagonal : value;
  });
  if constexpr (Dim == 2) T(2, 2) = Lanes{} + diagonal;
  return T;
}
/// Writes the in-plane part, the diagonal less `diagonal`.
template <int Dim, class Field>
DIPTYCH_INLINE void put_tensor(
    Field& field, std::int64_t b, int c, const Tensor<Lanes>& T, double diagonal = 0) {
  field.template put_each<Dim * Dim>(b, c, [&](int k) DIPTYCH_INLINE_LAMBDA {
    const Lanes& value = T(k / Dim, k % Dim);
    return k % (Dim + 1) == 0 ? value - diagonal : value;
  });
}

/// Where component k of A and S stands in 11 22 33 12 13 23.
template <int Dim>
inline constexpr int order_of_A[6] = {0, 1, Dim == 3 ? 2 : 3, 3, 4, 5};
template <int Dim>
inline constexpr int order_of_S[6] = {0, 1, Dim == 3 ? 2 : 3, Dim == 3 ? 3 : 2, 4, 5};

/// A symmetric tensor of block b from components c.. of a field, which holds its deviation from I.
template <int n, class Field>
DIPTYCH_INLINE SymmetricTensor<Lanes> get_symmetric(const Field& field,
                                                    std::int64_t b,
                                                    int c,
                                                    const int (&order)[6]) {
  auto T = symmetric_identity<Lanes>();
  field.template get_each<n>(
      b, c, [&](int k, const Lanes& value) DIPTYCH_INLINE_LAMBDA { T.s[order[k]] += value; });
  return T;
}
template <int n, class Field>
DIPTYCH_INLINE void put_symmetric(
    Field& field, std::int64_t b, int c, const int (&order)[6], const SymmetricTensor<Lanes>& T) {
  field.template put_each<n>(b, c, [&](int k) DIPTYCH_INLINE_LAMBDA {
    const Lanes& value = T.s[order[k]];
    return order[k] < 3 ? value - 1.0 : value;
  });
}

template <int Dim, class Field>
DIPTYCH_INLINE SymmetricTensor<Lanes> get_A(const Field& field, std::int64_t b, int c) {
  return get_symmetric<Layout<Dim>::n_A>(field, b, c, order_of_A<Dim>);
}
template <int Dim, class Field>
DIPTYCH_INLINE void put_A(Field& field, std::int64_t b, int c, const SymmetricTensor<Lanes>& A) {
  put_symmetric<Layout<Dim>::n_A>(field, b, c, order_of_A<Dim>, A);
}
template <int Dim, class Field>
DIPTYCH_INLINE SymmetricTensor<Lanes> get_S(const Field& field, std::int64_t b, int c) {
  return get_symmetric<Layout<Dim>::n_S>(field, b, c, order_of_S<Dim>);
}
template <int Dim, class Field>
DIPTYCH_INLINE void put_S(Field& field, std::int64_t b, int c, const SymmetricTensor<Lanes>& S) {
  put_symmetric<Layout<Dim>::n_S>(field, b, c, order_of_S<Dim>, S);
}

}  // namespace diptych::algebra
