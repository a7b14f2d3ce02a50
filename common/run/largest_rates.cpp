#include "common/run/largest_rates.hpp"

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/lanczos.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace diptych::run {

namespace {

using algebra::Four;
using algebra::load_three;
using algebra::sum_three;
using algebra::Vec3;
using lanczos::Field;
using lanczos::for_nodes;
using lanczos::largest_eigenvalue;
using scheme::PairGraph;
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

/// g_i, the gradients of the components of a displacement at node a, become the rows of the stress
/// lambda tr(e) I + 2 mu e.
void stress_of(
    int dimension, double lambda, double mu, std::array<Field<Four>, 3>& g, std::int64_t a) {
  double trace = 0;
  for (int i = 0; i < dimension; ++i)
    trace += g[i][a][i];
  for (int i = 0; i < dimension; ++i) {
    for (int j = 0; j < i; ++j) {
      const double shear = mu * (g[i][a][j] + g[j][a][i]);
      g[i][a][j] = shear;
      g[j][a][i] = shear;
    }
    g[i][a][i] = lambda * trace + 2 * mu * g[i][a][i];
  }
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

/// The dissipation operator of plain jumps.
class LargestRates::Dissipation {
 public:
  Dissipation(const LargestRates& rates, double shear_ratio)
      : graph_(rates.graph_),
        N_(rates.first_.back()),
        inverse_(inverse_volumes(graph_, 0.25)),
        rows_{rates.kinds_.of.data(), rates.first_.data(), rates.neighbours(), rates.shared(),
              inverse_.data()} {
    rates.for_geometry([&](std::int64_t, std::int64_t i, std::int64_t k) {
      const Vec3 S = graph_.C[k] - graph_.C[graph_.reverse[k]];  // twice S_ab
      const std::int64_t a = graph_.neighbour[graph_.reverse[k]], b = graph_.neighbour[k];
      const double area = scheme::dissipation_area(S, graph_.X[b] - graph_.X[a]);
      if (!(area > 0)) return;
      N_[i] = load_three(S) * std::sqrt((1 - shear_ratio) / area);
      N_[i][3] = shear_ratio * area;
    });
  }

  void apply(const Field<Four>& v, Field<Four>& out) const {
    for_ranges(graph_, [&](std::int64_t begin, std::int64_t end) {
      apply_dissipation(rows_, N_.data(), v.data(), out.data(), begin, end);
    });
  }

 private:
  const PairGraph& graph_;
  Field<Four> N_;
  std::vector<double> inverse_;
  Rows rows_;
};

double LargestRates::dissipation(double shear_ratio) const {
  const Dissipation D(*this, shear_ratio);
  return largest_eigenvalue<Four>(graph_,
                                  [&](const Field<Four>& v, Field<Four>& out) { D.apply(v, out); });
}

/// The gradient of (18b) of one component and its adjoint, with the face correction.
class LargestRates::Gradient {
 public:
  Gradient(const LargestRates& rates, double kappa_f)
      : graph_(rates.graph_),
        kappa_f_(kappa_f),
        C_reverse_(static_cast<size_t>(rates.first_.back())),
        C_sum_(static_cast<std::int64_t>(rates.kinds_.representative.size())),
        inverse_(inverse_volumes(graph_, 0.5)),
        rows_{rates.kinds_.of.data(), rates.first_.data(), rates.neighbours(), rates.shared(),
              inverse_.data()} {
    if (rates.shared()) C_shared_.resize(C_reverse_.size());
    rates.for_geometry([&](std::int64_t kind, std::int64_t i, std::int64_t k) {
      C_reverse_[i] = graph_.C[graph_.reverse[k]];
      if (rates.shared()) C_shared_[i] = graph_.C[k];
      C_sum_[kind] += load_three(graph_.C[k]);
    });
    C_ = rates.shared() ? C_shared_.data() : graph_.C.data();
    if (kappa_f == 0) return;
    X_ = Field<Four>(graph_.n_nodes());
    corrected_ = Field<Four>(graph_.n_nodes());
    for_nodes(graph_, [&](std::int64_t a) { X_[a] = load_three(graph_.X[a]); });
  }

  void of(const Field<double>& u, Field<Four>& g) {
    pass([&](auto begin, auto end) { gradient(rows_, C_, u.data(), g.data(), begin, end); });
    if (kappa_f_ == 0) return;
    pass([&](auto begin, auto end) {
      correct_gradient(rows_, C_, C_reverse_.data(), X_.data(), kappa_f_, g.data(),
                       corrected_.data(), begin, end);
    });
    std::swap(g, corrected_);
  }

  /// @param p  is lost
  void adjoint_of(Field<Four>& p, Field<double>& f) {
    if (kappa_f_ != 0) {
      pass([&](auto begin, auto end) {
        correct_stress(rows_, C_, C_reverse_.data(), X_.data(), kappa_f_, p.data(),
                       corrected_.data(), begin, end);
      });
      std::swap(p, corrected_);
    }
    pass([&](auto begin, auto end) {
      adjoint(rows_, C_reverse_.data(), C_sum_.data(), p.data(), f.data(), begin, end);
    });
  }

 private:
  template <class Work>
  void pass(const Work& work) const {
    for_ranges(graph_, work);
  }

  const PairGraph& graph_;
  double kappa_f_;
  std::vector<Vec3> C_shared_, C_reverse_;
  const Vec3* C_ = nullptr;
  Field<Four> C_sum_, X_, corrected_;
  std::vector<double> inverse_;
  Rows rows_;
};

double LargestRates::frequency(double kappa_f) const {
  Gradient G(*this, kappa_f);
  Field<Four> g(graph_.n_nodes());
  return std::sqrt(
      largest_eigenvalue<double>(graph_, [&](const Field<double>& u, Field<double>& out) {
        G.of(u, g);
        G.adjoint_of(g, out);
      }));
}

/// u -> G* (lambda tr(e) I + 2 mu e), e the symmetric part of G u.
class LargestRates::Elasticity {
 public:
  Elasticity(const LargestRates& rates, double kappa_f, double shear_ratio)
      : graph_(rates.graph_),
        G_(rates, kappa_f),
        mu_(shear_ratio * shear_ratio),
        lambda_(1 - 2 * mu_),
        u_(graph_.n_nodes()),
        f_(graph_.n_nodes()) {
    for (int i = 0; i < graph_.dimension; ++i)
      g_[i] = Field<Four>(graph_.n_nodes());
  }

  void apply(const Field<Four>& u, Field<Four>& out) {
    for (int i = 0; i < graph_.dimension; ++i) {
      for_nodes(graph_, [&](std::int64_t a) { u_[a] = u[a][i]; });
      G_.of(u_, g_[i]);
    }
    for_nodes(graph_, [&](std::int64_t a) {
      stress_of(graph_.dimension, lambda_, mu_, g_, a);
      out[a] = Four{};
    });
    for (int i = 0; i < graph_.dimension; ++i) {
      G_.adjoint_of(g_[i], f_);
      for_nodes(graph_, [&](std::int64_t a) { out[a][i] = f_[a]; });
    }
  }

 private:
  const PairGraph& graph_;
  Gradient G_;
  double mu_, lambda_;
  Field<double> u_, f_;
  std::array<Field<Four>, 3> g_;
};

double LargestRates::elastic_frequency(double kappa_f, double shear_ratio) const {
  Elasticity K(*this, kappa_f, shear_ratio);
  return std::sqrt(largest_eigenvalue<Four>(
      graph_, [&](const Field<Four>& u, Field<Four>& out) { K.apply(u, out); }));
}

double LargestRates::leapfrog_limit(double dt,
                                    double kappa_f,
                                    double shear_ratio,
                                    double strength) const {
  Elasticity K(*this, kappa_f, shear_ratio);
  const Dissipation D(*this, shear_ratio);
  Field<Four> damped(graph_.n_nodes());
  return largest_eigenvalue<Four>(graph_, [&](const Field<Four>& v, Field<Four>& out) {
    K.apply(v, out);
    D.apply(v, damped);
    for_nodes(graph_, [&](std::int64_t a) {
      out[a] = 0.25 * dt * dt * out[a] + 0.5 * dt * strength * damped[a];
    });
  });
}

}  // namespace diptych::run
