#pragma once
/// Boxes of which cells are missing.

#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"

#include <set>

namespace diptych::meshes {

/// Without these cells; of 3 cells a side, the box has a volume (area) of one.
inline Mesh box_without(CellType type, const std::set<std::int64_t>& missing) {
  const bool is_flat = type == CellType::quadrilateral || type == CellType::triangle;
  const Mesh whole = box(type, {0, 0, 0}, {1, 1, is_flat ? 0.0 : 1.0}, {3, 3, 3});
  Mesh mesh;
  mesh.dimension = whole.dimension;
  mesh.nodes = whole.nodes;
  mesh.cell_offsets = {0};
  for (std::int64_t c = 0; c < whole.n_cells(); ++c) {
    if (missing.contains(c)) continue;
    const auto nodes = whole.cell(c);
    mesh.cell_types.push_back(type);
    mesh.cell_nodes.insert(mesh.cell_nodes.end(), nodes.begin(), nodes.end());
    mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
  }
  find_boundary_faces(mesh);
  return mesh;
}

}  // namespace diptych::meshes
