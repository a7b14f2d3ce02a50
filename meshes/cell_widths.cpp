#include "meshes/cell_widths.hpp"

#include "meshes/cell_topology.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace diptych::meshes {

namespace {

/// Aspect from which the edges of simplices say how nodes stand, by dimension: in boxes of equal
/// sides, whose diagonals lean one way, it is 1.73 and 2.
constexpr double least_aspect_of_simplices[] = {1.745, 2.015};

/// Over the root of the determinant.
Mat3 shape_of(Mat3 squares, int dimension) {
  if (dimension == 3) return squares / std::cbrt(squares.determinant());
  squares /= std::sqrt(squares.topLeftCorner<2, 2>().determinant());
  squares(2, 2) = 1;
  return squares;
}

/// The mean of e e^T over the edges of a cell.
Mat3 squared_edges(const Mesh& mesh, std::int64_t c) {
  const auto corners = mesh.cell(c);
  const auto edges = edges_of(mesh.cell_types[c]);
  Mat3 sum = Mat3::Zero();
  for (const LocalEdge& edge : edges) {
    const Vec3 e = mesh.nodes[corners[edge[1]]] - mesh.nodes[corners[edge[0]]];
    sum += e * e.transpose() / static_cast<double>(edges.size());
  }
  return sum;
}

}  // namespace

Mat3 mean_shape(const Mesh& mesh) {
  Mat3 sum = Mat3::Zero();
  bool has_simplices = false;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    sum += squared_edges(mesh, c);
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

bool has_short_cells(const Mesh& mesh) {
  const double limit = 1.5, limit_of_simplices[] = {2.0025, 2.7108};
  double sum = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const double aspect = aspect_of(shape_of(squared_edges(mesh, c), mesh.dimension));
    sum +=
        aspect / (is_simplex(mesh.cell_types[c]) ? limit_of_simplices[mesh.dimension - 2] : limit);
  }
  return sum <= static_cast<double>(mesh.n_cells());
}

Mat3 to_equal_widths(const Mat3& shape) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(shape).operatorInverseSqrt();
}

}  // namespace diptych::meshes
