#pragma once
/// The lines of nodes of a mesh: which nodes stand side by side along the edges of hexahedra
/// (quadrilaterals), found from the connectivity alone, walking from cell to cell through their
/// faces. Numbering of nodes and cells does not matter. Test:
/// tests/graphs/structured_block_test.cpp

#include "meshes/mesh.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych::meshes {

using algebra::Mat3;

struct StructuredBlock {
  int dimension = 3;
  std::array<int, 3> n_nodes{1, 1, 1};  ///< along each direction; 1 along the third in 2-D
  std::vector<std::array<std::int32_t, 3>> place;  ///< [n_nodes of the mesh] counts along them
  std::vector<std::int32_t> node;                  ///< [product of n_nodes] first direction fastest

  std::int32_t node_at(const std::array<std::int32_t, 3>& at) const {
    return node[static_cast<size_t>(
        (static_cast<std::int64_t>(at[2]) * n_nodes[1] + at[1]) * n_nodes[0] + at[0])];
  }
};

/// Who asks for a block, for the messages where there is none.
struct BlockUse {
  std::string asked;    ///< key and value
  std::string instead;  ///< what to use
};

/// @throws base::InputError where a cell is of another type or the cells are not one block, with
///         the cell or node, its place and what to use instead
StructuredBlock structured_block(const Mesh& mesh, const BlockUse& use);

/// The edges of the cells of an undistorted block (all cells the same parallelepiped), as columns;
/// in 2-D the third is (0, 0, 1).
/// @throws base::InputError that names the node that is most off
Mat3 cell_edges(const Mesh& mesh, const StructuredBlock& block, const BlockUse& use);

/// Whether the mesh is one.
bool is_undistorted_block(const Mesh& mesh);

}  // namespace diptych::meshes
