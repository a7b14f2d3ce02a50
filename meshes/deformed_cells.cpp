#include "meshes/deformed_cells.hpp"

#include "meshes/shape_integrals.hpp"

#include <cmath>
#include <limits>

namespace diptych::meshes {

double signed_volume(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x) {
  const ReferenceCell& reference = reference_cell(mesh.cell_types[cell]);
  const auto nodes = mesh.cell(cell);
  // from the first node: a body far from the origin loses no digits
  std::array<Vec3, max_cell_nodes> edge;
  for (int a = 1; a < reference.n_nodes; ++a)
    edge[a] = x[nodes[a]] - x[nodes[0]];
  double volume = 0;
  for (const QuadraturePoint& point : reference.exact) {
    Mat3 J = Mat3::Zero();
    for (int a = 1; a < reference.n_nodes; ++a)
      J += edge[a] * point.dN[a].transpose();
    if (reference.dimension == 2) J(2, 2) = 1;
    volume += point.weight * J.determinant();
  }
  return volume;
}

DeformedCells::DeformedCells(const Mesh& mesh) : mesh_(mesh) {
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
    volume_.push_back(signed_volume(mesh, c, mesh.nodes));
}

DeformedCells::Least DeformedCells::least(std::span<const Vec3> u) const {
  std::vector<Vec3> x(mesh_.nodes);
  for (size_t a = 0; a < x.size(); ++a)
    x[a] += u[a];
  Least least{std::numeric_limits<double>::infinity(), 0, 0};
  for (std::int64_t c = 0; c < mesh_.n_cells(); ++c) {
    const double J = signed_volume(mesh_, c, x) / volume_[c];
    if (!(J > 0)) ++least.n_inverted;
    // what is not finite is the worst of all
    const bool is_worst = std::isnan(J) ? !std::isnan(least.J) : J < least.J;
    if (!is_worst) continue;
    least.J = J;
    least.cell = c;
  }
  return least;
}

}  // namespace diptych::meshes
