#include "meshes/cell_shares.hpp"

namespace diptych::meshes {

CellShares cell_shares(const Mesh& mesh, Quadrature quadrature) {
  CellShares shares{mesh.cell_offsets, mesh.cell_nodes, {}};
  shares.share.assign(mesh.cell_nodes.size(), 0.0);
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const ReferenceCell& cell = reference_cell(mesh.cell_types[c]);
    const auto nodes = mesh.cell(c);
    double* share = &shares.share[mesh.cell_offsets[c]];
    double volume = 0;
    for (const QuadraturePoint& point : cell.rule(quadrature)) {
      const double weight = point.weight * jacobian(cell, point, nodes, mesh.nodes).determinant();
      volume += weight;
      for (int a = 0; a < cell.n_nodes; ++a)
        share[a] += weight * point.N[a];
    }
    for (int a = 0; a < cell.n_nodes; ++a)
      share[a] /= volume;
  }
  return shares;
}

/// Part of an area by which generators miss the parallelograms that are meant: Gmsh places nodes of
/// graded lines to 1e-9 of a cell.
constexpr double of_generators = 1e-6;

bool areas_are_of_cells(const Mesh& mesh, Quadrature quadrature) {
  if (quadrature == Quadrature::exact) return true;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const auto exact = face_area_shares(face, mesh.nodes, Quadrature::exact);
    const auto vertex = face_area_shares(face, mesh.nodes, Quadrature::vertex);
    for (int a = 0; a < face.n_nodes; ++a) {
      if ((exact[a] - vertex[a]).norm() > of_generators * exact[a].norm()) return false;
    }
  }
  return true;
}

}  // namespace diptych::meshes
