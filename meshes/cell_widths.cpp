#include "meshes/cell_widths.hpp"

#include "meshes/cell_topology.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace diptych::meshes {

namespace {

/// Aspect from which the edges of simplices say how nodes stand, by dimension: in boxes of equal
/// sides, whose diagonals lean one way, it is 1.73 and 2.
constexpr double least_aspect_of_simplices[] = {1.745, 2.015};

bool is_simplex(CellType type) {
  return type == CellType::triangle || type == CellType::tetrahedron;
}

/// Over the root of the determinant.
Mat3 shape_of(Mat3 squares, int dimension) {
  if (dimension == 3) return squares / std::cbrt(squares.determinant());
  squares /= std::sqrt(squares.topLeftCorner<2, 2>().determinant());
  squares(2, 2) = 1;
  return squares;
}

}  // namespace

Mat3 mean_shape(const Mesh& mesh) {
  Mat3 sum = Mat3::Zero();
  bool has_simplices = false;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    const auto edges = edges_of(mesh.cell_types[c]);
    for (const LocalEdge& edge : edges) {
      const Vec3 e = mesh.nodes[corners[edge[1]]] - mesh.nodes[corners[edge[0]]];
      sum += e * e.transpose() / static_cast<double>(edges.size());
    }
    has_simplices = has_simplices || is_simplex(mesh.cell_types[c]);
  }
  const Mat3 shape = shape_of(sum, mesh.dimension);
  if (has_simplices && aspect_of(shape) < least_aspect_of_simplices[mesh.dimension - 2])
    return Mat3::Identity();
  return shape;
}

double aspect_of(const Mat3& shape) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(shape, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()[2] / solver.eigenvalues()[0]);
}

Mat3 to_equal_widths(const Mat3& shape) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(shape).operatorInverseSqrt();
}

}  // namespace diptych::meshes
