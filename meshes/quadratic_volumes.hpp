#pragma once
/// Nodal volumes that integrate quadratics: the volume of every cell goes to its corners as
/// int N_a dV, then changes least, over these and the nodes around them, such that for all
/// quadratics q
///   sum_a w_a q(X_a) = int_cell q dV.
/// A cell reaches to the surface, beyond or short of its facets. Test:
/// tests/graphs/quadratic_measure_test.cpp

#include "meshes/mesh.hpp"
#include "meshes/surface.hpp"

#include <vector>

namespace diptych::meshes {

/// @param shares  [n_nodes] of the vertex rule: a change counts beside what a node has by it
/// @param surface nullptr: cells end at their facets
/// @return [n_nodes] m^3 (m^2 in 2-D), of any sign
std::vector<double> quadratic_volumes(const Mesh& mesh,
                                      const std::vector<double>& shares,
                                      const Surface* surface);

}  // namespace diptych::meshes
