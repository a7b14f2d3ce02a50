#pragma once
/// Graphs of bodies whose cells are long or flat. Conditions on rows, closure and adjoint are the
/// same of nodes X and of nodes B X with C_ab, A_aN_a -> cof B C_ab, cof B A_aN_a, while supports
/// and weights by distance suit nodes that stand as densely along all directions. So the graph is
/// made of the mesh that is stretched until its cells are as long as wide, and stretched back
/// (notes 4.5). Test: tests/graphs/equal_widths_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <functional>

namespace diptych::scheme {

/// Whether cells are 1.1 times as long as wide or more in the mean over the body.
bool has_long_cells(const meshes::Mesh& mesh);
/// The same of a mesh that is not all equal parallelepipeds.
bool has_long_cells_off_boxes(const meshes::Mesh& mesh);

/// Makes the graph of a mesh.
using GraphFactory = std::function<PairGraph(const meshes::Mesh&)>;

/// By `make`, of the mesh as it is where its cells are not long. Where `make` refuses the stretched
/// mesh, it is asked for the one as it is, so that what it says names places that are there.
/// @throws base::InputError that `make` throws for the mesh
PairGraph on_equal_widths(const meshes::Mesh& mesh, const GraphFactory& make);

}  // namespace diptych::scheme
