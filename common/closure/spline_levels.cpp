#include "common/closure/spline_levels.hpp"

#include "common/parallel/for_each.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace diptych::closure {

namespace {

constexpr double spacing_of_finest = 2;  ///< in units of the mean spacing of the nodes
constexpr double felt_energy = 1e-10;    ///< part of its energy that the fit of a row must leave
/// Part of its mass that must lie in the body. A quadratic one that only touches nodes of the
/// boundary has far more energy there than its derivatives tell.
template <int P>
constexpr double felt_mass = P == quadratic ? 2e-3 : 1e-8;
/// Energy of a level, relative to that of noise, below which S only rounds.
constexpr double felt_by_operator = 1e-15;

/// Exponents of all monomials of degree P in space.
template <int P>
const auto& exponents() {
  static const auto table = [] {
    std::array<SplineIndex, SplineLevels<P>::n_terms> made{};
    size_t m = 0;
    for (int i = P; i >= 0; --i) {
      for (int j = P - i; j >= 0; --j)
        made[m++] = {i, j, P - i - j};
    }
    return made;
  }();
  return table;
}

/// Integral of the square of a spline of degree P of spacing 1.
template <int P>
constexpr double square_of_spline = P == quadratic ? 0.55 : 0.4304;

/// The two-scale relation: a spline as a sum of those of half its spacing.
template <int P>
std::array<double, P + 2> children_weights() {
  std::array<double, P + 2> weight{};
  weight[0] = std::exp2(-P);
  for (int s = 1; s < P + 2; ++s)
    weight[s] = weight[s - 1] * (P + 2 - s) / s;
  return weight;
}

/// Nodes of a cell of the finest grid as one, for the levels above it.
template <class Moments>
struct Cluster {
  Moments left = Moments::Zero(), whole = Moments::Zero();
  Vec3 moment = Vec3::Zero();
  double Omega = 0;
};

}  // namespace

template <int P>
auto SplineLevels<P>::monomials(const Vec3& X) -> Terms {
  double power[3][P + 1];  // X^n / n!
  for (int i = 0; i < 3; ++i) {
    power[i][0] = 1;
    for (int n = 1; n <= P; ++n)
      power[i][n] = power[i][n - 1] * X[i] / n;
  }
  Terms terms;
  for (int m = 0; m < n_terms; ++m) {
    const SplineIndex& e = exponents<P>()[m];
    terms[m] = power[0][e[0]] * power[1][e[1]] * power[2][e[2]];
  }
  return terms;
}

template <int P>
void SplineLevels<P>::set_slopes(const scheme::PairGraph& graph, const std::vector<double>& h) {
  node_slopes_.resize(graph.X.size());
  for_each_node(graph.X.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Splines s = splines_at(levels_.front(), graph.X[a]);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= P; ++j)
          node_slopes_[a].value[i][j] = h[a] / 3 * s.value[1][i][j];
      }
    }
  });
}

template <int P>
void SplineLevels<P>::scale_to(const FieldOperator& S) {
  const size_t per_node = node_slopes_.empty() ? 1 : 1 + static_cast<size_t>(dimension_);
  Field z(node_splines_.size() * per_node), S_z(z.size());
  std::mt19937 engine(1);
  const auto sign = [&] { return (engine() & 1U) != 0 ? 1.0 : -1.0; };
  const auto energy_of = [&] {  // over the square of the field
    S(z, S_z);
    double energy = 0, square = 0;
    for (size_t i = 0; i < z.size(); ++i) {
      energy += z[i].dot(S_z[i]);
      square += z[i].squaredNorm();
    }
    return std::array{energy, energy / square};
  };
  for (Vec3& noise : z)
    noise = Vec3(sign(), sign(), sign());
  const double largest = energy_of()[1];
  for (size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    double expected = 0;
    for (std::int64_t i = 0; i < level.size(); ++i) {
      level.grid[i] = Four{};
      if (!(level.diagonal[i] > 0)) continue;
      expected += 3 * level.diagonal[i];
      for (int c = 0; c < 3; ++c)
        level.grid[i][c] = sign();
    }
    std::fill(z.begin(), z.end(), Vec3::Zero());
    prolong(l, z);
    const auto [measured, relative] = energy_of();
    const bool is_felt = expected > 0 && relative > felt_by_operator * largest;
    for (double& diagonal : level.diagonal)
      diagonal *= is_felt ? measured / expected : 0;
  }
}

