#include "common/scheme/graph/sweep_graph.hpp"

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "common/scheme/graph/pair_runs.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

/// Runs take 0.5 to 0.8 of the time of rows for a chunk (README.md).
constexpr double least_filling = 0.6;

std::int64_t chunks_of(std::int64_t n_pairs) {
  return (n_pairs + n_lanes - 1) / n_lanes;
}

template <class T>
void copy(const std::vector<T>& from, algebra::AlignedArray<T>& to) {
  to = algebra::AlignedArray<T>(static_cast<std::int64_t>(from.size()));
  std::copy(from.begin(), from.end(), to.data());
}

/// The pairs of the chunks of one unit (a node in rows, a block in runs), lane by lane, -1: none.
using Lay = std::vector<std::int64_t>;

/// Lays out units one by one.
class Layouts {
 public:
  virtual ~Layouts() = default;
  virtual std::int64_t n_units() const = 0;
  virtual void lay(std::int64_t unit, Lay& pairs) const = 0;
};

class RowLayouts : public Layouts {
 public:
  RowLayouts(const PairGraph& graph, const RowClasses& classes)
      : graph_(graph), classes_(classes) {}
  std::int64_t n_units() const override { return graph_.n_nodes(); }
  void lay(std::int64_t a, Lay& pairs) const override {
    const std::int64_t n = graph_.row[a + 1] - graph_.row[a];
    pairs.assign(static_cast<size_t>(chunks_of(n) * n_lanes), -1);
    for (std::int64_t k = 0; k < n; ++k)
      pairs[k] = classes_.pair(graph_.row[a], k);
  }

 private:
  const PairGraph& graph_;
  const RowClasses& classes_;
};

class RunLayouts : public Layouts {
 public:
  RunLayouts(const PairGraph& graph, const PairRuns& runs) : graph_(graph), runs_(runs) {}
  std::int64_t n_units() const override { return static_cast<std::int64_t>(runs_.row.size()) - 1; }
  void lay(std::int64_t b, Lay& pairs) const override { pairs_of_block(graph_, runs_, b, pairs); }

 private:
  const PairGraph& graph_;
  const PairRuns& runs_;
};

/// C_ab and C_ba of the lanes of a unit, zero where there is no pair.
void geometry_of(const PairGraph& graph,
                 const RowClasses& classes,
                 const Lay& pairs,
                 std::vector<Vec3>& C) {
  C.assign(2 * pairs.size(), Vec3::Zero());
  for (size_t k = 0; k < pairs.size(); ++k) {
    const std::int64_t p = pairs[k];
    if (p < 0) continue;
    const std::int64_t reverse = graph.reverse(p);
    C[2 * k] = shared_C(graph, classes, graph.neighbour[reverse], p);
    C[2 * k + 1] = shared_C(graph, classes, graph.neighbour[p], reverse);
  }
}

std::uint64_t hash_of(const std::vector<Vec3>& C) {
  Hash hash;
  for (const Vec3& c : C) {
    for (int i = 0; i < 3; ++i) {
      std::uint64_t word;
      std::memcpy(&word, &c[i], sizeof word);
      hash.add(word);
    }
  }
  return hash.value();
}

/// Units with the same bits of geometry.
/// @param alike  groups of units that surely have: one of each is looked at
EqualGroups group_units(const PairGraph& graph,
                        const RowClasses& classes,
                        const Layouts& layouts,
                        const EqualGroups& alike) {
  std::vector<std::uint64_t> hash(alike.representative.size());
  Lay pairs;
  std::vector<Vec3> one, other;
  const auto read = [&](std::int32_t group, std::vector<Vec3>& C) {
    layouts.lay(alike.representative[group], pairs);
    geometry_of(graph, classes, pairs, C);
  };
  for (size_t g = 0; g < hash.size(); ++g) {
    read(static_cast<std::int32_t>(g), one);
    hash[g] = hash_of(one);
  }
  return joined(alike, group_equal(hash, [&](std::int32_t g, std::int32_t h) {
                  read(g, one);
                  read(h, other);
                  return one == other;
                }));
}

