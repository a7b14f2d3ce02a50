#pragma once
/// Neighbours are those that a particle reaches through the body: the kernel knows of no gap, and
/// would tie what a slot narrower than its support keeps apart. Test: tests/graphs/gaps_test.cpp

#include "meshes/incidence.hpp"
#include "sph/neighbours.hpp"

namespace diptych::sph {

/// Drops pairs whose particles are not joined near each other: whose shortest path over nodes that
/// share a cell is more than twice as long as the straight line between them.
/// @param rows  of the nodes of the mesh; with (a,b) it has (b,a)
void drop_pairs_across_gaps(const meshes::Mesh& mesh, Rows& rows);

}  // namespace diptych::sph
