#include "common/run/largest_rates.hpp"

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/classify_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace diptych::run {

namespace {

using algebra::Four;
using algebra::load_three;
using algebra::sum_three;
using algebra::Vec3;
using scheme::PairGraph;
template <class T>
using Field = algebra::AlignedArray<T>;

constexpr int n_iterations = 16;

template <class Work>
void for_nodes(const PairGraph& graph, const Work& work) {
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a)
      work(a);
  });
}

double dot(double u, double v) {
  return u * v;
}
double dot(const Four& u, const Four& v) {
  return sum_three(u * v);
}

template <class T>
double product(const PairGraph& graph, const Field<T>& u, const Field<T>& v) {
  std::vector<double> parts(parallel::n_chunks_of(graph.n_nodes()));
  parallel::for_chunks(graph.n_nodes(),
                       [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
                         for (std::int64_t a = begin; a < end; ++a)
                           parts[chunk] += graph.Omega[a] * dot(u[a], v[a]);
                       });
  return parallel::sum_in_order(parts);
}

/// Numbers in [-1, 1), the same at every call.
class Noise {
 public:
  void fill(double& x) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    x = static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }
  void fill(Four& x) {
    for (int i = 0; i < 3; ++i) {
      double value = 0;
      fill(value);
      x[i] = value;
    }
  }

 private:
  std::uint64_t state_ = 1;
};

/// Largest eigenvalue of the symmetric tridiagonal matrix with this diagonal and the squares of
/// that beside it, by bisection on the signs of its Sturm sequence.
double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside2) {
  double below = 0, above = 0;
  for (size_t i = 0; i < diagonal.size(); ++i) {
    const double left = i > 0 ? std::sqrt(beside2[i - 1]) : 0;
    const double right = i < beside2.size() ? std::sqrt(beside2[i]) : 0;
    above = std::max(above, diagonal[i] + left + right);
  }
  const auto passes_all = [&](double x) {
    double q = 1;
    for (size_t i = 0; i < diagonal.size(); ++i) {
      q = diagonal[i] - x - (i > 0 ? beside2[i - 1] / q : 0);
      if (q >= 0) return false;
    }
    return true;
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    (passes_all(middle) ? above : below) = middle;
  }
  return above;
}

/// Largest eigenvalue of a symmetric, positive operator by the Lanczos recurrence.
template <class T>
double lanczos(const PairGraph& graph,
               const std::function<void(const Field<T>& in, Field<T>& out)>& apply) {
  Field<T> before(graph.n_nodes()), now(graph.n_nodes()), next(graph.n_nodes());
  Noise noise;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a)
    noise.fill(now[a]);
  std::vector<double> diagonal, beside2;
  const double first_length = std::sqrt(product(graph, now, now));
  double beta = 0;
  for_nodes(graph, [&](std::int64_t a) {
    now[a] /= first_length;
    before[a] = 0 * now[a];
  });
  while (true) {
    apply(now, next);
    diagonal.push_back(product(graph, now, next));
    for_nodes(graph,
              [&](std::int64_t a) { next[a] -= diagonal.back() * now[a] + beta * before[a]; });
    beta = std::sqrt(product(graph, next, next));
    // an invariant subspace: the rest is rounding
    if (diagonal.size() == n_iterations || !(beta > 1e-10 * diagonal.front())) break;
    beside2.push_back(beta * beta);
    for_nodes(graph, [&](std::int64_t a) {
      before[a] = now[a];
      now[a] = next[a] / beta;
    });
  }
  return largest_eigenvalue(diagonal, beside2);
}

/// What the operators read of pairs: those of node a are first[kind[a]] to first[kind[a] + 1].
struct Rows {
  const std::int32_t* kind;
  const std::int64_t* first;
  const std::int32_t* neighbour;  ///< of the pairs; b - a where nodes share them
  bool shared;
  const double* inverse_Omega;  ///< of 2 Omega or 4 Omega

  DIPTYCH_INLINE std::int64_t begin(std::int64_t a) const { return first[kind[a]]; }
  DIPTYCH_INLINE std::int64_t end(std::int64_t a) const { return first[kind[a] + 1]; }
  /// From where neighbours of a are counted.
  DIPTYCH_INLINE std::int64_t origin(std::int64_t a) const { return shared ? a : 0; }
};

