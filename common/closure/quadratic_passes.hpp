#pragma once
/// The passes over the pairs of quadratic_correction.hpp, a record of a neighbour each; S is the
/// first two. With K = 1/2 y, K_i = 1/2 Y_i:
///   fit    t_ab = K_a - K_b + K_b,i X_i; rho_a, and what the row gives to its closure,
///          sum_b dC_ab = sum_b k_ab t_ab - rho_a . sum_b k_ab q(X)
///   apply  what the neighbours' rows give, dC_ba = k_ab (K_b - K_a - K_a,i X_i - q(-X) . rho_b)
/// Factors of vectors are registers of four equal numbers from the load on.
/// Test: tests/graphs/summation_by_parts_test.cpp

#include "common/algebra/four.hpp"
#include "common/closure/quadratic_correction.hpp"

#include <cstdint>

namespace diptych::closure {

using algebra::Four;
using algebra::load_four;
using algebra::load_three;
using algebra::store_three;

/// What the passes stream.  @tparam Correction  QuadraticCorrection of two or three dimensions
template <class Correction>
struct QuadraticRows {
  const std::int64_t* row;
  const std::int32_t* neighbour;
  const double* k;
  const typename Correction::Square* inverse;      ///< [n_nodes]
  const double* reach;                             ///< [n_nodes]
  const typename Correction::Terms* first_moment;  ///< [n_nodes]
  const double* h;                                 ///< [n_nodes]
};

/// @tparam T  double, or Four of equal numbers
template <int D, class T>
DIPTYCH_INLINE void fill_terms(const T* X, T* q) {
  for (int i = 0; i < D; ++i)
    q[i] = X[i];
  int m = D;
  for (int i = 0; i < D; ++i) {
    for (int j = i; j < D; ++j)
      q[m++] = X[i] * X[j];
  }
}

/// X_b - X_a
template <int D, class Of, class Other>
DIPTYCH_INLINE void fill_difference(const Of& a, const Other& b, Four* X) {
  for (int i = 0; i < D; ++i)
    X[i] = b.value[i][3] - (Four{} + a.value[i][3]);
}

/// K_a - K_b + K_b,i X_i
template <int D, class Jump>
DIPTYCH_INLINE Four jump(const Four& K_a, const Jump& b, const Four* X) {
  Four sum = K_a - load_four(b.value[0]);
  for (int i = 0; i < D; ++i)
    sum += X[i] * load_four(b.value[1 + i]);
  return sum;
}

#define DIPTYCH_DECLARE(Correction)                                                                \
  /** rho of nodes [begin, end), and what their rows give to their closures. */                    \
  /** @param closure  [n_nodes] */                                                                 \
  void fit_rows(const QuadraticRows<Correction>& rows, const Correction::Jump* jumps,              \
                Correction::Fit* fits, Four* closure, std::int64_t begin, std::int64_t end);       \
  /** S y of nodes [begin, end).  @param out  [n_nodes * (1 + dimension)] */                       \
  void apply_rows(const QuadraticRows<Correction>& rows, const Correction::Jump* jumps,            \
                  const Correction::Fit* fits, const Four* closure, Vec3* out, std::int64_t begin, \
                  std::int64_t end);                                                               \
  /** C += dC of the rows of nodes [begin, end).  @param C  [n_pairs] */                           \
  void change_rows(const QuadraticRows<Correction>& rows, const Correction::Jump* jumps,           \
                   const Correction::Fit* fits, Vec3* C, std::int64_t begin, std::int64_t end);    \
  /** Changes rows [begin, end) least to be exact for quadratics.  @param Omega  [n_nodes] */      \
  void correct_rows(const QuadraticRows<Correction>& rows, const Correction::Jump* jumps,          \
                    const double* Omega, Vec3* C, std::int64_t begin, std::int64_t end);
DIPTYCH_DECLARE(QuadraticCorrection<2>)
DIPTYCH_DECLARE(QuadraticCorrection<3>)
#undef DIPTYCH_DECLARE

}  // namespace diptych::closure
