#pragma once
/// Blocks of hexahedra (quadrilaterals) that a mesh falls into: lattices of nodes with straight
/// rows of cells along every direction, found from the connectivity. Walls between cells are cut
/// around every inner edge (2-D: node) where other than four cells meet, around every edge of the
/// boundary with more than two, and where a boundary group ends; a cut goes on straight across
/// edges with four cells, to the boundary or back to where it began. What is left connected is a
/// block, and may close on itself along a direction (a ring). Then lines that have a kink between
/// two cells, where the map of the lattice is not smooth, are cut there. Neither depends on the
/// numbering. Source: notes 4.6. Test: tests/graphs/lattice_blocks_test.cpp

#include "meshes/mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych::meshes {

struct LatticeBlock {
  int dimension = 3;
  std::array<int, 3> n_cells{1, 1, 1};  ///< along each direction
  std::array<int, 3> n_nodes{1, 1, 1};  ///< one more, the same where it is closed; 1 along the
                                        ///< third in 2-D
  std::array<bool, 3> is_closed{};      ///< lines of the direction are rings
  std::vector<std::int64_t> cell;       ///< [product of n_cells] first direction fastest
  std::vector<std::int32_t> node;       ///< [product of n_nodes] the same; a node may stand twice

  std::int64_t n_places() const { return static_cast<std::int64_t>(node.size()); }
  std::array<int, 3> place(std::int64_t p) const {
    const std::int64_t i = p % n_nodes[0], jk = p / n_nodes[0];
    return {static_cast<int>(i), static_cast<int>(jk % n_nodes[1]),
            static_cast<int>(jk / n_nodes[1])};
  }
  /// Of a place; those past the end of a closed direction come round.
  std::int64_t index(std::array<int, 3> at) const {
    for (int d = 0; d < 3; ++d)
      if (is_closed[d]) at[d] = (at[d] % n_nodes[d] + n_nodes[d]) % n_nodes[d];
    return (static_cast<std::int64_t>(at[2]) * n_nodes[1] + at[1]) * n_nodes[0] + at[0];
  }
  std::int64_t cell_at(const std::array<int, 3>& at) const {
    return cell[static_cast<size_t>(
        (static_cast<std::int64_t>(at[2]) * n_cells[1] + at[1]) * n_cells[0] + at[0])];
  }
};

/// @return empty where the mesh has other cells, or cells that no such cuts make into blocks (a
///         ring that is turned before it closes, or is closed by two cells)
std::vector<LatticeBlock> lattice_blocks(const Mesh& mesh);

/// Whether the maps of blocks are smooth enough for wide differences: over all lines, fourth
/// differences of the places of nodes are less than twice the second ones in root mean square (on
/// nodes moved at random they are 3.4 times as large, on a circle of n cells (2 sin pi/n)^2), or
/// less than a thousandth of a spacing; and at least half of the cells are in blocks with three
/// nodes or more on every line but those of one direction (a sheet of one cell is thick enough; the
/// patches of a paved mesh are not).
bool is_smooth(const Mesh& mesh, const std::vector<LatticeBlock>& blocks);

}  // namespace diptych::meshes
