#pragma once
/// Whether supports reach as far as cells do. They are round on the mesh whose cells are as wide as
/// long in the mean over the body (common/scheme/graph/equal_widths.hpp); around a ring, say, that
/// mean tells nothing, and long cells have nodes beyond what their volume makes a support of.
/// Test: tests/graphs/reach_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

namespace diptych::sph {

/// @throws base::InputError where nodes of a cell are joined by no pairs, however many there are
/// between: layers would move by themselves
void require_joined(const meshes::Mesh& mesh, const scheme::PairGraph& graph);

/// Share of the edges of cells that only the tail of the kernel spans: longer than 0.7 of the mean
/// radius of their nodes, of simplices 0.9.
/// @param radius  [n_nodes] m
double share_of_far_edges(const meshes::Mesh& mesh, const std::vector<double>& radius);

}  // namespace diptych::sph
