#include "meshes/parts.hpp"

#include "meshes/cell_topology.hpp"
#include "meshes/cell_walls.hpp"
#include "meshes/joined.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace diptych::meshes {

namespace {

std::int64_t n_sets(Joined& joined, std::int64_t n) {
  std::int64_t n_sets = 0;
  for (std::int32_t a = 0; a < n; ++a)
    n_sets += joined.of(a) == a ? 1 : 0;
  return n_sets;
}

}  // namespace

std::int64_t n_parts(const Mesh& mesh) {
  Joined nodes(mesh.n_nodes());
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    for (const std::int32_t a : corners)
      nodes.join(corners[0], a);
  }
  return n_sets(nodes, mesh.n_nodes());
}

std::int64_t n_parts_by_faces(const Mesh& mesh) {
  std::vector<std::pair<FaceKey, std::int32_t>> faces;
  for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    for (const LocalFace& face : faces_of(mesh.cell_types[c])) {
      std::array<std::int32_t, 4> nodes{};
      for (int i = 0; i < face.n_nodes; ++i)
        nodes[i] = corners[face.nodes[i]];
      faces.emplace_back(key_of({nodes.data(), static_cast<size_t>(face.n_nodes)}), c);
    }
  }
  std::sort(faces.begin(), faces.end());
  Joined cells(mesh.n_cells());
  for (size_t f = 1; f < faces.size(); ++f) {
    if (faces[f].first == faces[f - 1].first) cells.join(faces[f - 1].second, faces[f].second);
  }
  return n_sets(cells, mesh.n_cells());
}

}  // namespace diptych::meshes