/// out <- the dissipation operator of v. N_ab = S_ab/sqrt|S_ab| with S_ab twice its size, times
/// sqrt(1 - c_s/c_p); in its fourth place c_s/c_p |S_ab|.
DIPTYCH_CLONES void apply_dissipation(const Rows& rows,
                                      const Four* N,
                                      const Four* v,
                                      Four* out,
                                      std::int64_t begin,
                                      std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    const Four* v_b = v + rows.origin(a);
    Four sum{};
    for (std::int64_t i = rows.begin(a); i < rows.end(a); ++i) {
      const Four n = N[i], jump = v[a] - v_b[rows.neighbour[i]];
      sum += n[3] * jump + sum_three(n * jump) * n;
    }
    out[a] = sum * rows.inverse_Omega[a];
  }
}

/// g <- gradient of u.
DIPTYCH_CLONES void gradient(const Rows& rows,
                             const Vec3* C,
                             const double* u,
                             Four* g,
                             std::int64_t begin,
                             std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    const double* u_b = u + rows.origin(a);
    Four sum{};
    for (std::int64_t i = rows.begin(a); i < rows.end(a); ++i)
      sum += (u_b[rows.neighbour[i]] - u[a]) * load_three(C[i]);
    g[a] = sum * rows.inverse_Omega[a];
  }
}

/// f <- adjoint of the gradient, of p.
/// @param C_reverse  C_ba of the pair (a,b)
/// @param C_sum      [kinds] sum_b C_ab
DIPTYCH_CLONES void adjoint(const Rows& rows,
                            const Vec3* C_reverse,
                            const Four* C_sum,
                            const Four* p,
                            double* f,
                            std::int64_t begin,
                            std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    const Four* p_b = p + rows.origin(a);
    Four sum{};
    for (std::int64_t i = rows.begin(a); i < rows.end(a); ++i)
      sum += p_b[rows.neighbour[i]] * load_three(C_reverse[i]);
    f[a] = sum_three(sum - p[a] * C_sum[rows.kind[a]]) * rows.inverse_Omega[a];
  }
}

/// corrected <- q + kappa_f/Omega_a sum_b [(q_a - q_b) X_ab] S_ab, or with X and S exchanged.
template <bool of_stress>
DIPTYCH_INLINE void correct(const Rows& rows,
                            const Vec3* C,
                            const Vec3* C_reverse,
                            const Four* X,
                            double kappa_f,
                            const Four* q,
                            Four* corrected,
                            std::int64_t begin,
                            std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    Four sum{};
    for (std::int64_t i = rows.begin(a); i < rows.end(a); ++i) {
      const std::int64_t b = rows.origin(a) + rows.neighbour[i];
      const Four S = load_three(C[i]) - load_three(C_reverse[i]);  // twice S_ab
      const Four X_ab = X[b] - X[a], jump = q[a] - q[b];
      sum += of_stress ? sum_three(jump * S) * X_ab : sum_three(jump * X_ab) * S;
    }
    corrected[a] = q[a] + kappa_f * rows.inverse_Omega[a] * sum;
  }
}
DIPTYCH_CLONES void correct_gradient(const Rows& rows,
                                     const Vec3* C,
                                     const Vec3* C_reverse,
                                     const Four* X,
                                     double kappa_f,
                                     const Four* q,
                                     Four* corrected,
                                     std::int64_t begin,
                                     std::int64_t end) {
  correct<false>(rows, C, C_reverse, X, kappa_f, q, corrected, begin, end);
}
DIPTYCH_CLONES void correct_stress(const Rows& rows,
                                   const Vec3* C,
                                   const Vec3* C_reverse,
                                   const Four* X,
                                   double kappa_f,
                                   const Four* q,
                                   Four* corrected,
                                   std::int64_t begin,
                                   std::int64_t end) {
  correct<true>(rows, C, C_reverse, X, kappa_f, q, corrected, begin, end);
}

/// factor / Omega_a
std::vector<double> inverse_volumes(const PairGraph& graph, double factor) {
  std::vector<double> inverse(graph.Omega.size());
  for (size_t a = 0; a < inverse.size(); ++a)
    inverse[a] = factor / graph.Omega[a];
  return inverse;
}

/// work(begin, end) for pieces of all nodes, in parallel.
template <class Work>
void for_ranges(const PairGraph& graph, const Work& work) {
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    work(begin, end);
  });
}

/// A quarter of the nodes: beyond that, geometry that stands once for them is hardly smaller.
constexpr double most_kinds_per_node = 0.25;

}  // namespace

template <class Set>
void LargestRates::for_geometry(const Set& set) const {
  parallel::for_chunks(static_cast<std::int64_t>(kinds_.representative.size()),
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         for (std::int64_t kind = begin; kind < end; ++kind) {
                           const std::int64_t row = graph_.row[kinds_.representative[kind]];
                           for (std::int64_t i = first_[kind]; i < first_[kind + 1]; ++i)
                             set(kind, i, row + i - first_[kind]);
                         }
                       });
}

