#pragma once
/// Boundary nodes that lie on a boundary edge without being one of its ends.

#include "meshes/mesh.hpp"

namespace diptych::meshes {

/// Refuses hanging nodes, and parts that touch without shared nodes: both would come apart in a
/// computation, silently. Cracks that are meant (two nodes at one place) are refused with them.
/// O(boundary). Nodes inside a boundary face but off its edges are not looked for.
/// @throws base::InputError with the places of the node and the edge
void refuse_hanging_nodes(const Mesh& mesh);

}  // namespace diptych::meshes
