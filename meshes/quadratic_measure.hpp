#pragma once
/// Nodal volumes exact for quadratics (quadratic_volumes.hpp) and boundary areas exact for cubics
/// (side_areas.hpp), on any mesh: what operators that sum by parts need where nodes are no lattice.
/// They agree about moments of cubics, where sides are curved by the least change of both
/// (moment_balance.hpp).
/// Source: notes 4.5. Test: tests/graphs/quadratic_measure_test.cpp

#include "meshes/dual_measure.hpp"

namespace diptych::meshes {

/// @pre    mesh.boundary_faces are filled and outward
/// @throws base::InputError where sides have too few nodes or are too coarse where they are curved,
///         and where a volume is not positive
DualMeasure quadratic_measure(const Mesh& mesh);

}  // namespace diptych::meshes