LargestRates::LargestRates(const PairGraph& graph) : graph_(graph) {
  const scheme::RowClasses classes = scheme::classes_of(graph);
  if (classes.order.empty()) kinds_ = group_by_neighbours(graph, classes, true);
  const auto n_nodes = static_cast<double>(graph.n_nodes());
  const auto n_kinds = static_cast<double>(kinds_.representative.size());
  if (!classes.order.empty() || n_kinds > most_kinds_per_node * n_nodes) {
    kinds_.of.resize(graph.X.size());
    std::iota(kinds_.of.begin(), kinds_.of.end(), 0);
    kinds_.representative = kinds_.of;
  }
  first_.reserve(kinds_.representative.size() + 1);
  first_.push_back(0);
  for (const std::int32_t a : kinds_.representative)
    first_.push_back(first_.back() + graph.row[a + 1] - graph.row[a]);
  if (!shared()) return;
  offset_.resize(static_cast<size_t>(first_.back()));
  for_geometry([&](std::int64_t kind, std::int64_t i, std::int64_t k) {
    offset_[i] = graph.neighbour[k] - kinds_.representative[kind];
  });
}

bool LargestRates::shared() const {
  return first_.back() < graph_.n_pairs();
}

const std::int32_t* LargestRates::neighbours() const {
  return shared() ? offset_.data() : graph_.neighbour.data();
}

double LargestRates::dissipation(double shear_ratio) const {
  Field<Four> N(first_.back());
  for_geometry([&](std::int64_t, std::int64_t i, std::int64_t k) {
    const Vec3 S = graph_.C[k] - graph_.C[graph_.reverse[k]];  // twice S_ab
    const double area = S.norm();
    if (!(area > 0)) return;
    N[i] = load_three(S) * std::sqrt((1 - shear_ratio) / area);
    N[i][3] = shear_ratio * area;
  });
  const std::vector<double> inverse = inverse_volumes(graph_, 0.25);
  const Rows rows{kinds_.of.data(), first_.data(), neighbours(), shared(), inverse.data()};
  return lanczos<Four>(graph_, [&](const Field<Four>& v, Field<Four>& out) {
    for_ranges(graph_, [&](std::int64_t begin, std::int64_t end) {
      apply_dissipation(rows, N.data(), v.data(), out.data(), begin, end);
    });
  });
}

double LargestRates::frequency(double kappa_f) const {
  std::vector<Vec3> C_shared, C_reverse(static_cast<size_t>(first_.back()));
  if (shared()) C_shared.resize(C_reverse.size());
  Field<Four> C_sum(static_cast<std::int64_t>(kinds_.representative.size()));
  for_geometry([&](std::int64_t kind, std::int64_t i, std::int64_t k) {
    C_reverse[i] = graph_.C[graph_.reverse[k]];
    if (shared()) C_shared[i] = graph_.C[k];
    C_sum[kind] += load_three(graph_.C[k]);
  });
  const Vec3* C = shared() ? C_shared.data() : graph_.C.data();
  const std::vector<double> inverse = inverse_volumes(graph_, 0.5);
  const Rows rows{kinds_.of.data(), first_.data(), neighbours(), shared(), inverse.data()};
  Field<Four> X, g(graph_.n_nodes()), corrected;
  if (kappa_f != 0) {
    X = Field<Four>(graph_.n_nodes());
    corrected = Field<Four>(graph_.n_nodes());
    for_nodes(graph_, [&](std::int64_t a) { X[a] = load_three(graph_.X[a]); });
  }
  return std::sqrt(lanczos<double>(graph_, [&](const Field<double>& u, Field<double>& out) {
    const auto pass = [&](const auto& work) { for_ranges(graph_, work); };
    pass([&](auto begin, auto end) { gradient(rows, C, u.data(), g.data(), begin, end); });
    if (kappa_f != 0) {
      pass([&](auto begin, auto end) {
        correct_gradient(rows, C, C_reverse.data(), X.data(), kappa_f, g.data(), corrected.data(),
                         begin, end);
      });
      pass([&](auto begin, auto end) {
        correct_stress(rows, C, C_reverse.data(), X.data(), kappa_f, corrected.data(), g.data(),
                       begin, end);
      });
    }
    pass([&](auto begin, auto end) {
      adjoint(rows, C_reverse.data(), C_sum.data(), g.data(), out.data(), begin, end);
    });
  }));
}

}  // namespace diptych::run
