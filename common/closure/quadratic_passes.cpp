#include "common/closure/quadratic_passes.hpp"

namespace diptych::closure {

namespace {

/// rho = (sum_b k q q^T)^-1 moment, from the inverse for X/reach.
template <int D>
DIPTYCH_INLINE void solve_moments(const QuadraticRows<QuadraticCorrection<D>>& rows,
                                  std::int64_t a,
                                  Four* moment,
                                  Four* rho) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  const double reach = rows.reach[a];
  const auto unit = [&](int m) { return m < D ? 1 / reach : 1 / (reach * reach); };
  for (int m = 0; m < n; ++m)
    moment[m] *= unit(m);
#pragma GCC unroll 1
  for (int m = 0; m < n; ++m) {
    Four sum{};
    for (int l = 0; l < n; ++l)
      sum += rows.inverse[a](l, m) * moment[l];
    rho[m] = unit(m) * sum;
  }
}

template <int D>
DIPTYCH_INLINE void fit_nodes(const QuadraticRows<QuadraticCorrection<D>>& rows,
                              const typename QuadraticCorrection<D>::Jump* jumps,
                              typename QuadraticCorrection<D>::Fit* fits,
                              Four* closure,
                              std::int64_t begin,
                              std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  Four X[D], q[n];
  for (std::int64_t a = begin; a < end; ++a) {
    const Four K = load_four(jumps[a].value[0]);
    Four sum{}, moment[n]{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const auto& b = jumps[rows.neighbour[p]];
      fill_difference<D>(jumps[a], b, X);
      fill_terms<D>(X, q);
      const Four t = rows.k[p] * jump<D>(K, b, X);
      sum += t;
      for (int m = 0; m < n; ++m)
        moment[m] += q[m] * t;
    }
    Four rho[n];
    solve_moments<D>(rows, a, moment, rho);
    for (int m = 0; m < n; ++m) {
      sum -= rows.first_moment[a][m] * rho[m];
      store_three(fits[a].value[1 + m], rho[m]);
    }
    store_three(fits[a].value[0], K);
    closure[a] = sum;
  }
}

template <int D>
DIPTYCH_INLINE void apply_to_nodes(const QuadraticRows<QuadraticCorrection<D>>& rows,
                                   const typename QuadraticCorrection<D>::Jump* jumps,
                                   const typename QuadraticCorrection<D>::Fit* fits,
                                   const Four* closure,
                                   Vec3* out,
                                   std::int64_t begin,
                                   std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  Four X[D], q[n], slope[D];
  for (std::int64_t a = begin; a < end; ++a) {
    const Four K = load_four(jumps[a].value[0]);
    for (int i = 0; i < D; ++i)
      slope[i] = load_four(jumps[a].value[1 + i]);
    Four sum{}, linear[D]{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const auto& b = fits[rows.neighbour[p]];
      fill_difference<D>(jumps[a], b, X);
      fill_terms<D>(X, q);
      Four odd = load_four(b.value[0]) - K, even = q[D] * load_four(b.value[1 + D]);
      for (int i = 0; i < D; ++i)
        odd += X[i] * (load_four(b.value[1 + i]) - slope[i]);
      for (int m = D + 1; m < n; ++m)
        even += q[m] * load_four(b.value[1 + m]);
      const Four back = rows.k[p] * (odd - even);
      sum += back;
      for (int i = 0; i < D; ++i)
        linear[i] += X[i] * back;
    }
    Vec3* of_node = out + a * (1 + D);
    store_three(of_node[0].data(), 0.5 * (closure[a] - sum));
    for (int i = 0; i < D; ++i)
      store_three(of_node[1 + i].data(), -0.5 / rows.h[a] * linear[i]);
  }
}

template <int D>
DIPTYCH_INLINE void change_nodes(const QuadraticRows<QuadraticCorrection<D>>& rows,
                                 const typename QuadraticCorrection<D>::Jump* jumps,
                                 const typename QuadraticCorrection<D>::Fit* fits,
                                 Vec3* C,
                                 std::int64_t begin,
                                 std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  Four X[D], q[n];
  for (std::int64_t a = begin; a < end; ++a) {
    const Four K = load_four(jumps[a].value[0]);
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const auto& b = jumps[rows.neighbour[p]];
      fill_difference<D>(jumps[a], b, X);
      fill_terms<D>(X, q);
      Four left = jump<D>(K, b, X);
      for (int m = 0; m < n; ++m)
        left -= q[m] * load_four(fits[a].value[1 + m]);
      store_three(C[p].data(), load_three(C[p]) + rows.k[p] * left);
    }
  }
}

template <int D>
DIPTYCH_INLINE void correct_nodes(const QuadraticRows<QuadraticCorrection<D>>& rows,
                                  const typename QuadraticCorrection<D>::Jump* jumps,
                                  const double* Omega,
                                  Vec3* C,
                                  std::int64_t begin,
                                  std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  Four X[D], q[n], rho[n];
  for (std::int64_t a = begin; a < end; ++a) {
    Four missing[n]{};
    for (int i = 0; i < D; ++i)
      missing[i][i] = 2 * Omega[a];
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      fill_difference<D>(jumps[a], jumps[rows.neighbour[p]], X);
      fill_terms<D>(X, q);
      const Four of_pair = load_three(C[p]);
      for (int m = 0; m < n; ++m)
        missing[m] -= q[m] * of_pair;
    }
    solve_moments<D>(rows, a, missing, rho);
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      fill_difference<D>(jumps[a], jumps[rows.neighbour[p]], X);
      fill_terms<D>(X, q);
      Four change{};
      for (int m = 0; m < n; ++m)
        change += q[m] * rho[m];
      store_three(C[p].data(), load_three(C[p]) + rows.k[p] * change);
    }
  }
}

}  // namespace

#define DIPTYCH_INSTANTIATE(D)                                                                     \
  DIPTYCH_CLONES void fit_rows(const QuadraticRows<QuadraticCorrection<D>>& rows,                  \
                               const QuadraticCorrection<D>::Jump* jumps,                          \
                               QuadraticCorrection<D>::Fit* fits, Four* closure,                   \
                               std::int64_t begin, std::int64_t end) {                             \
    fit_nodes<D>(rows, jumps, fits, closure, begin, end);                                          \
  }                                                                                                \
  DIPTYCH_CLONES void apply_rows(const QuadraticRows<QuadraticCorrection<D>>& rows,                \
                                 const QuadraticCorrection<D>::Jump* jumps,                        \
                                 const QuadraticCorrection<D>::Fit* fits, const Four* closure,     \
                                 Vec3* out, std::int64_t begin, std::int64_t end) {                \
    apply_to_nodes<D>(rows, jumps, fits, closure, out, begin, end);                                \
  }                                                                                                \
  DIPTYCH_CLONES void change_rows(const QuadraticRows<QuadraticCorrection<D>>& rows,               \
                                  const QuadraticCorrection<D>::Jump* jumps,                       \
                                  const QuadraticCorrection<D>::Fit* fits, Vec3* C,                \
                                  std::int64_t begin, std::int64_t end) {                          \
    change_nodes<D>(rows, jumps, fits, C, begin, end);                                             \
  }                                                                                                \
  DIPTYCH_CLONES void correct_rows(const QuadraticRows<QuadraticCorrection<D>>& rows,              \
                                   const QuadraticCorrection<D>::Jump* jumps, const double* Omega, \
                                   Vec3* C, std::int64_t begin, std::int64_t end) {                \
    correct_nodes<D>(rows, jumps, Omega, C, begin, end);                                           \
  }
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::closure
