#pragma once
/// A mesh of the reference configuration: nodes, cells and named boundary faces. The same nodes
/// serve both methods.

#include "common/algebra/vectors.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych::meshes {

using algebra::Vec3;

/// Node order of every type is that of Gmsh. VTK's is the same but for the prism, which it counts
/// the other way round (benchmarks/run/case_mesh.cpp).
enum class CellType : std::uint8_t { triangle, quadrilateral, tetrahedron, hexahedron, prism };

/// Nodes of a cell of this type.
int n_nodes_of(CellType type);
/// Dimension of a cell of this type (2 or 3).
int dimension_of(CellType type);

/// A boundary face (3-D: 3 or 4 nodes; 2-D: an edge, 2 nodes), oriented outwards: right-hand rule
/// in 3-D; in 2-D the domain lies to the left when walking from nodes[0] to nodes[1].
struct BoundaryFace {
  int n_nodes = 0;
  std::array<std::int32_t, 4> nodes{};
};

/// A named part of the boundary (a Gmsh physical group, or a side of the box generator). Groups
/// may overlap; faces in no group are traction free.
struct BoundaryGroup {
  std::string name;
  std::vector<std::int32_t> faces;  ///< indices into Mesh::boundary_faces, ascending
};

struct Mesh {
  int dimension = 3;                         ///< 2 or 3
  std::vector<Vec3> nodes;                   ///< [n_nodes] m; z = 0 in 2-D
  std::vector<CellType> cell_types;          ///< [n_cells]
  std::vector<std::int64_t> cell_offsets;    ///< [n_cells + 1] into cell_nodes
  std::vector<std::int32_t> cell_nodes;      ///< node indices, cell after cell
  std::vector<BoundaryFace> boundary_faces;  ///< every face that belongs to one cell only
  std::vector<BoundaryGroup> boundary_groups;

  std::int64_t n_nodes() const { return static_cast<std::int64_t>(nodes.size()); }
  std::int64_t n_cells() const { return static_cast<std::int64_t>(cell_types.size()); }
  std::span<const std::int32_t> cell(std::int64_t c) const {
    return {cell_nodes.data() + cell_offsets[c],
            static_cast<size_t>(cell_offsets[c + 1] - cell_offsets[c])};
  }
  /// The group of this name.  @throws base::InputError naming the nearest group
  const BoundaryGroup& group(const std::string& name) const;
};

}  // namespace diptych::meshes
