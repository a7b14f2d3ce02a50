#include "fvm/sbp_graph.hpp"

#include "common/base/error.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "fvm/sbp_operator.hpp"
#include "fvm/structured_block.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::fvm {

namespace {

using meshes::BoundaryFace;
using meshes::Mesh;
using Place = std::array<std::int32_t, 3>;

/// One of the two ends of the lines of a direction.
struct Side {
  int direction = 0;
  bool is_far = false;
};

class TensorProduct {
 public:
  TensorProduct(const Mesh& mesh, int order)
      : mesh_(mesh), block_(structured_block(mesh)), edges_(cell_edges(mesh, block_)) {
    for (int d = 0; d < block_.dimension; ++d) {
      const int n = block_.n_nodes[d];
      along_.emplace_back(widest_sbp_table(order, n), n);
    }
  }

  double volume(std::int64_t a) const {
    double Omega = edges_.determinant();
    for (int d = 0; d < block_.dimension; ++d)
      Omega *= along_[d].H(block_.place[a][d]);
    return Omega;
  }

  /// M_d times the weights of the other directions: pseudo-area of node a per unit of Q.
  Vec3 area(std::int64_t a, int d) const {
    Vec3 M = edges_.col((d + 1) % 3).cross(edges_.col((d + 2) % 3));
    for (int t = 0; t < block_.dimension; ++t) {
      if (t != d) M *= along_[t].H(block_.place[a][t]);
    }
    return M;
  }

  /// Adds row a to the graph.
  void add_row(std::int64_t a, scheme::PairGraph& graph) {
    row_.clear();
    for (int d = 0; d < block_.dimension; ++d) {
      const Vec3 M = area(a, d);
      Place at = block_.place[a];
      for (const SbpOperator::Entry& entry : along_[d].row(block_.place[a][d])) {
        at[d] = entry.node;
        row_.emplace_back(block_.node_at(at), 2 * entry.Q * M);
      }
    }
    std::sort(row_.begin(), row_.end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [b, C] : row_) {
      graph.neighbour.push_back(b);
      graph.C.push_back(C);
    }
    graph.row.push_back(graph.n_pairs());
  }

  Vec3 boundary_area(std::int64_t a) const {
    Vec3 sum = Vec3::Zero();
    for (int d = 0; d < block_.dimension; ++d) {
      const std::int32_t i = block_.place[a][d];
      if (i == 0) sum -= area(a, d);
      if (i == block_.n_nodes[d] - 1) sum += area(a, d);
    }
    return sum;
  }

  scheme::BoundaryPatch patch(const meshes::BoundaryGroup& group) const {
    scheme::BoundaryPatch patch;
    patch.name = group.name;
    std::vector<std::pair<std::int32_t, Vec3>> shares;
    Vec3 whole = Vec3::Zero();
    for (const std::int32_t f : group.faces) {
      const BoundaryFace& face = mesh_.boundary_faces[f];
      const Side side = side_of(face);
      const double sign = side.is_far ? 1 : -1;
      whole +=
          sign * edges_.col((side.direction + 1) % 3).cross(edges_.col((side.direction + 2) % 3));
      for (int i = 0; i < face.n_nodes; ++i) {
        const std::int32_t a = face.nodes[i];
        shares.emplace_back(a, sign * area(a, side.direction) / n_faces_on_side(a, side));
      }
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const auto& p, const auto& q) { return p.first < q.first; });
    Vec3 sum = Vec3::Zero();
    for (const auto& [a, share] : shares) {
      if (patch.nodes.empty() || patch.nodes.back() != a) {
        patch.nodes.push_back(a);
        patch.area.push_back(Vec3::Zero());
      }
      patch.area.back() += share;
      sum += share;
    }
    check_area(group, sum, whole, patch);
    return patch;
  }

 private:
  /// @pre the face is of the boundary, so of a side
  Side side_of(const BoundaryFace& face) const {
    for (int d = 0; d < block_.dimension; ++d) {
      for (const bool is_far : {false, true}) {
        const std::int32_t end = is_far ? block_.n_nodes[d] - 1 : 0;
        const auto on_side = [&](std::int32_t a) { return block_.place[a][d] == end; };
        if (std::all_of(face.nodes.begin(), face.nodes.begin() + face.n_nodes, on_side))
          return {d, is_far};
      }
    }
    const Vec3& X = mesh_.nodes[face.nodes[0]];
    throw base::InputError(fmt::format(
        "the boundary face with node {} at ({:.6g}, {:.6g}, {:.6g}) is on no side of the block; "
        "repair the mesh",
        face.nodes[0], X[0], X[1], X[2]));
  }

  /// Faces of the side around one of its nodes.
  double n_faces_on_side(std::int32_t a, const Side& side) const {
    double n = 1;
    for (int t = 0; t < block_.dimension; ++t) {
      const std::int32_t i = block_.place[a][t];
      if (t != side.direction && i != 0 && i != block_.n_nodes[t] - 1) n *= 2;
    }
    return n;
  }

  /// @throws base::InputError where a part of a side ends inside its boundary block
  void check_area(const meshes::BoundaryGroup& group,
                  const Vec3& sum,
                  const Vec3& whole,
                  const scheme::BoundaryPatch& patch) const {
    double size = 0;
    for (const Vec3& area : patch.area)
      size += area.norm();
    if ((sum - whole).norm() <= 1e-12 * size) return;
    throw base::InputError(
        fmt::format("boundary group '{}' ends within the first nodes of a side, where the weights "
                    "of fvm.stencil "
                    "= \"sbp\" are not those of its faces (area {:.6g} instead of {:.6g}): let it "
                    "cover the whole "
                    "side or end farther from its edge, or use fvm.stencil = \"edge\"",
                    group.name, sum.norm(), whole.norm()));
  }

  const Mesh& mesh_;
  StructuredBlock block_;
  Mat3 edges_;
  std::vector<SbpOperator> along_;
  std::vector<std::pair<std::int32_t, Vec3>> row_;
};

}  // namespace

scheme::PairGraph sbp_graph(const Mesh& mesh, int order) {
  TensorProduct product(mesh, order);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.row.assign(1, 0);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    graph.Omega.push_back(product.volume(a));
    graph.boundary_area.push_back(product.boundary_area(a));
    product.add_row(a, graph);
  }
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups)
    graph.patches.push_back(product.patch(group));
  link_reverse_pairs(graph);
  set_classes(graph);
  graph.commutes = true;
  validate(graph);
  return graph;
}

std::vector<SbpLines> sbp_lines(const Mesh& mesh, int order) {
  const StructuredBlock block = structured_block(mesh);
  const Mat3 edges = cell_edges(mesh, block);
  std::vector<SbpLines> lines;
  for (int d = 0; d < block.dimension; ++d) {
    const int n = block.n_nodes[d];
    const Vec3 direction = edges.col(d).normalized() + Vec3::Zero();  // no -0
    lines.push_back({direction, n, widest_sbp_table(order, n).order});
  }
  return lines;
}

std::string lines_text(const std::vector<SbpLines>& lines) {
  std::string text = "sbp:";
  for (const SbpLines& line : lines) {
    const auto& e = line.direction;
    text +=
        fmt::format("{} order {} on {} nodes along ({:.3g}, {:.3g}, {:.3g})",
                    &line == lines.data() ? "" : ",", line.order, line.n_nodes, e[0], e[1], e[2]);
  }
  return text;
}

}  // namespace diptych::fvm
