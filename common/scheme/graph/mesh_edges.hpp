#pragma once
/// Edges of a mesh that are pairs of a graph. Test: tests/common/scheme/hourglass_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

namespace diptych::scheme {

/// Sets graph.edges: ascending, each once. @pre rows are ascending
void set_edges(const meshes::Mesh& mesh, PairGraph& graph);

}  // namespace diptych::scheme
