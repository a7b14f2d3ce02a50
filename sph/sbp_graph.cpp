#include "sph/sbp_graph.hpp"

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "meshes/block_measure.hpp"
#include "meshes/line_slopes.hpp"
#include "sph/lattice_operator.hpp"
#include "sph/volume_lines.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <tuple>

namespace diptych::sph {

namespace {

using meshes::StructuredBlock;

const meshes::BlockUse use{"sph.gradient = \"sbp\"", "sph.gradient = \"corrected\""};

std::vector<std::vector<double>> weights_of(const StructuredBlock& block) {
  std::vector<std::vector<double>> H;
  for (int d = 0; d < block.dimension; ++d) {
    H.emplace_back();
    for (int i = 0; i < block.n_nodes[d]; ++i)
      H.back().push_back(lattice_weight(i, block.n_nodes[d]));
  }
  return H;
}

/// A neighbour of a node by its offset on the lattice.
struct LatticePair {
  LatticeOffset offset;
  std::uint32_t C;  ///< among those of all rows
};

/// Rows of the nodes of a block. A row depends on where its node is near to an end of a line, no
/// farther than its support or the layers reach, and is the same elsewhere: each stands once.
class RowsOfBlock {
 public:
  RowsOfBlock(const meshes::BlockMeasure& measure, const LatticeOperator& lattice)
      : block_(measure.block()) {
    for (const LatticeOffset& offset : lattice.offsets()) {
      for (const int component : offset)
        near_ = std::max(near_, std::abs(component));
    }
    for (int k = 0; k < n_kinds(2); ++k) {
      for (int j = 0; j < n_kinds(1); ++j) {
        for (int i = 0; i < n_kinds(0); ++i)
          rows_.push_back(
              row_of({first_of(0, i), first_of(1, j), first_of(2, k)}, measure, lattice));
      }
    }
  }

  size_t n_kinds() const { return rows_.size(); }
  size_t kind(std::int64_t a) const {
    const auto& at = block_.place[a];
    return static_cast<size_t>((kind(2, at[2]) * n_kinds(1) + kind(1, at[1])) * n_kinds(0) +
                               kind(0, at[0]));
  }
  const std::vector<LatticePair>& row(std::int64_t a) const { return rows_[kind(a)]; }
  std::vector<Vec3> take_areas() { return std::move(C_); }

 private:
  bool is_long(int d) const { return block_.n_nodes[d] > 2 * near_ + 1; }
  int n_kinds(int d) const { return is_long(d) ? 2 * near_ + 1 : block_.n_nodes[d]; }
  int kind(int d, int place) const {
    const int from_end = block_.n_nodes[d] - 1 - place;
    if (!is_long(d) || place < near_) return place;
    return from_end < near_ ? 2 * near_ - from_end : near_;
  }
  /// The first place of a kind.
  int first_of(int d, int kind) const {
    return kind <= near_ || !is_long(d) ? kind : block_.n_nodes[d] - 1 - (2 * near_ - kind);
  }

  std::vector<LatticePair> row_of(const LatticeOffset& place,
                                  const meshes::BlockMeasure& measure,
                                  const LatticeOperator& lattice) {
    std::vector<LatticePair> row;
    for (const LatticeOffset& offset : lattice.offsets()) {
      bool is_inside = true;
      for (int d = 0; d < block_.dimension; ++d) {
        const int at = place[d] + offset[d];
        is_inside = is_inside && at >= 0 && at < block_.n_nodes[d];
      }
      if (!is_inside) continue;
      const Vec3 C = lattice.C(place, offset);
      Vec3 in_space = Vec3::Zero();
      for (int d = 0; d < block_.dimension; ++d)
        in_space += C[d] * measure.face(d);
      row.push_back({offset, static_cast<std::uint32_t>(C_.size())});
      C_.push_back(in_space);
    }
    std::sort(row.begin(), row.end(), [](const LatticePair& p, const LatticePair& q) {
      return std::lexicographical_compare(p.offset.rbegin(), p.offset.rend(), q.offset.rbegin(),
                                          q.offset.rend());
    });
    return row;
  }

