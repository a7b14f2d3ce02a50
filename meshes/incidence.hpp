#pragma once
/// Cells around the nodes of a mesh, and the nodes that share a cell.

#include "meshes/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::meshes {

/// Those of node a are cell[first[a]] to cell[first[a + 1] - 1], ascending, and place says which of
/// their nodes a is.
struct Incidence {
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> cell;
  std::vector<std::uint8_t> place;

  std::span<const std::int64_t> cells(std::int32_t a) const {
    return {cell.data() + first[a], static_cast<size_t>(first[a + 1] - first[a])};
  }
};

Incidence cells_around_nodes(const Mesh& mesh);

/// Of node a, the nodes that share a cell with it, itself among them: node[first[a]] to
/// node[first[a + 1] - 1], ascending.
struct NodalGraph {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> node;

  std::span<const std::int32_t> around(std::int32_t a) const {
    return {node.data() + first[a], static_cast<size_t>(first[a + 1] - first[a])};
  }
};

NodalGraph nodal_graph(const Mesh& mesh);

}  // namespace diptych::meshes
