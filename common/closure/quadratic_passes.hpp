#pragma once
/// The two passes over the pairs that S of quadratic_correction.hpp is made of, a record of a
/// neighbour each: rho_a of every row, then what a row and its neighbours' rows give to the
/// conditions of its node. Test: tests/graphs/summation_by_parts_test.cpp

#include "common/algebra/four.hpp"
#include "common/closure/quadratic_correction.hpp"

#include <cstdint>

namespace diptych::closure {

using algebra::Four;
using algebra::load_four;
using algebra::load_three;
using algebra::store_three;

/// What the passes stream.
struct WeightedRows {
  const std::int64_t* row;
  const std::int32_t* neighbour;
  const double* k;
};

template <int D>
DIPTYCH_INLINE void fill_terms(const double* X, double* q) {
  for (int i = 0; i < D; ++i)
    q[i] = X[i];
  int m = D;
  for (int i = 0; i < D; ++i) {
    for (int j = i; j < D; ++j)
      q[m++] = X[i] * X[j];
  }
}

/// Sum over the terms of q(X) rho; turned: q(-X) rho.
template <int D, bool turned>
DIPTYCH_INLINE Four fitted(const double* q, const double (*rho)[4]) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  Four odd = q[0] * load_four(rho[0]), even = q[D] * load_four(rho[D]);
  for (int m = 1; m < D; ++m)
    odd += q[m] * load_four(rho[m]);
  for (int m = D + 1; m < n; ++m)
    even += q[m] * load_four(rho[m]);
  return turned ? even - odd : even + odd;
}

/// 1/2 (y_a - y_b + Y_b (X_b - X_a))
template <int D, class Record>
DIPTYCH_INLINE Four jump(const Record& a, const Record& b, const double* X) {
  Four sum = load_four(a.value[0]) - load_four(b.value[0]);
  for (int i = 0; i < D; ++i)
    sum += X[i] * load_four(b.value[1 + i]);
  return 0.5 * sum;
}

template <class Record>
DIPTYCH_INLINE void difference(const Record& a, const Record& b, double* X) {
  for (int i = 0; i < 3; ++i)
    X[i] = b.value[i][3] - a.value[i][3];
}

/// rho of nodes [begin, end).  @param inverse, reach  [n_nodes] of QuadraticCorrection
#define DIPTYCH_DECLARE(D)                                                                      \
  void fit_rows(const WeightedRows& rows, const QuadraticCorrection<D>::Square* inverse,        \
                const double* reach, QuadraticCorrection<D>::Record* nodes, std::int64_t begin, \
                std::int64_t end);
DIPTYCH_DECLARE(2)
DIPTYCH_DECLARE(3)
#undef DIPTYCH_DECLARE

/// What they add to the conditions of nodes [begin, end).
/// @param h    [n_nodes] m
/// @param out  [n_nodes * (1 + dimension)]
#define DIPTYCH_DECLARE(D)                                                               \
  void apply_rows(const WeightedRows& rows, const QuadraticCorrection<D>::Record* nodes, \
                  const double* h, Vec3* out, std::int64_t begin, std::int64_t end);
DIPTYCH_DECLARE(2)
DIPTYCH_DECLARE(3)
#undef DIPTYCH_DECLARE

}  // namespace diptych::closure
