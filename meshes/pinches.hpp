#pragma once
/// Where cells hang together by less than a face: a surface that touches itself at a node or an
/// edge, as that of a hole which reaches the outside there, or of parts that are joined like
/// hinges. Test: tests/meshes/pinches_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

/// Nodes around which the faces of the boundary are more than one sheet, or of an edge on which
/// more than two of them stand (in 2-D: nodes with more than two edges of the boundary), ascending.
/// @pre mesh.boundary_faces are filled
std::vector<std::int32_t> pinched_nodes(const Mesh& mesh);

}  // namespace diptych::meshes
