#pragma once
/// The cells of a mesh with the shares of their volumes that are their corners': what the volumes
/// of deformed cells are given back to nodes by (notes 3.9). Test:
/// tests/graphs/dual_measure_test.cpp

#include "meshes/mesh.hpp"
#include "meshes/shape_integrals.hpp"

namespace diptych::meshes {

struct CellShares {
  std::vector<std::int64_t> row;     ///< [n_cells + 1]
  std::vector<std::int32_t> corner;  ///< nodes
  std::vector<double> share;         ///< of the cell's volume; those of a cell add up to one
};

/// By the rule that made the volumes of the nodes.
CellShares cell_shares(const Mesh& mesh, Quadrature quadrature);

/// Whether the area vectors of boundary nodes are the derivatives of the volume that bilinear faces
/// enclose, which a uniform pressure in cells acts on: always by the exact rule, by the vertex rule
/// on edges, triangles and parallelograms.
bool areas_are_of_cells(const Mesh& mesh, Quadrature quadrature);

}  // namespace diptych::meshes
