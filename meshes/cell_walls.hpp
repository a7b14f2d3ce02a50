#pragma once
/// Walls between the cells of a mesh of hexahedra (quadrilaterals) and what walls share: a wall is
/// a face (in 2-D an edge), a ridge an edge (in 2-D a node). Blocks of cells are cut along walls,
/// and cuts go on across ridges (lattice_blocks.hpp). Test: tests/graphs/lattice_blocks_test.cpp

#include "meshes/mesh.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace diptych::meshes {

/// Nodes of a face in ascending order; -1 before them where there are fewer than four.
using FaceKey = std::array<std::int32_t, 4>;
FaceKey key_of(std::span<const std::int32_t> nodes);

struct CellWalls {
  int per_cell = 6;                                ///< 4 in 2-D
  std::vector<std::int64_t> of_cell;               ///< [n_cells * per_cell] as faces_of counts them
  std::vector<std::array<std::int64_t, 2>> cells;  ///< [n_walls]; second -1: on the boundary
  std::vector<FaceKey> key;                        ///< [n_walls] ascending
  std::vector<std::array<std::int64_t, 4>> ridges;  ///< [n_walls]; in 2-D two, then -1
  std::vector<std::int64_t> ridge_first;            ///< [n_ridges + 1] into ridge_walls
  std::vector<std::int64_t> ridge_walls;            ///< walls around each ridge

  std::int64_t n_walls() const { return static_cast<std::int64_t>(cells.size()); }
  bool is_inner(std::int64_t wall) const { return cells[wall][1] >= 0; }
  std::span<const std::int64_t> around(std::int64_t ridge) const {
    return {ridge_walls.data() + ridge_first[ridge],
            static_cast<size_t>(ridge_first[ridge + 1] - ridge_first[ridge])};
  }
  /// The wall between two cells; -1: none.
  std::int64_t between(std::int64_t c, std::int64_t d) const;
};

/// @pre all cells are of one type, hexahedra or quadrilaterals; no face has more than two
CellWalls cell_walls(const Mesh& mesh);

/// The groups of every boundary face, by the nodes of the face: indices into boundary_groups,
/// ascending; a face that is not there is no boundary face.
std::map<FaceKey, std::vector<int>> groups_of_faces(const Mesh& mesh);

}  // namespace diptych::meshes
