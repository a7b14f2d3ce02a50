#pragma once
/// Neighbours are those that a particle reaches through the body: the kernel knows of no gap, and
/// would tie what a slot narrower than its support keeps apart. Test: tests/graphs/gaps_test.cpp

#include "meshes/incidence.hpp"
#include "sph/neighbours.hpp"

namespace diptych::sph {

/// Drops pairs whose particles are not joined near each other: from each of the two a path over
/// nodes that share a cell, none of them much farther than its farthest neighbour, must reach the
/// other one. In a convex body whose cells are Delaunay it drops none, since there a path exists
/// that comes nearer with every node.
/// @param rows  of the nodes of the mesh; with (a,b) it has (b,a)
void drop_pairs_across_gaps(const meshes::Mesh& mesh, Rows& rows);

}  // namespace diptych::sph