template <int P>
SplineLevels<P>::SplineLevels(const scheme::PairGraph& graph, const RowMoments& moments)
    : dimension_(graph.dimension), n_z_(graph.dimension == 3 ? P + 1 : 1) {
  set_levels(graph);
  place_nodes(graph);
  Level& finest = levels_.front();
  const Index cells{finest.n[0] - P, std::max(1, finest.n[1] - P), std::max(1, finest.n[2] - P)};
  std::vector<Cluster<Moments>> clusters(static_cast<size_t>(cells[0]) * cells[1] * cells[2]);
  visit_layers([&](const std::int32_t* begin, const std::int32_t* end) {
    for (; begin != end; ++begin) {
      const std::int32_t a = *begin;
      Moments left = Moments::Zero(), whole = Moments::Zero();
      moments(a, left, whole);
      const Splines s = splines_at(finest, graph.X[a]);
      add_energy(finest, s, graph.Omega[a], left, whole);
      auto& cluster =
          clusters[(static_cast<size_t>(s.first[2]) * cells[1] + s.first[1]) * cells[0] +
                   s.first[0]];
      cluster.left += left;
      cluster.whole += whole;
      cluster.moment += graph.Omega[a] * graph.X[a];
      cluster.Omega += graph.Omega[a];
    }
  });
  parallel::for_each(static_cast<std::int64_t>(levels_.size()) - 1, [&](std::int64_t l) {
    Level& level = levels_[l + 1];
    for (const auto& cluster : clusters) {
      if (cluster.Omega == 0) continue;
      add_energy(level, splines_at(level, cluster.moment / cluster.Omega), cluster.Omega,
                 cluster.left, cluster.whole);
    }
  });
  for (Level& level : levels_)
    leave_out_unfelt(level);
}

template <int P>
void SplineLevels<P>::place_nodes(const scheme::PairGraph& graph) {
  const Level& finest = levels_.front();
  const int across = dimension_ - 1;
  node_splines_.resize(graph.X.size());
  std::vector<std::int32_t> layer_of(graph.X.size());
  for_each_node(graph.X.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Splines s = splines_at(finest, graph.X[a]);
      layer_of[a] = s.first[across];
      node_splines_[a].first =
          (static_cast<std::int64_t>(s.first[2]) * finest.n[1] + s.first[1]) * finest.n[0] +
          s.first[0];
      std::copy(&s.value[0][0][0], &s.value[0][0][0] + 3 * (P + 1), &node_splines_[a].value[0][0]);
    }
  });
  layer_.assign(static_cast<size_t>(finest.n[across] - P) + 1, 0);
  for (const std::int32_t layer : layer_of)
    ++layer_[layer + 1];
  std::partial_sum(layer_.begin(), layer_.end(), layer_.begin());
  std::vector<std::int64_t> next(layer_.begin(), layer_.end() - 1);
  by_layer_.resize(layer_of.size());
  for (size_t a = 0; a < layer_of.size(); ++a)
    by_layer_[next[layer_of[a]]++] = static_cast<std::int32_t>(a);
}

/// Calls visit with the nodes of every layer, layers that share splines one after another.
template <int P>
void SplineLevels<P>::visit_layers(
    const std::function<void(const std::int32_t* begin, const std::int32_t* end)>& visit) const {
  const auto n_layers = static_cast<std::int64_t>(layer_.size()) - 1;
  for (int colour = 0; colour <= P; ++colour) {
    parallel::for_each((n_layers - colour + P) / (P + 1), [&](std::int64_t i) {
      const std::int64_t layer = colour + (P + 1) * i;
      visit(by_layer_.data() + layer_[layer], by_layer_.data() + layer_[layer + 1]);
    });
  }
}

template <int P>
void SplineLevels<P>::leave_out_unfelt(Level& level) {
  const double full_mass =
      std::pow(square_of_spline<P>, dimension_) * level.H.head(dimension_).prod();
  for (size_t i = 0; i < level.diagonal.size(); ++i) {
    if (!(level.diagonal[i] > felt_energy * level.uncorrected[i]) ||
        level.mass[i] < felt_mass<P> * full_mass) {
      level.diagonal[i] = 0;
    }
  }
}

