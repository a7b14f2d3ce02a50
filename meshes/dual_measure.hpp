#pragma once
/// Nodal volumes and boundary area vectors of a mesh, the measure that both methods share.
///
/// Equations, in two forms:
///   exact:  Omega_a = int N_a dV, A_a N_a = oint N_a N dA                      (notes 4.1)
///   vertex: both by the vertex rule of the edge stencil, the volumes scaled to the exact total and
///           the areas balanced (see the source).
/// Both satisfy sum_a A_aN_a = 0 and sum_a X_a (x) A_aN_a = sum_a Omega_a I, without which no
/// linear-exact set of C_ab can close. They agree on simplices, rectangles and bricks. On curved
/// hexahedral meshes the edge stencil nearly closes with the vertex form only (its gap is of second
/// order, with the exact form of first), so this is what both methods use by default.
/// Test: tests/graphs/dual_measure_test.cpp.

#include "meshes/mesh.hpp"
#include "meshes/shape_integrals.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::meshes {

/// Share of the nodes in one boundary group.
struct PatchArea {
  std::string name;
  std::vector<std::int32_t> nodes;  ///< ascending
  std::vector<Vec3> area;           ///< [nodes] m^2 (m in 2-D), outward
  /// Corners of the faces, outward; -1 where a face has fewer than four.
  std::vector<std::array<std::int32_t, 4>> faces;
};

struct DualMeasure {
  std::vector<double> Omega;        ///< [n_nodes] m^3 (m^2 in 2-D), all > 0
  std::vector<Vec3> boundary_area;  ///< [n_nodes] m^2, over all boundary faces
  std::vector<PatchArea> patches;   ///< one per boundary group, same order
};

/// @pre    mesh.boundary_faces are filled and outward
/// @throws base::InputError on a cell of non-positive volume or a node of non-positive share
///         (its number and place), and where the boundary faces do not close the cells
DualMeasure dual_measure(const Mesh& mesh, Quadrature quadrature);

/// Part of the full angle (of 2 pi or 4 pi) around each node that cells fill: 1 inside, 1/2 on a
/// plane side, 1/8 at the corner of a box. Corners are measured between their edges, so that the
/// angles of neighbouring cells fit together whatever the shape of their faces.
std::vector<double> filled_angle(const Mesh& mesh);

}  // namespace diptych::meshes