/// Blocks whose nodes have rows of the same classes, at the same offsets.
EqualGroups group_blocks(const PairGraph& graph, const RowClasses& classes) {
  const std::vector<std::int32_t> nodes = group_by_neighbours(graph, classes, true).of;
  const auto n_blocks = algebra::n_blocks_of(graph.n_nodes());
  using Block = std::array<std::int32_t, n_lanes>;
  const auto block = [&](std::int64_t b) {
    Block of;
    of.fill(-1);
    std::copy(nodes.begin() + b * n_lanes,
              nodes.begin() + std::min(graph.n_nodes(), (b + 1) * n_lanes), of.begin());
    return of;
  };
  std::vector<std::uint64_t> hash(static_cast<size_t>(n_blocks));
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    Hash of_block;
    for (const std::int32_t group : block(b))
      of_block.add(static_cast<std::uint64_t>(group));
    hash[b] = of_block.value();
  }
  return group_equal(hash, [&](std::int32_t a, std::int32_t b) { return block(a) == block(b); });
}

/// X_b - X_a of a pair; 0 where there is none.
Vec3 distance_of(const PairGraph& graph, std::int64_t p) {
  if (p < 0) return Vec3::Zero();
  return graph.X[graph.neighbour[p]] - graph.X[graph.neighbour[graph.reverse(p)]];
}

/// Geometry of every group once, set lane by lane by set(chunk, lane, C_ab, C_ba, X_b - X_a).
/// @param first_of_unit  into the geometry
/// @param allocate       called with the number of chunks
template <class Allocate, class Set>
void set_geometry(const PairGraph& graph,
                  const RowClasses& classes,
                  const Layouts& layouts,
                  const EqualGroups& alike,
                  algebra::AlignedArray<std::int64_t>& first_of_unit,
                  const Allocate& allocate,
                  const Set& set) {
  const EqualGroups groups = group_units(graph, classes, layouts, alike);
  std::vector<std::int64_t> first(1, 0);
  Lay pairs;
  for (const std::int32_t u : groups.representative) {
    layouts.lay(u, pairs);
    first.push_back(first.back() + static_cast<std::int64_t>(pairs.size()) / n_lanes);
  }
  allocate(first.back());
  std::vector<Vec3> C;
  for (size_t g = 0; g < groups.representative.size(); ++g) {
    layouts.lay(groups.representative[g], pairs);
    geometry_of(graph, classes, pairs, C);
    for (size_t k = 0; k < pairs.size(); ++k) {
      set(first[g] + static_cast<std::int64_t>(k) / n_lanes, static_cast<int>(k % n_lanes),
          C[2 * k], C[2 * k + 1], distance_of(graph, pairs[k]));
    }
  }
  for (std::int64_t u = 0; u < layouts.n_units(); ++u)
    first_of_unit[u] = first[groups.of[u]];
}

template <int Dim, class Real>
void put(Real (&lanes)[Dim][n_lanes], int lane, const Vec3& value) {
  for (int i = 0; i < Dim; ++i)
    lanes[i][lane] = static_cast<Real>(value[i]);
}

/// Of the pairs that dissipate.
template <int Dim>
const Mat3& metric_of(const PairGraph& graph, const SweepGraph<Dim>& sweep) {
  return sweep.slopes.empty() ? graph.dissipation_metric : graph.slopes.metric;
}