template <int P>
void SplineLevels<P>::set_levels(const scheme::PairGraph& graph) {
  Vec3 upper = graph.X[0];
  lower_ = graph.X[0];
  double volume = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    lower_ = lower_.cwiseMin(graph.X[a]);
    upper = upper.cwiseMax(graph.X[a]);
    volume += graph.Omega[a];
  }
  const auto n_nodes = static_cast<double>(graph.n_nodes());
  const Eigen::ArrayXd length = (upper - lower_).head(dimension_).array();
  double H = spacing_of_finest * std::pow(volume / n_nodes, 1.0 / dimension_);
  while ((length / H + 3).prod() > n_nodes + 1000)
    H *= 1.25;
  // Whole cells in every direction, on its coarsest level too: no spline just touches the box.
  Index cells{1, 1, 1}, halvings{0, 0, 0};
  for (int i = 0; i < dimension_; ++i) {
    halvings[i] = std::max(0, static_cast<int>(std::log2(length[i] / H)));
    cells[i] = std::max(1, static_cast<int>(std::round(length[i] / (H * std::exp2(halvings[i])))));
  }
  const int n_levels = 1 + *std::max_element(halvings.begin(), halvings.end());
  for (int l = 0; l < n_levels; ++l) {
    Level& level = levels_.emplace_back();
    for (int i = 0; i < dimension_; ++i) {
      const int n = cells[i] << std::max(0, halvings[i] - l);
      level.n[i] = n + P;
      level.H[i] = length[i] / n;
    }
    level.diagonal.assign(static_cast<size_t>(level.size()), 0.0);
    level.uncorrected = level.mass = level.diagonal;
    level.grid = algebra::AlignedArray<Four>(level.size());
  }
}

template <int P>
auto SplineLevels<P>::splines_at(const Level& level, const Vec3& X) const -> Splines {
  Splines s;
  for (int i = 0; i < 3; ++i) {
    if (i >= dimension_) {
      s.value[0][i][0] = 1;
      continue;
    }
    const double x = (X[i] - lower_[i]) / level.H[i];
    s.first[i] = std::clamp(static_cast<int>(x), 0, level.n[i] - P - 1);
    const double t = x - s.first[i];
    double of_degree[P + 1][P + 1] = {{1}};
    for (int p = 1; p <= P; ++p) {
      for (int j = 0; j <= p; ++j) {
        const double u = t + p - j;  // from where spline j begins
        of_degree[p][j] = ((j > 0 ? u * of_degree[p - 1][j - 1] : 0.0) +
                           (j < p ? (p + 1 - u) * of_degree[p - 1][j] : 0.0)) /
                          p;
      }
    }
    double scale = 1;
    for (int order = 0; order <= P; ++order) {
      double d[P + 1];
      std::copy(of_degree[P - order], of_degree[P - order] + P + 1, d);
      for (int p = P - order + 1; p <= P; ++p) {
        for (int j = p; j >= 0; --j)
          d[j] = (j > 0 ? d[j - 1] : 0.0) - (j < p ? d[j] : 0.0);
      }
      for (int j = 0; j <= P; ++j)
        s.value[order][i][j] = scale * d[j];
      scale /= level.H[i];
    }
  }
  return s;
}

template <int P>
void SplineLevels<P>::add_energy(
    Level& level, const Splines& s, double Omega, const Moments& left, const Moments& whole) const {
  for (int z = 0; z < n_z_; ++z) {
    for (int y = 0; y <= P; ++y) {
      for (int x = 0; x <= P; ++x) {
        Terms derivatives;
        for (int m = 0; m < n_terms; ++m) {
          const SplineIndex& e = exponents<P>()[m];
          derivatives[m] = s.value[e[0]][0][x] * s.value[e[1]][1][y] * s.value[e[2]][2][z];
        }
        const std::int64_t i =
            (static_cast<std::int64_t>(s.first[2] + z) * level.n[1] + s.first[1] + y) * level.n[0] +
            s.first[0] + x;
        const double value = s.value[0][0][x] * s.value[0][1][y] * s.value[0][2][z];
        level.mass[i] += Omega * value * value;
        level.diagonal[i] += derivatives.dot(left * derivatives);
        level.uncorrected[i] += derivatives.dot(whole * derivatives);
      }
    }
  }
}

