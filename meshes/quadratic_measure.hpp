#pragma once
/// Nodal volumes exact for quadratics and boundary areas exact for cubics, on any mesh of a body
/// with plane sides: what operators that sum by parts need where nodes are no lattice.
///
/// The volume of every cell goes to its corners as int N_a dV, then changes least, over these and
/// the nodes around them, such that for all quadratics q
///   sum_a w_a q(X_a) = int_cell q dV;
/// the area of every boundary face likewise, over nodes of the same side, for all cubics of the
/// plane. A node at distance r of the middle takes part with the weight exp(-0.6 r^2/h^2), h the
/// mean length of the cell's edges. So
///   sum_a Omega_a d_i X^m = sum_a (A_aN_a)_i X_a^m   for all monomials up to degree 3,
/// without which rows exact for quadratics have no adjoint that is exact for linear stresses.
/// Source: notes 4.5. Test: tests/graphs/quadratic_measure_test.cpp

#include "meshes/dual_measure.hpp"
#include "meshes/structured_block.hpp"

namespace diptych::meshes {

/// Faces of the boundary belong to one side where they are joined by edges, lie in one plane and
/// are of the same groups.
/// @param  use  who asks, and what to use instead, for messages
/// @pre    mesh.boundary_faces are filled and outward
/// @throws base::InputError where sides are curved or have too few nodes, and where a volume is not
///         positive
DualMeasure quadratic_measure(const Mesh& mesh, const BlockUse& use = {});

}  // namespace diptych::meshes