  const StructuredBlock& block_;
  int near_ = lattice_layers;
  std::vector<std::vector<LatticePair>> rows_;
  std::vector<Vec3> C_;  ///< m^2
};

/// Puts row a where graph.row says, ascending.
/// @return whether the pairs stood in that order in the row of its kind
bool put_row(const StructuredBlock& block,
             const std::vector<LatticePair>& row,
             std::int64_t a,
             scheme::PairGraph& graph,
             algebra::SharedVectors::Numbers& C) {
  const std::int64_t first = graph.row[a];
  std::int64_t p = first;
  for (const LatticePair& pair : row) {
    auto at = block.place[a];
    for (int d = 0; d < block.dimension; ++d)
      at[d] += pair.offset[d];
    graph.neighbour[p] = block.node_at(at);
    C[p++] = pair.C;
  }
  const auto begin = graph.neighbour.begin() + first, end = graph.neighbour.begin() + p;
  if (std::is_sorted(begin, end)) return true;
  std::vector<std::pair<std::int32_t, std::uint32_t>> sorted;
  for (std::int64_t q = first; q < p; ++q)
    sorted.emplace_back(graph.neighbour[q], C[q]);
  std::sort(sorted.begin(), sorted.end());
  for (std::int64_t q = first; q < p; ++q)
    std::tie(graph.neighbour[q], C[q]) = sorted[static_cast<size_t>(q - first)];
  return false;
}

/// Volumes, boundary areas, pairs and, where they stand in the common order, classes of rows.
void put_nodes(const meshes::BlockMeasure& measure, RowsOfBlock rows, scheme::PairGraph& graph) {
  const std::int64_t n = graph.n_nodes();
  graph.row.assign(1, 0);
  graph.row.reserve(static_cast<size_t>(n) + 1);
  for (std::int64_t a = 0; a < n; ++a)
    graph.row.push_back(graph.row.back() + static_cast<std::int64_t>(rows.row(a).size()));
  graph.Omega.resize(static_cast<size_t>(n));
  graph.boundary_area.resize(static_cast<size_t>(n));
  graph.neighbour.resize(static_cast<size_t>(graph.row.back()));
  algebra::SharedVectors::Numbers C(graph.neighbour.size());
  std::vector<char> in_order(static_cast<size_t>(parallel::n_chunks_of(n)), 1);
  parallel::for_chunks(n, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
    for (std::int64_t a = begin; a < end; ++a) {
      graph.Omega[a] = measure.volume(a);
      graph.boundary_area[a] = measure.boundary_area(a);
      if (!put_row(measure.block(), rows.row(a), a, graph, C)) in_order[chunk] = 0;
    }
  });
  graph.C = algebra::SharedVectors(rows.take_areas(), std::move(C));
  if (std::find(in_order.begin(), in_order.end(), 0) != in_order.end()) {
    set_classes(graph);
    return;
  }
  scheme::EqualGroups alike;  // in the order of their first nodes
  std::vector<std::int32_t> group(rows.n_kinds(), -1);
  alike.of.reserve(static_cast<size_t>(n));
  for (std::int64_t a = 0; a < n; ++a) {
    std::int32_t& of = group[rows.kind(a)];
    if (of < 0) {
      of = static_cast<std::int32_t>(alike.representative.size());
      alike.representative.push_back(static_cast<std::int32_t>(a));
    }
    alike.of.push_back(of);
  }
  set_classes(graph, alike);
  if (!graph.classes.order.empty()) graph.classes = {};  // its edges turn the order round
}

}  // namespace

scheme::PairGraph sbp_graph(const meshes::Mesh& mesh, const Kernel& kernel, double kappa) {
  StructuredBlock block = meshes::structured_block(mesh, use);
  std::vector<std::vector<double>> H = weights_of(block);
  const LatticeOperator lattice(kernel, kappa, block.n_nodes);
  const meshes::BlockMeasure measure(mesh, std::move(block), std::move(H), use);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  put_nodes(measure, RowsOfBlock(measure, lattice), graph);
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    meshes::PatchArea patch = measure.patch(group);
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
  link_reverse_pairs(graph);
  graph.lines = volume_lines(measure);
  graph.dissipation_metric = scheme::metric_of_lines(measure.edges());
  meshes::LineSlopes slopes = meshes::line_slopes(
      measure.block(), measure.edges(), [&](auto a, auto b) { return area_between(graph, a, b); });
  graph.slopes = {std::move(slopes.row), std::move(slopes.neighbour), std::move(slopes.weight),
                  scheme::metric_of_lines(measure.edges())};
  validate(graph);
  return graph;
}

std::string unsure_because(const meshes::Mesh& mesh, const Kernel& kernel, double kappa) {
  const double support = kernel.support * kappa;
  if (!(support > 2)) return "the support is two spacings or less";
  if (support > widest_sure_support) return "the support is more than four spacings";
  if (!meshes::is_undistorted_block(mesh)) return "";
  StructuredBlock block = meshes::structured_block(mesh, use);
  for (int d = 0; d < block.dimension; ++d) {
    if (block.n_nodes[d] < least_nodes) return fmt::format("lines of {} nodes", block.n_nodes[d]);
  }
  std::vector<std::vector<double>> H = weights_of(block);
  return meshes::BlockMeasure(mesh, std::move(block), std::move(H), use).unfit_group();
}

std::string sbp_text(double kappa) {
  return fmt::format("sbp: order 4 inside, 2 within {} nodes of the boundary, kappa {:.4g}",
                     lattice_layers, kappa);
}

std::vector<std::string> sbp_notices(const meshes::Mesh& mesh) {
  constexpr int enough = 2 * lattice_layers;
  const StructuredBlock block = meshes::structured_block(mesh, use);
  const algebra::Mat3 edges = meshes::cell_edges(mesh, block, use);
  std::vector<std::string> notices;
  for (int d = 0; d < block.dimension; ++d) {
    if (block.n_nodes[d] >= enough) continue;
    const Vec3 e = edges.col(d).normalized() + Vec3::Zero();  // no -0
    notices.push_back(fmt::format(
        "sbp: {} nodes along ({:.3g}, {:.3g}, {:.3g}): with fewer than {} and without slopes along "
        "lines (scheme.reconstruction = \"quartic\") the sign of the numerical dissipation is not "
        "known (notes 4.4)",
        block.n_nodes[d], e[0], e[1], e[2], enough));
  }
  return notices;
}

}  // namespace diptych::sph
