#pragma once
/// Steps of the assembly of a mesh from a .msh file: node numbers, cells, boundary groups.

#include "meshes/msh/contents.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes::msh {

/// Node tags of the file to node indices of the mesh: ascending, nodes that no cell uses left out.
class NodeNumbers {
 public:
  /// @pre contents.node_tags ascending and without repetition
  /// @throws base::InputError on a cell with a node that the file lacks
  NodeNumbers(const Contents& contents, int cell_dimension, const Source& source);

  /// Index of a tag, -1 where no cell uses the node, -2 where the file lacks it.
  std::int32_t index_of(std::int64_t tag) const;
  std::vector<Vec3> nodes() const;

 private:
  std::int64_t position_of(std::int64_t tag) const;  ///< in the file, -1 where absent

  const Contents& contents_;
  std::vector<std::int32_t> index_;  // [nodes of the file] -1 where no cell uses the node
  std::int64_t n_used_ = 0;
};

/// Cell by cell, the element it was in the file.
struct Cells {
  std::vector<std::int64_t> tags;
  std::vector<std::int64_t> places;
};

/// Fills the cells of the mesh; a cell that stands once per physical group (version 2.2) is taken
/// once.
/// @throws base::InputError on a cell that stands twice for no such reason
Cells take_cells(const Source& source,
                 const Contents& contents,
                 const NodeNumbers& numbers,
                 Mesh& mesh);

/// Physical groups of the boundary's dimension become boundary groups, ordered by tag and named by
/// their tag where they have no name.
/// @throws base::InputError on faces inside the mesh or of no cell, empty groups, equal names
void take_groups(const Source& source,
                 const Contents& contents,
                 const NodeNumbers& numbers,
                 Mesh& mesh);

/// Physical tags of the elements of a block, in either version.
const std::vector<int>& physical_tags_of(const Contents& contents, const ElementBlock& block);

}  // namespace diptych::meshes::msh