/// Of the pairs of every node, for its own sums.
template <int Dim>
void set_directed(const PairGraph& graph,
                  const RowClasses& classes,
                  const Layouts& layouts,
                  const EqualGroups& alike,
                  SweepGraph<Dim>& sweep) {
  const Mat3& metric = metric_of(graph, sweep);
  const bool rows = sweep.shape.arrangement == Arrangement::rows,
             single = graph.precision != Precision::full;
  const auto allocate = [&](std::int64_t n) {
    sweep.strain = GeometryArray<PairVectors, Dim>(n, single);
    sweep.force = GeometryArray<PairVectors, Dim>(rows ? n : 0, single);
    sweep.area = algebra::AlignedArray<PairArea>(rows ? n : 0);
    sweep.face = algebra::AlignedArray<PairVectors<Dim, float>>(rows && single ? 0 : n);
  };
  const auto set = [&](std::int64_t chunk, int lane, const Vec3& C_ab, const Vec3& C_ba,
                       const Vec3& X_ab) {
    const Vec3 S_ab = 0.5 * (C_ab - C_ba);
    sweep.strain.change(chunk, [&](auto& geometry) { put(geometry.component, lane, C_ab); });
    if (sweep.face.size() > 0) put(sweep.face[chunk].component, lane, S_ab);
    if (!rows) return;
    sweep.force.change(chunk, [&](auto& geometry) { put(geometry.component, lane, C_ba); });
    sweep.area[chunk].area[lane] = static_cast<float>(dissipation_area(S_ab, X_ab, metric));
  };
  set_geometry(graph, classes, layouts, alike, sweep.first, allocate, set);
}

/// Of every pair once.
template <int Dim>
void set_mutual(const PairGraph& graph,
                const RowClasses& classes,
                const PairRuns& runs,
                const EqualGroups& alike,
                SweepGraph<Dim>& sweep) {
  const Mat3& metric = metric_of(graph, sweep);
  MutualPairs<Dim>& mutual = sweep.mutual;
  const PairRuns half = upward(runs);
  copy(half.row, mutual.row);
  copy(half.offset, mutual.offset);
  mutual.order = work_order(half);
  mutual.first = algebra::AlignedArray<std::int64_t>(sweep.n_blocks);
  const auto allocate = [&](std::int64_t n) {
    mutual.geometry = GeometryArray<MutualGeometry, Dim>(n, graph.precision != Precision::full);
  };
  const auto set = [&](std::int64_t chunk, int lane, const Vec3& C_ab, const Vec3& C_ba,
                       const Vec3& X_ab) {
    mutual.geometry.change(chunk, [&](auto& geometry) {
      put(geometry.C_ab, lane, C_ab);
      put(geometry.C_ba, lane, C_ba);
      geometry.area[lane] = static_cast<float>(dissipation_area(0.5 * (C_ab - C_ba), X_ab, metric));
    });
  };
  set_geometry(graph, classes, RunLayouts(graph, half), alike, mutual.first, allocate, set);
}

