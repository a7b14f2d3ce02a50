#include "meshes/single_cells.hpp"

#include "meshes/cell_topology.hpp"
#include "meshes/cell_walls.hpp"

#include <algorithm>
#include <array>

namespace diptych::meshes {

namespace {

bool share_a_node(const LocalFace& one, const LocalFace& other) {
  return std::any_of(one.nodes.begin(), one.nodes.begin() + one.n_nodes, [&](int a) {
    return std::find(other.nodes.begin(), other.nodes.begin() + other.n_nodes, a) !=
           other.nodes.begin() + other.n_nodes;
  });
}

}  // namespace

std::int64_t n_single_cells(const Mesh& mesh, const std::vector<char>& is_held) {
  std::vector<FaceKey> free;
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    if (is_held[f] == 0)
      free.push_back(key_of({face.nodes.data(), static_cast<size_t>(face.n_nodes)}));
  }
  std::sort(free.begin(), free.end());
  const auto is_free = [&](std::int64_t c, const LocalFace& face) {
    const auto corners = mesh.cell(c);
    std::array<std::int32_t, 4> nodes{};
    for (int i = 0; i < face.n_nodes; ++i)
      nodes[i] = corners[face.nodes[i]];
    return std::binary_search(free.begin(), free.end(),
                              key_of({nodes.data(), static_cast<size_t>(face.n_nodes)}));
  };
  std::int64_t n = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const CellType type = mesh.cell_types[c];
    if (type != CellType::hexahedron && type != CellType::quadrilateral) continue;
    const auto faces = faces_of(type);
    bool is_single = false;
    for (size_t i = 0; i < faces.size(); ++i) {
      if (!is_free(c, faces[i])) continue;
      for (size_t j = i + 1; j < faces.size(); ++j)
        is_single = is_single || (!share_a_node(faces[i], faces[j]) && is_free(c, faces[j]));
    }
    n += is_single ? 1 : 0;
  }
  return n;
}

}  // namespace diptych::meshes
