#pragma once
/// What the faces of a patch are to its nodes, where they are not all of one plane. The area of a
/// node as a vector, A_aN_a, is less than that of the faces around an edge between two sides, on
/// which a dead traction acts, and its direction is that of neither. Source: notes 3.6. Test:
/// tests/common/scheme/patch_faces_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych::scheme {

/// An edge of the plane, a triangle or a quadrilateral, by its corners one after the other.
struct PatchFace {
  int n_corners = 0;
  std::array<std::int32_t, 4> corner{};  ///< places among the nodes of the patch
};

/// Of a patch, by places among its nodes.
std::vector<PatchFace> faces_of(const BoundaryPatch& patch);

/// Areas of the nodes as numbers, int N_a dA. On a plane that is |A_aN_a|, to the last bit,
/// and on a smooth side of which A_aN_a is more than its facets. Where several meet at a node,
/// A_aN_a = sum_i A_i n_i with their normals n_i and the number is sum_i A_i; where the n_i leave
/// the A_i open it is |A_aN_a| sum_i |S_i| / |sum_i S_i| with the shares S_i of the node in the
/// faces of each side. Where A_aN_a is the sum of the shares S_f in faces, it is sum_f |S_f|.
/// @return [nodes of the patch] m^2 (m in the plane)
std::vector<double> areas_as_numbers(const PairGraph& graph, const BoundaryPatch& patch);

/// Unit normals of the planes around each node: one, that of A_aN_a, where no two faces turn by
/// meshes::edge_of_planes from each other; else as many as do so from all before, each the normal
/// of the faces that are nearest to it.
/// @return [nodes of the patch]
std::vector<std::vector<Vec3>> normals_of_planes(const PairGraph& graph,
                                                 const BoundaryPatch& patch);

}  // namespace diptych::scheme
