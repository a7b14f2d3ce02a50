#include "common/scheme/hourglass/hourglass_control.hpp"

#include "common/algebra/four.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/reduction.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/ranks/division.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::Four;
using algebra::load_four;
using algebra::n_lanes;

namespace {

template <int Dim>
constexpr std::int64_t length = 8 + 4 * Dim;  ///< of a node in at_

/// What the sums over the edges of a node read.
struct Edges {
  const std::int64_t* row;
  const std::int32_t* neighbour;
  const double* weight;
  const double* at;
};

/// use(e, X_ab, k_ab) of the edges of node a.
template <int Dim, class Use>
DIPTYCH_INLINE void for_edges(const Edges& edges, std::int64_t a, const Use& use) {
  const double* const own = edges.at + a * length<Dim>;
  const Four X_a = load_four(own), u_a = load_four(own + 4);
  Four F_a[Dim];
  for (int j = 0; j < Dim; ++j)
    F_a[j] = load_four(own + 8 + 4 * j);
  for (std::int64_t p = edges.row[a]; p < edges.row[a + 1]; ++p) {
    const double* const other = edges.at + edges.neighbour[p] * length<Dim>;
    const Four X_ab = load_four(other) - X_a;
    Four slopes{};
    for (int j = 0; j < Dim; ++j)
      slopes += (load_four(other + 8 + 4 * j) + F_a[j]) * X_ab[j];
    use(load_four(other + 4) - u_a - 0.5 * slopes, X_ab, edges.weight[p]);
  }
}

DIPTYCH_INLINE void store(double* p, const Four& value) {
  __builtin_memcpy(p, &value, sizeof value);
}

template <int Dim>
DIPTYCH_CLONES void sum_of_nodes(const Edges& edges,
                                 double modulus,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 double* force,
                                 double* N) {
  for (std::int64_t a = begin; a < end; ++a) {
    Four f{}, columns[Dim] = {};
    for_edges<Dim>(edges, a, [&](const Four& e, const Four& X_ab, double k) DIPTYCH_INLINE_LAMBDA {
      const Four pull = k * e;
      f += pull;
      for (int j = 0; j < Dim; ++j)
        columns[j] += pull * X_ab[j];
    });
    store(force + 4 * a, modulus * f);
    for (int j = 0; j < Dim; ++j)
      store(N + 4 * (Dim * a + j), 0.5 * modulus * columns[j]);
  }
}

template <int Dim>
DIPTYCH_CLONES double energy_of_nodes(const Edges& edges, std::int64_t begin, std::int64_t end) {
  double sum = 0;
  for (std::int64_t a = begin; a < end; ++a) {
    for_edges<Dim>(edges, a, [&](const Four& e, const Four&, double k) DIPTYCH_INLINE_LAMBDA {
      sum += k * algebra::sum_three(e * e);
    });
  }
  return sum;
}

/// work(begin, end, chunk) of the nodes that this rank has.
template <int Dim, class Work>
void for_nodes(const Body<Dim>& body, std::int64_t n_nodes, const Work& work) {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
                         work(begin * n_lanes, std::min(end * n_lanes, n_nodes), c);
                       });
}

}  // namespace

template <int Dim>
HourglassControl<Dim>::HourglassControl(const PairGraph& graph)
    : n_nodes_(graph.n_nodes()),
      row_(graph.X.size() + 1, 0),
      at_(algebra::n_blocks_of(n_nodes_) * n_lanes * length<Dim>),
      force_(algebra::n_blocks_of(n_nodes_) * n_lanes * 4),
      N_(algebra::n_blocks_of(n_nodes_) * n_lanes * 4 * Dim) {
  for (const auto& [a, b] : graph.edges) {
    ++row_[a + 1];
    ++row_[b + 1];
  }
  for (size_t a = 0; a < graph.X.size(); ++a)
    row_[a + 1] += row_[a];
  neighbour_.resize(static_cast<size_t>(row_.back()));
  std::vector<std::int64_t> next(row_.begin(), row_.end() - 1);
  for (const auto& [a, b] : graph.edges) {
    neighbour_[next[a]++] = b;
    neighbour_[next[b]++] = a;
  }
  weight_.resize(neighbour_.size());
  const auto share = [&](std::int64_t a) {
    return graph.Omega[a] / static_cast<double>(row_[a + 1] - row_[a]);
  };
  for (std::int64_t a = 0; a < n_nodes_; ++a) {
    std::sort(neighbour_.begin() + row_[a], neighbour_.begin() + row_[a + 1]);
    for (std::int64_t p = row_[a]; p < row_[a + 1]; ++p) {
      const std::int64_t b = neighbour_[p];
      weight_[p] = (share(a) + share(b)) / (graph.X[b] - graph.X[a]).squaredNorm();
    }
    for (int i = 0; i < Dim; ++i)
      at_[a * length<Dim> + i] = graph.X[a][i];
  }
}

