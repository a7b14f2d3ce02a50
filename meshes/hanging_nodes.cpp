/// Boundary nodes are put into a hashed lattice of the mean edge length; each boundary edge looks
/// at the nodes around points along it, one lattice spacing apart. Sum of edge lengths over spacing
/// is the number of edges, whatever their distribution, so the work is O(boundary).
/// Test: tests/meshes/boundary_faces_test.cpp.

#include "meshes/hanging_nodes.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace diptych::meshes {

namespace {

/// Nearer to an edge than this part of its length is on it: far above the round-off of a mesher,
/// far below the thinnest sliver.
constexpr double nearness = 1e-9;

using Edge = std::pair<std::int32_t, std::int32_t>;

std::vector<Edge> boundary_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const int n = face.n_nodes == 2 ? 1 : face.n_nodes;
    for (int i = 0; i < n; ++i) {
      edges.push_back(std::minmax({face.nodes[i], face.nodes[(i + 1) % face.n_nodes]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

class Lattice {
 public:
  Lattice(const Mesh& mesh, const std::vector<Edge>& edges, double spacing)
      : mesh_(mesh), spacing_(spacing) {
    std::vector<std::int32_t> nodes;
    for (const auto& [a, b] : edges)
      nodes.insert(nodes.end(), {a, b});
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    first_.assign(std::bit_ceil(2 * nodes.size() + 2), -1);
    next_.assign(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); ++i) {
      std::int32_t& head = first_[slot_of(cell_of(mesh.nodes[nodes[i]]))];
      next_[i] = head;
      head = static_cast<std::int32_t>(i);
    }
    nodes_ = std::move(nodes);
  }

  /// Calls visit(node) for all nodes within one spacing of a place, and for some others.
  template <class Visit>
  void visit_near(const Vec3& place, Visit visit) const {
    const Vec3 cell = cell_of(place);
    const int depth = mesh_.dimension == 3 ? 1 : 0;
    for (int k = -depth; k <= depth; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const size_t slot = slot_of(cell + Vec3(i, j, k));
          for (std::int32_t n = first_[slot]; n >= 0; n = next_[n])
            visit(nodes_[n]);
        }
      }
    }
  }

 private:
  Vec3 cell_of(const Vec3& place) const { return (place / spacing_).array().floor(); }

  size_t slot_of(const Vec3& cell) const {
    std::uint64_t hash = 0;
    for (int d = 0; d < 3; ++d) {
      // The low bits of a double that holds a small whole number are zero: fold the high ones in.
      hash = (hash ^ std::bit_cast<std::uint64_t>(cell[d] + 0.0)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 40;
      hash *= 0xbf58476d1ce4e5b9ULL;
      hash ^= hash >> 31;
    }
    return hash & (first_.size() - 1);
  }

  const Mesh& mesh_;
  double spacing_;
  std::vector<std::int32_t> nodes_, first_, next_;
};

/// Whether p lies on the segment from a to b, its ends included.
bool lies_on(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double length = edge.norm();
  const double along = std::clamp((p - a).dot(edge) / (length * length), 0.0, 1.0);
  return (p - a - along * edge).norm() <= nearness * length;
}

[[noreturn]] void refuse(const Vec3& p, const Vec3& a, const Vec3& b) {
  throw base::InputError(fmt::format(
      "a node at ({:.6g}, {:.6g}, {:.6g}) lies on the edge from ({:.6g}, {:.6g}, {:.6g}) to "
      "({:.6g}, {:.6g}, {:.6g}) and is not joined to it: a hanging node, or parts that touch "
      "without shared nodes (Gmsh: Coherence, BooleanFragments)",
      p[0], p[1], p[2], a[0], a[1], a[2], b[0], b[1], b[2]));
}

}  // namespace

void refuse_hanging_nodes(const Mesh& mesh) {
  const std::vector<Edge> edges = boundary_edges(mesh);
  if (edges.empty()) return;
  double spacing = 0;
  for (const auto& [a, b] : edges) {
    spacing += (mesh.nodes[b] - mesh.nodes[a]).norm() / static_cast<double>(edges.size());
  }
  const Lattice lattice(mesh, edges, spacing);
  for (const auto& edge : edges) {
    const Vec3 &a = mesh.nodes[edge.first], &b = mesh.nodes[edge.second];
    const int n_points = static_cast<int>(std::ceil((b - a).norm() / spacing));
    for (int i = 0; i <= n_points; ++i) {
      const Vec3 point = a + (b - a) * (static_cast<double>(i) / n_points);
      lattice.visit_near(point, [&](std::int32_t node) {
        if (node == edge.first || node == edge.second) return;
        if (lies_on(mesh.nodes[node], a, b)) refuse(mesh.nodes[node], a, b);
      });
    }
  }
}

}  // namespace diptych::meshes
