#include "common/closure/spline_levels.hpp"

#include "common/closure/spline_sums.hpp"
#include "common/parallel/for_each.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace diptych::closure {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr double spacing_of_finest = 2;  ///< in units of the mean spacing of the nodes
constexpr double felt_energy = 1e-10;    ///< part of its energy that the linear fit must leave
/// Part of its mass that must lie in the body: a spline that only touches nodes of the boundary
/// has far more energy there than its curvature tells.
constexpr double felt_mass = 2e-3;

/// Half the second differential: 1/2 X.Hess X = monomials.Hess, Hess = {xx,yy,zz,yz,zx,xy}.
Vec6 monomials(const Vec3& X) {
  Vec6 m;
  m << 0.5 * X[0] * X[0], 0.5 * X[1] * X[1], 0.5 * X[2] * X[2], X[1] * X[2], X[2] * X[0],
      X[0] * X[1];
  return m;
}

/// T_a, and the same without the linear fit.
void row_moments(const scheme::PairGraph& graph,
                 const std::vector<double>& k,
                 const Mat3& inverse,
                 std::int64_t a,
                 Mat6 T[2]) {
  Eigen::Matrix<double, 3, 6> mixed = Eigen::Matrix<double, 3, 6>::Zero();
  T[1].setZero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    const Vec3 X = graph.X[graph.neighbour[p]] - graph.X[a];
    const Vec6 m = monomials(X);
    T[1] += (0.25 * k[p]) * m * m.transpose();
    mixed += (0.5 * k[p]) * X * m.transpose();
  }
  T[0] = T[1] - mixed.transpose() * inverse * mixed;
}

/// Nodes of a cell of the finest grid as one, for the levels above it.
struct Cluster {
  Mat6 T[2] = {Mat6::Zero(), Mat6::Zero()};
  Vec3 moment = Vec3::Zero();
  double Omega = 0;
};

}  // namespace

SplineLevels::SplineLevels(const scheme::PairGraph& graph,
                           const std::vector<double>& k,
                           const std::vector<Mat3>& inverse,
                           const std::vector<double>& h)
    : SplineLevels(graph, k, inverse) {
  node_slopes_.resize(graph.X.size());
  for_each_node(graph.X.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Splines s = splines_at(levels_.front(), graph.X[a]);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          node_slopes_[a].value[i][j] = h[a] / 3 * s.slope[i][j];
      }
    }
  });
}

void SplineLevels::scale_to(const FieldOperator& S) {
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
    const bool is_felt = expected > 0 && relative > felt_energy * largest;
    for (double& diagonal : level.diagonal)
      diagonal *= is_felt ? measured / expected : 0;
  }
}

SplineLevels::SplineLevels(const scheme::PairGraph& graph,
                           const std::vector<double>& k,
                           const std::vector<Mat3>& inverse)
    : dimension_(graph.dimension), per_direction_z_(graph.dimension == 3 ? 3 : 1) {
  set_levels(graph);
  place_nodes(graph);
  Level& finest = levels_.front();
  const Index cells{finest.n[0] - 2, std::max(1, finest.n[1] - 2), std::max(1, finest.n[2] - 2)};
  std::vector<Cluster> clusters(static_cast<size_t>(cells[0]) * cells[1] * cells[2]);
  visit_layers([&](const std::int32_t* begin, const std::int32_t* end) {
    Mat6 T[2];
    for (; begin != end; ++begin) {
      const std::int32_t a = *begin;
      row_moments(graph, k, inverse[a], a, T);
      const Splines s = splines_at(finest, graph.X[a]);
      add_energy(finest, s, graph.Omega[a], T);
      Cluster& cluster =
          clusters[(static_cast<size_t>(s.first[2]) * cells[1] + s.first[1]) * cells[0] +
                   s.first[0]];
      cluster.T[0] += T[0];
      cluster.T[1] += T[1];
      cluster.moment += graph.Omega[a] * graph.X[a];
      cluster.Omega += graph.Omega[a];
    }
  });
  parallel::for_each(static_cast<std::int64_t>(levels_.size()) - 1, [&](std::int64_t l) {
    Level& level = levels_[l + 1];
    for (const Cluster& cluster : clusters) {
      if (cluster.Omega == 0) continue;
      add_energy(level, splines_at(level, cluster.moment / cluster.Omega), cluster.Omega,
                 cluster.T);
    }
  });
  for (Level& level : levels_)
    leave_out_unfelt(level);
}

