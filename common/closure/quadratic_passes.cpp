#include "common/closure/quadratic_passes.hpp"

namespace diptych::closure {

namespace {

/// rho of nodes [begin, end).
template <int D, class Record, class Square>
DIPTYCH_INLINE void fit_nodes(const WeightedRows& rows,
                              const Square* inverse,
                              const double* reach,
                              Record* nodes,
                              std::int64_t begin,
                              std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  double X[3], q[n];
  for (std::int64_t a = begin; a < end; ++a) {
    Record& node = nodes[a];
    Four moment[n]{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const Record& b = nodes[rows.neighbour[p]];
      difference(node, b, X);
      fill_terms<D>(X, q);
      const Four t = rows.k[p] * jump<D>(node, b, X);
      for (int m = 0; m < n; ++m)
        moment[m] += q[m] * t;
    }
    // the inverse is that of X/reach
    const auto unit = [&](int m) { return m < D ? 1 / reach[a] : 1 / (reach[a] * reach[a]); };
    for (int m = 0; m < n; ++m)
      moment[m] *= unit(m);
#pragma GCC unroll 1
    for (int m = 0; m < n; ++m) {
      Four sum{};
      for (int l = 0; l < n; ++l)
        sum += inverse[a](l, m) * moment[l];
      store_three(node.rho[m], unit(m) * sum);
    }
  }
}

template <int D, class Record>
DIPTYCH_INLINE void apply_nodes(const WeightedRows& rows,
                                const Record* nodes,
                                const double* h,
                                Vec3* out,
                                std::int64_t begin,
                                std::int64_t end) {
  constexpr int n = QuadraticCorrection<D>::n_terms;
  double X[3], q[n];
  for (std::int64_t a = begin; a < end; ++a) {
    const Record& node = nodes[a];
    Four closure{}, linear[D]{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const Record& b = nodes[rows.neighbour[p]];
      difference(node, b, X);
      fill_terms<D>(X, q);
      const Four forth = rows.k[p] * (jump<D>(node, b, X) - fitted<D, false>(q, node.rho));
      for (int i = 0; i < D; ++i)
        X[i] = -X[i];
      const Four back = rows.k[p] * (jump<D>(b, node, X) - fitted<D, true>(q, b.rho));
      closure += forth - back;
      for (int i = 0; i < D; ++i)
        linear[i] += X[i] * back;
    }
    Vec3* of_node = out + a * (1 + D);
    store_three(of_node[0].data(), 0.5 * closure);
    for (int i = 0; i < D; ++i)
      store_three(of_node[1 + i].data(), 0.5 / h[a] * linear[i]);
  }
}

}  // namespace

#define DIPTYCH_INSTANTIATE(D)                                                                     \
  DIPTYCH_CLONES void fit_rows(const WeightedRows& rows,                                           \
                               const QuadraticCorrection<D>::Square* inverse, const double* reach, \
                               QuadraticCorrection<D>::Record* nodes, std::int64_t begin,          \
                               std::int64_t end) {                                                 \
    fit_nodes<D>(rows, inverse, reach, nodes, begin, end);                                         \
  }                                                                                                \
  DIPTYCH_CLONES void apply_rows(const WeightedRows& rows,                                         \
                                 const QuadraticCorrection<D>::Record* nodes, const double* h,     \
                                 Vec3* out, std::int64_t begin, std::int64_t end) {                \
    apply_nodes<D>(rows, nodes, h, out, begin, end);                                               \
  }
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::closure