template <int Dim>
std::int64_t HourglassControl<Dim>::bytes() const {
  return static_cast<std::int64_t>(row_.size() * sizeof(row_[0]) +
                                   neighbour_.size() * (sizeof(std::int32_t) + sizeof(double))) +
         (at_.size() + force_.size() + N_.size()) * static_cast<std::int64_t>(sizeof(double));
}

/// Of nodes of other ranks.
template <int Dim>
void HourglassControl<Dim>::exchange(const Body<Dim>& body) {
  if (!body.division) return;
  body.division->pairs.exchange([&](std::int64_t begin, std::int64_t end, const auto& use) {
    const std::int64_t last = std::min(end, at_.size() / length<Dim>);
    algebra::use_bytes(at_.data() + begin * length<Dim>, (last - begin) * length<Dim>, use);
  });
}

template <int Dim>
void HourglassControl<Dim>::sum(const Body<Dim>& body, double modulus) {
  const Edges edges{row_.data(), neighbour_.data(), weight_.data(), at_.data()};
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    sum_of_nodes<Dim>(edges, modulus, begin, end, force_.data(), N_.data());
  });
}

template <int Dim>
void HourglassControl<Dim>::put_displacements(const Body<Dim>& body) {
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      double* const own = at_.data() + a * length<Dim>;
      for (int i = 0; i < Dim; ++i) {
        own[4 + i] = body.u.at(a, i);
        for (int j = 0; j < Dim; ++j)
          own[8 + 4 * j + i] = body.F.at(a, i * Dim + j);
      }
    }
  });
  exchange(body);
}

template <int Dim>
void HourglassControl<Dim>::evaluate(const Body<Dim>& body) {
  put_displacements(body);
  sum(body, body.options.hourglass);
}

template <int Dim>
void HourglassControl<Dim>::evaluate_linear(const Body<Dim>& body, double modulus) {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         for (std::int64_t b = begin; b < end; ++b) {
                           const auto L = velocity_gradient(body, b);
                           for (int l = 0; l < n_lanes; ++l) {
                             const std::int64_t a = b * n_lanes + l;
                             double* const own = at_.data() + a * length<Dim>;
                             for (int i = 0; i < Dim; ++i) {
                               own[4 + i] = a < n_nodes_ ? body.v.at(a, i) : 0;
                               for (int j = 0; j < Dim; ++j)
                                 own[8 + 4 * j + i] = L(i, j)[l];
                             }
                           }
                         }
                       });
  exchange(body);
  sum(body, modulus);
}

template <int Dim>
double HourglassControl<Dim>::stress_at(const Body<Dim>& body, std::int64_t a, int k) const {
  return N_[4 * (Dim * a + k % Dim) + k / Dim] * body.graph.inverse_Omega.data()[a];
}

template <int Dim>
void HourglassControl<Dim>::add_moments(Body<Dim>& body) const {
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (int k = 0; k < Dim * Dim; ++k)
        body.moments.set(a, k, body.moments.at(a, k) + stress_at(body, a, k));
    }
  });
}

template <int Dim>
void HourglassControl<Dim>::take_stresses(Body<Dim>& body) const {
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (int k = 0; k < Dim * Dim; ++k) {
        const int P = NodeRecord<Dim>::P + k;
        body.records.set(a, P, body.records.at(a, P) - stress_at(body, a, k));
      }
    }
  });
}

template <int Dim>
void HourglassControl<Dim>::add_forces(Body<Dim>& body) const {
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (int i = 0; i < Dim; ++i)
        body.T.set(a, i, body.T.at(a, i) + force_[4 * a + i]);
    }
  });
}

template <int Dim>
double HourglassControl<Dim>::power(const Body<Dim>& body) const {
  std::vector<double> parts(parallel::n_chunks_of(body.n_blocks));
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
                         for (std::int64_t b = begin; b < end; ++b) {
                           const auto L = velocity_gradient(body, b);
                           const std::int64_t last = std::min((b + 1) * n_lanes, n_nodes_);
                           for (std::int64_t a = b * n_lanes; a < last; ++a) {
                             for (int i = 0; i < Dim; ++i) {
                               parts[c] += body.v.at(a, i) * force_[4 * a + i];
                               for (int j = 0; j < Dim; ++j)
                                 parts[c] += N_[4 * (Dim * a + j) + i] * L(i, j)[a - b * n_lanes];
                             }
                           }
                         }
                       });
  return parallel::sum_of_chunks(body.part(), parts);
}

template <int Dim>
void HourglassControl<Dim>::add_energies(const Body<Dim>& body, std::vector<double>& sums) {
  put_displacements(body);
  const Edges edges{row_.data(), neighbour_.data(), weight_.data(), at_.data()};
  for_nodes(body, n_nodes_, [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
    // both ends count an edge
    sums[c] += 0.25 * body.options.hourglass * energy_of_nodes<Dim>(edges, begin, end);
  });
}

template class HourglassControl<2>;
template class HourglassControl<3>;

}  // namespace diptych::scheme