void SplineLevels::place_nodes(const scheme::PairGraph& graph) {
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
      std::copy(&s.value[0][0], &s.value[0][0] + 9, &node_splines_[a].value[0][0]);
    }
  });
  layer_.assign(static_cast<size_t>(finest.n[across]) - 1, 0);
  for (const std::int32_t layer : layer_of)
    ++layer_[layer + 1];
  std::partial_sum(layer_.begin(), layer_.end(), layer_.begin());
  std::vector<std::int64_t> next(layer_.begin(), layer_.end() - 1);
  by_layer_.resize(layer_of.size());
  for (size_t a = 0; a < layer_of.size(); ++a)
    by_layer_[next[layer_of[a]]++] = static_cast<std::int32_t>(a);
}

/// Calls visit with the nodes of every layer, layers that share splines one after another.
void SplineLevels::visit_layers(
    const std::function<void(const std::int32_t* begin, const std::int32_t* end)>& visit) const {
  const auto n_layers = static_cast<std::int64_t>(layer_.size()) - 1;
  for (int colour = 0; colour < 3; ++colour) {
    parallel::for_each((n_layers - colour + 2) / 3, [&](std::int64_t i) {
      const std::int64_t layer = colour + 3 * i;
      visit(by_layer_.data() + layer_[layer], by_layer_.data() + layer_[layer + 1]);
    });
  }
}

void SplineLevels::leave_out_unfelt(Level& level) {
  const double full_mass = std::pow(0.55, dimension_) * level.H.head(dimension_).prod();
  for (size_t i = 0; i < level.diagonal.size(); ++i) {
    if (!(level.diagonal[i] > felt_energy * level.uncorrected[i]) ||
        level.mass[i] < felt_mass * full_mass) {
      level.diagonal[i] = 0;
    }
  }
}

void SplineLevels::set_levels(const scheme::PairGraph& graph) {
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
  // Whole cells in every direction, on the coarsest level too: no spline just touches the box.
  const int n_levels = 1 + std::max(0, static_cast<int>(std::log2(length.minCoeff() / H)));
  Index cells{1, 1, 1};
  for (int i = 0; i < dimension_; ++i) {
    const double coarse = std::round(length[i] / (H * std::exp2(n_levels - 1)));
    cells[i] = std::max(1, static_cast<int>(coarse)) << (n_levels - 1);
  }
  for (int l = 0; l < n_levels; ++l) {
    Level& level = levels_.emplace_back();
    for (int i = 0; i < dimension_; ++i) {
      level.n[i] = (cells[i] >> l) + 2;
      level.H[i] = length[i] / (cells[i] >> l);
    }
    level.diagonal.assign(static_cast<size_t>(level.size()), 0.0);
    level.uncorrected = level.mass = level.diagonal;
    level.grid = algebra::AlignedArray<Four>(level.size());
  }
}

SplineLevels::Splines SplineLevels::splines_at(const Level& level, const Vec3& X) const {
  Splines s;
  for (int i = 0; i < 3; ++i) {
    if (i >= dimension_) {
      s.first[i] = 0;
      s.value[i][0] = 1;
      s.slope[i][0] = s.curvature[i][0] = 0;
      continue;
    }
    const double x = (X[i] - lower_[i]) / level.H[i];
    s.first[i] = std::clamp(static_cast<int>(x), 0, level.n[i] - 3);
    const double t = x - s.first[i];
    const double value[3] = {0.5 * (1 - t) * (1 - t), 0.5 + t - t * t, 0.5 * t * t};
    const double slope[3] = {t - 1, 1 - 2 * t, t};
    const double curvature[3] = {1, -2, 1};
    for (int j = 0; j < 3; ++j) {
      s.value[i][j] = value[j];
      s.slope[i][j] = slope[j] / level.H[i];
      s.curvature[i][j] = curvature[j] / (level.H[i] * level.H[i]);
    }
  }
  return s;
}

