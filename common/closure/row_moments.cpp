#include "common/closure/row_moments.hpp"

#include "common/algebra/four.hpp"
#include "common/algebra/lanes.hpp"

namespace diptych::closure {

namespace {

using algebra::Four;

constexpr int most_terms = 9;

/// sum += a b, from register `first` on.
template <int width>
DIPTYCH_INLINE void add_line(double a, const Four* b, int first, Four* sum) {
  for (int f = first; f < width; ++f)
    sum[f] += a * b[f];
}

template <int N>
DIPTYCH_INLINE void moments_of(
    const FittedRow& row, const double* m, std::int64_t n, double* left, double* whole) {
  constexpr int width = N / 4;
  Four of[width], sum[N][width]{}, mixed[most_terms][width]{}, fit[most_terms][width]{};
  for (std::int64_t p = 0; p < n; ++p, m += N) {
    for (int f = 0; f < width; ++f)
      of[f] = algebra::load_four(m + 4 * f);
    const double k = row.k[p];
#pragma GCC unroll 16
    for (int i = 0; i < N; ++i)
      add_line<width>(k * m[i], of, i / 4, sum[i]);
    const double* q = row.q.data() + p * row.n_terms;
    for (int t = 0; t < row.n_terms; ++t)
      add_line<width>(k * q[t], of, 0, mixed[t]);
  }
  for (int i = 0; i < N; ++i)
    whole[i] = sum[i][i / 4][i % 4];
  for (int t = 0; t < row.n_terms; ++t) {
    for (int s = 0; s < row.n_terms; ++s)
      add_line<width>(row.inverse[t * row.n_terms + s], mixed[s], 0, fit[t]);
#pragma GCC unroll 16
    for (int i = 0; i < N; ++i)
      add_line<width>(-mixed[t][i / 4][i % 4], fit[t], i / 4, sum[i]);
  }
  __builtin_memcpy(left, sum, sizeof sum);
}

DIPTYCH_CLONES void moments_of_8(
    const FittedRow& row, const double* m, std::int64_t n, double* left, double* whole) {
  moments_of<8>(row, m, n, left, whole);
}
DIPTYCH_CLONES void moments_of_16(
    const FittedRow& row, const double* m, std::int64_t n, double* left, double* whole) {
  moments_of<16>(row, m, n, left, whole);
}

}  // namespace

template <>
void fitted_moments<8>(const FittedRow& row,
                       const std::vector<double>& m,
                       double* left,
                       double* whole) {
  moments_of_8(row, m.data(), static_cast<std::int64_t>(m.size()) / 8, left, whole);
}
template <>
void fitted_moments<16>(const FittedRow& row,
                        const std::vector<double>& m,
                        double* left,
                        double* whole) {
  moments_of_16(row, m.data(), static_cast<std::int64_t>(m.size()) / 16, left, whole);
}

}  // namespace diptych::closure
