#pragma once
/// Shape functions of the first-order cells and the two quadrature rules that the graphs use.
///
/// Conventions: node order of Gmsh/VTK (mesh.hpp); reference cells are the unit simplices, the
/// squares and cubes [-1,1]^d, and the prism unit triangle x [-1,1]. Two-dimensional cells are
/// embedded in z = 0 with a unit third direction: J_33 = 1, dN/dz = 0, so cof J grad N has no z.
/// Test: tests/graphs/shape_integrals_test.cpp.

#include "meshes/mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace diptych::meshes {

using algebra::Mat3;

inline constexpr int max_cell_nodes = 8;

/// vertex: weights at the cell's nodes (notes 4.2); exact: integrates N_a grad N_b, N_a and,
/// on faces, N_a N exactly on every cell with the given corners, however distorted: the cofactor of
/// the Jacobian has degree 2 in its own direction, so two Gauss points (degree 3) are enough.
enum class Quadrature { vertex, exact };

/// One point of a rule with everything evaluated there.
struct QuadraturePoint {
  double weight = 0;                       ///< reference measure                             [-]
  std::array<double, max_cell_nodes> N{};  ///< shape functions                               [-]
  std::array<Vec3, max_cell_nodes> dN{};   ///< reference gradients, z = 0 in 2-D             [-]
};

struct ReferenceCell {
  int dimension = 0;
  int n_nodes = 0;
  std::array<Vec3, max_cell_nodes> nodes{};  ///< reference coordinates
  std::vector<QuadraturePoint> vertex;       ///< point q is node q
  std::vector<QuadraturePoint> exact;
  /// Gauss points, three a direction: integrates cubics of X on planes, quadratics in space,
  /// exactly.
  std::vector<QuadraturePoint> fine;
  /// The nodes joined to each node by an edge (dimension of them), right-handed.
  std::array<std::array<int, 3>, max_cell_nodes> edges{};

  const std::vector<QuadraturePoint>& rule(Quadrature quadrature) const {
    return quadrature == Quadrature::vertex ? vertex : exact;
  }
};

/// The table of a cell type, made on first use.
const ReferenceCell& reference_cell(CellType type);

/// dX/dxi at a point of a rule; the embedding of 2-D cells included.
/// @param nodes the cell's nodes, indices into X
/// @param X     [n_nodes] m
Mat3 jacobian(const ReferenceCell& cell,
              const QuadraturePoint& point,
              std::span<const std::int32_t> nodes,
              const std::vector<Vec3>& X);

/// cof J = det J * J^-T (columns are cross products of J's columns).
Mat3 cofactor(const Mat3& J);

/// Shares of a boundary face's area vector: int N_a N dA (exact), or the face's normal at the node
/// times a quarter (vertex); both are the same on edges, triangles and parallelograms.
/// @return [face.n_nodes] m^2 (m in 2-D), outward
std::array<Vec3, 4> face_area_shares(const BoundaryFace& face,
                                     const std::vector<Vec3>& X,
                                     Quadrature quadrature);
/// The sum of these: int N dA, outward.  [m^2, m in 2-D]
Vec3 face_area(const BoundaryFace& face, const std::vector<Vec3>& X);

}  // namespace diptych::meshes
