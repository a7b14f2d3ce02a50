#include "common/closure/spline_levels.hpp"

#include "common/parallel/for_each.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace diptych::closure {

namespace {

/// In units of the mean spacing of the nodes. Beyond 1.6 there are fields that neither the splines
/// nor the blocks of nodes reach, and the steps double; below one splines only weaken each other.
constexpr double spacing_of_finest = 1.35;
constexpr double felt_energy = 1e-10;  ///< part of its energy that the fit of a row must leave
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

/// Spline j starts at (j - P) H. The weights are the coefficients of
///   factor ((1 + z + ... + z^(factor - 1)) / factor)^(P + 1).
template <int P>
Refinement refinement(int factor) {
  Refinement made{factor, -(factor - 1) * P, {static_cast<double>(factor)}};
  for (int power = 0; power <= P && factor > 1; ++power) {
    std::vector<double> product(made.weight.size() + static_cast<size_t>(factor) - 1, 0.0);
    for (size_t s = 0; s < made.weight.size(); ++s) {
      for (int r = 0; r < factor; ++r)
        product[s + static_cast<size_t>(r)] += made.weight[s] / factor;
    }
    made.weight = std::move(product);
  }
  return made;
}

/// Calls work(plane), by threads where a grid is large.
template <class Work>
void for_planes(std::int64_t size, int n_planes, const Work& work) {
  constexpr std::int64_t least_parallel = 8192;
  if (size >= least_parallel) {
    parallel::for_each(n_planes, work);
    return;
  }
  for (int z = 0; z < n_planes; ++z)
    work(z);
}

/// The number of cells 2^k or 3 * 2^k that is nearest to the one wanted, in their ratio.
int cells_near(double wanted) {
  int best = 1;
  for (int power = 1; power < 2 * wanted; power *= 2) {
    for (const int n : {power, 3 * power}) {
      if (std::abs(std::log(n / wanted)) < std::abs(std::log(best / wanted))) best = n;
    }
  }
  return best;
}

/// Of the next level.
int coarser(int n_cells) {
  return n_cells % 2 == 0 ? n_cells / 2 : n_cells == 3 ? 1 : n_cells;
}

/// Nodes of a cell of the finest grid as one, for the levels above it.
template <class Moments, class Terms>
struct Cluster {
  Moments left = Moments::Zero();
  Terms whole = Terms::Zero();
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
  std::vector<Cluster<Moments, Terms>> clusters(static_cast<size_t>(cells[0]) * cells[1] *
                                                cells[2]);
  visit_layers([&](const std::int32_t* begin, const std::int32_t* end) {
    for (; begin != end; ++begin) {
      const std::int32_t a = *begin;
      Moments left = Moments::Zero();
      Terms whole = Terms::Zero();
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
  // whole cells in every direction, on its coarsest level too: no spline just touches the box
  Index cells{1, 1, 1};
  for (int i = 0; i < dimension_; ++i)
    cells[i] = cells_near(length[i] / H);
  for (bool is_last = false; !is_last;) {
    Level& level = levels_.emplace_back();
    is_last = true;
    for (int i = 0; i < dimension_; ++i) {
      level.n[i] = cells[i] + P;
      level.H[i] = length[i] / cells[i];
      is_last &= cells[i] == 1;
      cells[i] = coarser(cells[i]);
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

/// The energy of a row of splines in x is a quadratic form of their derivatives in x alone.
template <int P>
void SplineLevels<P>::add_energy(
    Level& level, const Splines& s, double Omega, const Moments& left, const Terms& whole) const {
  using InX = Eigen::Matrix<double, P + 1, 1>;
  const auto& of = exponents<P>();
  for (int z = 0; z < n_z_; ++z) {
    for (int y = 0; y <= P; ++y) {
      Eigen::Matrix<double, P + 1, P + 1> form = decltype(form)::Zero();
      InX uncorrected = InX::Zero();
      Terms across;
      for (int m = 0; m < n_terms; ++m) {
        across[m] = s.value[of[m][1]][1][y] * s.value[of[m][2]][2][z];
        for (int l = 0; l < m; ++l)
          form(of[m][0], of[l][0]) += 2 * left(m, l) * across[m] * across[l];
        form(of[m][0], of[m][0]) += left(m, m) * across[m] * across[m];
        uncorrected[of[m][0]] += whole[m] * across[m] * across[m];
      }
      for (int x = 0; x <= P; ++x) {
        InX in_x;
        for (int order = 0; order <= P; ++order)
          in_x[order] = s.value[order][0][x];
        const std::int64_t i =
            (static_cast<std::int64_t>(s.first[2] + z) * level.n[1] + s.first[1] + y) * level.n[0] +
            s.first[0] + x;
        const double value = s.value[0][0][x] * s.value[0][1][y] * s.value[0][2][z];
        level.mass[i] += Omega * value * value;
        level.diagonal[i] += in_x.dot(form * in_x);
        level.uncorrected[i] += uncorrected.dot(in_x.cwiseAbs2());
      }
    }
  }
}

template <int P>
auto SplineLevels<P>::between(const Level& fine, const Level& coarse) const -> Refinements {
  static const std::array<Refinement, 4> refinements{{{}, {}, refinement<P>(2), refinement<P>(3)}};
  const auto of = [&](int i) -> const Refinement& {
    return refinements[static_cast<size_t>(i < dimension_ ? (fine.n[i] - P) / (coarse.n[i] - P)
                                                          : 1)];
  };
  return {of(0), of(1), of(2)};
}

/// Grid of the coarse level += the sums over the children of its splines.
template <int P>
void SplineLevels<P>::restrict_to(Level& coarse, const Level& fine) const {
  const Refinements to = between(fine, coarse);
  for_planes(coarse.size(), coarse.n[2], [&](std::int64_t z) {
    restrict_plane(to, fine.n, fine.grid.data(), coarse.n, static_cast<int>(z), coarse.grid.data());
  });
}

/// Grid of the fine level += what the splines of the coarse one are there.
template <int P>
void SplineLevels<P>::refine_to(Level& fine, const Level& coarse) const {
  const Refinements to = between(fine, coarse);
  for_planes(fine.size(), fine.n[2], [&](std::int64_t z) {
    refine_plane(to, coarse.n, coarse.grid.data(), fine.n, static_cast<int>(z), fine.grid.data());
  });
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
  for (size_t l = 1; l < levels_.size(); ++l)
    restrict_to(levels_[l], levels_[l - 1]);
  for (size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    for (std::int64_t i = 0; i < level.grid.size(); ++i) {
      const double diagonal = level.diagonal[i];
      level.grid[i] = diagonal > 0 ? level.grid[i] / diagonal : Four{};
    }
    if (l + 1 < levels_.size()) refine_to(level, levels_[l + 1]);
  }
  prolong(0, z);
}

/// z += the splines of a level, with the factors that its grid holds.
template <int P>
void SplineLevels<P>::prolong(size_t level, std::vector<Vec3>& z) {
  for (size_t l = level; l-- > 0;) {
    std::fill_n(levels_[l].grid.data(), levels_[l].grid.size(), Four{});
    refine_to(levels_[l], levels_[l + 1]);
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
