#include "meshes/deformed_cells.hpp"

#include "common/algebra/lanes.hpp"
#include "meshes/shape_integrals.hpp"

#include <cmath>
#include <limits>

namespace diptych::meshes {

using algebra::Lanes;
using algebra::n_lanes;

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

namespace {

/// The same of eight cells of one type, with the same bits: compiled without fused multiply-adds.
/// @param cell  the first of them
void signed_volumes(const Mesh& mesh, std::int64_t cell, std::span<const Vec3> x, double* volumes) {
  const ReferenceCell& reference = reference_cell(mesh.cell_types[cell]);
  Lanes edge[max_cell_nodes][3];
  for (int lane = 0; lane < n_lanes; ++lane) {
    const auto nodes = mesh.cell(cell + lane);
    const Vec3& origin = x[nodes[0]];
    for (int a = 1; a < reference.n_nodes; ++a) {
      for (int i = 0; i < 3; ++i)
        edge[a][i][lane] = x[nodes[a]][i] - origin[i];
    }
  }
  Lanes volume = Lanes{};
  for (const QuadraturePoint& point : reference.exact) {
    Lanes J[3][3] = {};
    for (int a = 1; a < reference.n_nodes; ++a) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          J[i][j] = J[i][j] + edge[a][i] * point.dN[a][j];
      }
    }
    if (reference.dimension == 2) J[2][2] = Lanes{} + 1.0;
    const auto minor = [&](int a, int b, int c) {
      return J[0][a] * (J[1][b] * J[2][c] - J[1][c] * J[2][b]);
    };
    volume = volume + point.weight * (minor(0, 1, 2) - minor(1, 0, 2) + minor(2, 0, 1));
  }
  for (int lane = 0; lane < n_lanes; ++lane)
    volumes[lane] = volume[lane];
}

/// Of all cells.
std::vector<double> all_volumes(const Mesh& mesh, std::span<const Vec3> x) {
  const std::int64_t n = mesh.n_cells();
  std::vector<double> volumes(static_cast<size_t>(n));
  const auto are_alike = [&](std::int64_t first) {
    for (std::int64_t c = first + 1; c < first + n_lanes; ++c) {
      if (mesh.cell_types[c] != mesh.cell_types[first]) return false;
    }
    return true;
  };
  for (std::int64_t c = 0; c < n;) {
    if (c + n_lanes <= n && are_alike(c)) {
      signed_volumes(mesh, c, x, &volumes[static_cast<size_t>(c)]);
      c += n_lanes;
    } else {
      volumes[static_cast<size_t>(c)] = signed_volume(mesh, c, x);
      ++c;
    }
  }
  return volumes;
}

}  // namespace

DeformedCells::DeformedCells(const Mesh& mesh)
    : mesh_(mesh), volume_(all_volumes(mesh, mesh.nodes)) {}

DeformedCells::Least DeformedCells::least(std::span<const Vec3> u) const {
  std::vector<Vec3> x(mesh_.nodes);
  for (size_t a = 0; a < x.size(); ++a)
    x[a] += u[a];
  const std::vector<double> volumes = all_volumes(mesh_, x);
  Least least{std::numeric_limits<double>::infinity(), 0, 0};
  for (std::int64_t c = 0; c < mesh_.n_cells(); ++c) {
    const double J = volumes[static_cast<size_t>(c)] / volume_[c];
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