template <int P>
template <class Visit>
void SplineLevels<P>::for_each_child(const Level& fine,
                                     const Level& coarse,
                                     const Visit& visit) const {
  // Spline j of a level starts at (j - P) H, so the children of j start at 2 (j - P) H/2.
  static const std::array<double, P + 2> halved = children_weights<P>();
  const auto n_children = [&](int i) { return fine.n[i] == coarse.n[i] ? 1 : P + 2; };
  const auto child = [&](int i, int j, int s) {
    return fine.n[i] == coarse.n[i] ? j : 2 * j - P + s;
  };
  const auto weight = [&](int i, int s) { return fine.n[i] == coarse.n[i] ? 1.0 : halved[s]; };
  std::int64_t c = 0;
  for (int z = 0; z < coarse.n[2]; ++z) {
    for (int y = 0; y < coarse.n[1]; ++y) {
      for (int x = 0; x < coarse.n[0]; ++x, ++c) {
        for (int sz = 0; sz < n_children(2); ++sz) {
          const int fz = child(2, z, sz);
          if (fz < 0 || fz >= fine.n[2]) continue;
          for (int sy = 0; sy < n_children(1); ++sy) {
            const int fy = child(1, y, sy);
            if (fy < 0 || fy >= fine.n[1]) continue;
            for (int sx = 0; sx < n_children(0); ++sx) {
              const int fx = child(0, x, sx);
              if (fx < 0 || fx >= fine.n[0]) continue;
              visit((static_cast<std::int64_t>(fz) * fine.n[1] + fy) * fine.n[0] + fx, c,
                    weight(0, sx) * weight(1, sy) * weight(2, sz));
            }
          }
        }
      }
    }
  }
}

template <int P>
void SplineLevels<P>::add(const std::vector<Vec3>& r, std::vector<Vec3>& z) {
  for (Level& level : levels_)
    std::fill_n(level.grid.data(), level.grid.size(), Four{});
  Level& finest = levels_.front();
  visit_layers([&](const std::int32_t* begin, const std::int32_t* end) {
    if constexpr (P == quadratic) {
      spread_nodes(begin, end, node_splines_.data(), finest.n, n_z_, r.data(), finest.grid.data());
    } else {
      spread_nodes_with_slopes(begin, end, node_splines_.data(), node_slopes_.data(), finest.n,
                               dimension_, r.data(), finest.grid.data());
    }
  });
  for (size_t l = 1; l < levels_.size(); ++l) {
    for_each_child(levels_[l - 1], levels_[l], [&](std::int64_t f, std::int64_t c, double w) {
      levels_[l].grid[c] += w * levels_[l - 1].grid[f];
    });
  }
  for (size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    for (std::int64_t i = 0; i < level.grid.size(); ++i) {
      const double diagonal = level.diagonal[i];
      level.grid[i] = diagonal > 0 ? level.grid[i] / diagonal : Four{};
    }
    if (l + 1 == levels_.size()) continue;
    for_each_child(level, levels_[l + 1], [&](std::int64_t f, std::int64_t c, double w) {
      level.grid[f] += w * levels_[l + 1].grid[c];
    });
  }
  prolong(0, z);
}

/// z += the splines of a level, with the factors that its grid holds.
template <int P>
void SplineLevels<P>::prolong(size_t level, std::vector<Vec3>& z) {
  for (size_t l = level; l-- > 0;) {
    std::fill_n(levels_[l].grid.data(), levels_[l].grid.size(), Four{});
    for_each_child(levels_[l], levels_[l + 1], [&](std::int64_t f, std::int64_t c, double w) {
      levels_[l].grid[f] += w * levels_[l + 1].grid[c];
    });
  }
  const Level& finest = levels_.front();
  for_each_node(node_splines_.size(), [&](std::int64_t begin, std::int64_t end) {
    if constexpr (P == quadratic) {
      gather_nodes(begin, end, node_splines_.data(), finest.n, n_z_, finest.grid.data(), z.data());
    } else {
      gather_nodes_with_slopes(begin, end, node_splines_.data(), node_slopes_.data(), finest.n,
                               dimension_, finest.grid.data(), z.data());
    }
  });
}

template class SplineLevels<quadratic>;
template class SplineLevels<quartic>;

}  // namespace diptych::closure
