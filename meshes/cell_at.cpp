#include "meshes/cell_at.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace diptych::meshes {

namespace {

/// How far outside a cell a place may be, over the cell's width.
constexpr double most_outside = 0.1;

using Simplex = std::array<int, 4>;  // in the plane the first three

/// Simplices that fill a cell, of quadrilaterals on either side of both diagonals.
std::span<const Simplex> simplices_of(CellType type) {
  static constexpr Simplex triangle[] = {{0, 1, 2, 0}};
  static constexpr Simplex quadrilateral[] = {
      {0, 1, 2, 0}, {0, 2, 3, 0}, {0, 1, 3, 0}, {1, 2, 3, 0}};
  static constexpr Simplex tetrahedron[] = {{0, 1, 2, 3}};
  static constexpr Simplex prism[] = {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}};
  static constexpr Simplex hexahedron[] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                           {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  switch (type) {
    case CellType::triangle:
      return triangle;
    case CellType::quadrilateral:
      return quadrilateral;
    case CellType::tetrahedron:
      return tetrahedron;
    case CellType::prism:
      return prism;
    case CellType::hexahedron:
      return hexahedron;
  }
  __builtin_unreachable();
}

/// The least of the barycentric coordinates of a place in a simplex.
double least_coordinate(const Mesh& mesh,
                        std::span<const std::int32_t> corners,
                        const Simplex& simplex,
                        const Vec3& place) {
  const Vec3& origin = mesh.nodes[corners[simplex[0]]];
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  for (int i = 0; i < mesh.dimension; ++i)
    edges.col(i) = mesh.nodes[corners[simplex[i + 1]]] - origin;
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(edges);
  if (!solver.isInvertible()) return -std::numeric_limits<double>::infinity();
  const Vec3 x = solver.solve(place - origin);
  double least = 1, sum = 0;
  for (int i = 0; i < mesh.dimension; ++i) {
    least = std::min(least, x[i]);
    sum += x[i];
  }
  return std::min(least, 1 - sum);
}

/// Whether a place is in the box around a cell that is wider by half of its size.
bool is_near(const Mesh& mesh, std::span<const std::int32_t> corners, const Vec3& place) {
  Vec3 lower = mesh.nodes[corners[0]], upper = lower;
  for (const std::int32_t a : corners) {
    lower = lower.cwiseMin(mesh.nodes[a]);
    upper = upper.cwiseMax(mesh.nodes[a]);
  }
  const double margin = 0.5 * (upper - lower).maxCoeff();
  for (int i = 0; i < mesh.dimension; ++i) {
    if (place[i] < lower[i] - margin || place[i] > upper[i] + margin) return false;
  }
  return true;
}

}  // namespace

std::vector<std::int32_t> nodes_of_cells_at(const Mesh& mesh, const Vec3& place) {
  constexpr double rounding = 1e-9;
  std::vector<std::int32_t> nodes;
  double deepest = -most_outside;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    if (!is_near(mesh, corners, place)) continue;
    double depth = -std::numeric_limits<double>::infinity();
    for (const Simplex& simplex : simplices_of(mesh.cell_types[c]))
      depth = std::max(depth, least_coordinate(mesh, corners, simplex, place));
    depth = std::min(depth, 0.0);  // all that hold it count alike
    if (depth < deepest - rounding) continue;
    if (depth > deepest + rounding) nodes.clear();
    deepest = std::max(deepest, depth);
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace diptych::meshes