void SplineLevels::add_energy(Level& level, const Splines& s, double Omega, const Mat6 T[2]) const {
  for (int z = 0; z < per_direction_z_; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        const double* v[3] = {&s.value[0][x], &s.value[1][y], &s.value[2][z]};
        const double* g[3] = {&s.slope[0][x], &s.slope[1][y], &s.slope[2][z]};
        const double* c[3] = {&s.curvature[0][x], &s.curvature[1][y], &s.curvature[2][z]};
        Vec6 h;
        h << *c[0] * *v[1] * *v[2], *v[0] * *c[1] * *v[2], *v[0] * *v[1] * *c[2],
            *v[0] * *g[1] * *g[2], *g[0] * *v[1] * *g[2], *g[0] * *g[1] * *v[2];
        const std::int64_t i =
            (static_cast<std::int64_t>(s.first[2] + z) * level.n[1] + s.first[1] + y) * level.n[0] +
            s.first[0] + x;
        const double value = *v[0] * *v[1] * *v[2];
        level.mass[i] += Omega * value * value;
        level.diagonal[i] += h.dot(T[0] * h);
        level.uncorrected[i] += h.dot(T[1] * h);
      }
    }
  }
}

template <class Visit>
void SplineLevels::for_each_child(const Level& fine,
                                  const Level& coarse,
                                  const Visit& visit) const {
  // Spline j of a level starts at (j - 2) H, so the children of j start at 2 (j - 2) H/2.
  static constexpr double weight[4] = {0.25, 0.75, 0.75, 0.25};
  const auto children = [&](int i, int j, int s) { return i < dimension_ ? 2 * j - 2 + s : s; };
  const int n_z = dimension_ == 3 ? 4 : 1;
  std::int64_t c = 0;
  for (int z = 0; z < coarse.n[2]; ++z) {
    for (int y = 0; y < coarse.n[1]; ++y) {
      for (int x = 0; x < coarse.n[0]; ++x, ++c) {
        for (int sz = 0; sz < n_z; ++sz) {
          const int fz = children(2, z, sz);
          if (fz < 0 || fz >= fine.n[2]) continue;
          for (int sy = 0; sy < 4; ++sy) {
            const int fy = children(1, y, sy);
            if (fy < 0 || fy >= fine.n[1]) continue;
            for (int sx = 0; sx < 4; ++sx) {
              const int fx = children(0, x, sx);
              if (fx < 0 || fx >= fine.n[0]) continue;
              const double w = weight[sx] * weight[sy] * (n_z == 4 ? weight[sz] : 1.0);
              visit((static_cast<std::int64_t>(fz) * fine.n[1] + fy) * fine.n[0] + fx, c, w);
            }
          }
        }
      }
    }
  }
}

void SplineLevels::add(const std::vector<Vec3>& r, std::vector<Vec3>& z) {
  for (Level& level : levels_)
    std::fill_n(level.grid.data(), level.grid.size(), Four{});
  Level& finest = levels_.front();
  visit_layers([&](const std::int32_t* begin, const std::int32_t* end) {
    if (node_slopes_.empty()) {
      spread_nodes(begin, end, node_splines_.data(), finest.n, per_direction_z_, r.data(),
                   finest.grid.data());
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
void SplineLevels::prolong(size_t level, std::vector<Vec3>& z) {
  for (size_t l = level; l-- > 0;) {
    std::fill_n(levels_[l].grid.data(), levels_[l].grid.size(), Four{});
    for_each_child(levels_[l], levels_[l + 1], [&](std::int64_t f, std::int64_t c, double w) {
      levels_[l].grid[f] += w * levels_[l + 1].grid[c];
    });
  }
  const Level& finest = levels_.front();
  for_each_node(node_splines_.size(), [&](std::int64_t begin, std::int64_t end) {
    if (node_slopes_.empty()) {
      gather_nodes(begin, end, node_splines_.data(), finest.n, per_direction_z_, finest.grid.data(),
                   z.data());
    } else {
      gather_nodes_with_slopes(begin, end, node_splines_.data(), node_slopes_.data(), finest.n,
                               dimension_, finest.grid.data(), z.data());
    }
  });
}

}  // namespace diptych::closure