/// Middle of the box around the nodes.
Vec3 middle(const PairGraph& graph) {
  Vec3 lower = graph.X.front(), upper = lower;
  for (const Vec3& X : graph.X) {
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  return 0.5 * (lower + upper);
}

template <int Dim>
void set_nodes(const PairGraph& graph, const RowClasses& classes, SweepGraph<Dim>& sweep) {
  // far from the origin singles would have no digits left for the distances between nodes
  const Vec3 origin = sweep.shape.single ? middle(graph) : Vec3::Zero();
  for (std::int64_t a = 0; a < sweep.n_nodes; ++a) {
    sweep.Omega[a] = graph.Omega[a];
    sweep.inverse_Omega[a] = 1 / graph.Omega[a];
    for (int i = 0; i < Dim; ++i)
      sweep.X.set(a, i, graph.X[a][i] - origin[i]);
    if (sweep.C_sum.empty()) continue;
    for (std::int64_t k = 0; k < graph.row[a + 1] - graph.row[a]; ++k) {
      const Vec3& C = shared_C(graph, classes, a, classes.pair(graph.row[a], k));
      for (int i = 0; i < Dim; ++i)
        sweep.C_sum.set(a, i, sweep.C_sum.at(a, i) + C[i]);
    }
  }
}

template <int Dim>
void set_rows(const PairGraph& graph, const RowClasses& classes, SweepGraph<Dim>& sweep) {
  const std::int64_t n = sweep.n_blocks * n_lanes;
  sweep.row = algebra::AlignedArray<std::int64_t>(n + 1);
  for (std::int64_t a = 0; a < n; ++a) {
    sweep.row[a + 1] =
        sweep.row[a] + (a < sweep.n_nodes ? chunks_of(graph.row[a + 1] - graph.row[a]) : 0);
  }
  sweep.neighbours = algebra::AlignedArray<Neighbours>(sweep.row[n]);
  for (std::int64_t a = 0; a < sweep.n_nodes; ++a) {
    std::int32_t* node = sweep.neighbours.data()[sweep.row[a]].node;
    std::fill_n(node, (sweep.row[a + 1] - sweep.row[a]) * n_lanes, static_cast<std::int32_t>(a));
    for (std::int64_t k = 0; k < graph.row[a + 1] - graph.row[a]; ++k)
      node[k] = graph.neighbour[classes.pair(graph.row[a], k)];
  }
  sweep.first = algebra::AlignedArray<std::int64_t>(n);
  const EqualGroups alike = group_by_neighbours(graph, classes, false);
  set_directed(graph, classes, RowLayouts(graph, classes), alike, sweep);
}

template <int Dim>
void set_runs(const PairGraph& graph,
              const RowClasses& classes,
              const PairRuns& runs,
              SweepGraph<Dim>& sweep) {
  sweep.shape.arrangement = Arrangement::runs;
  sweep.shape.guard =
      std::max(runs.reach, sweep.slopes.empty() ? 0 : graph.slopes.reach()) + n_lanes;
  copy(runs.row, sweep.row);
  copy(runs.offset, sweep.offset);
  sweep.first = algebra::AlignedArray<std::int64_t>(sweep.n_blocks);
  const EqualGroups alike = group_blocks(graph, classes);
  set_directed(graph, classes, RunLayouts(graph, runs), alike, sweep);
  set_mutual(graph, classes, runs, alike, sweep);
}

}  // namespace

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph, bool has_slopes)
    : SweepGraph(graph, has_slopes, find_runs(graph)) {}

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph, bool has_slopes, const PairRuns& runs)
    : SweepGraph(graph,
                 runs.filling >= least_filling ? Arrangement::runs : Arrangement::rows,
                 has_slopes,
                 runs) {}

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph, Arrangement arrangement, bool has_slopes)
    : SweepGraph(graph, arrangement, has_slopes, find_runs(graph)) {}

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph,
                            Arrangement arrangement,
                            bool has_slopes,
                            const PairRuns& runs)
    : n_nodes(graph.n_nodes()),
      n_blocks(algebra::n_blocks_of(graph.n_nodes())),
      n_pairs(graph.n_pairs()),
      inverse_Omega(n_blocks * n_lanes),
      Omega(n_blocks * n_lanes),
      C_sum(arrangement == Arrangement::rows ? graph.n_nodes() : 0, Dim) {
  shape.single = graph.precision == Precision::single;
  if (has_slopes) slopes = SlopeGraph<Dim>(graph.slopes, arrangement);
  const RowClasses classes = classes_of(graph);
  if (arrangement == Arrangement::runs) {
    set_runs(graph, classes, runs, *this);
  } else {
    set_rows(graph, classes, *this);
  }
  X = algebra::NodeTable(n_nodes, Dim, vector_stride<Dim>, shape);
  set_nodes(graph, classes, *this);
}

template <int Dim>
std::int64_t SweepGraph<Dim>::bytes() const {
  return row.bytes() + neighbours.bytes() + offset.bytes() + first.bytes() + strain.bytes() +
         force.bytes() + area.bytes() + face.bytes() + mutual.bytes() + slopes.bytes() + X.bytes() +
         inverse_Omega.bytes() + Omega.bytes() + C_sum.bytes();
}

template struct SweepGraph<2>;
template struct SweepGraph<3>;

}  // namespace diptych::scheme
