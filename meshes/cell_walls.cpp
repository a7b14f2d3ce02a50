#include "meshes/cell_walls.hpp"

#include "meshes/cell_topology.hpp"

#include <algorithm>

namespace diptych::meshes {

namespace {

/// Numbers the distinct keys in ascending order. @return the number of each key as they came
template <class Key>
std::vector<std::int64_t> numbered(const std::vector<Key>& keys, std::vector<Key>& distinct) {
  distinct = keys;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::int64_t> number;
  number.reserve(keys.size());
  for (const Key& key : keys)
    number.push_back(std::lower_bound(distinct.begin(), distinct.end(), key) - distinct.begin());
  return number;
}

/// Keys of the ridges of a face whose nodes go round it: its edges, in 2-D its nodes.
void add_ridges(const Mesh& mesh,
                std::span<const std::int32_t> nodes,
                std::vector<std::array<std::int32_t, 2>>& keys) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    const std::int32_t a = nodes[i], b = mesh.dimension == 3 ? nodes[(i + 1) % nodes.size()] : -1;
    keys.push_back({std::min(a, b), std::max(a, b)});
  }
}

void link_ridges(const Mesh& mesh,
                 const std::vector<std::vector<std::int32_t>>& wall_nodes,
                 CellWalls& walls) {
  std::vector<std::array<std::int32_t, 2>> keys, distinct;
  for (const auto& nodes : wall_nodes)
    add_ridges(mesh, nodes, keys);
  const std::vector<std::int64_t> ridge = numbered(keys, distinct);
  const size_t per_wall = mesh.dimension == 3 ? 4 : 2;
  walls.ridge_first.assign(distinct.size() + 1, 0);
  for (const std::int64_t r : ridge)
    ++walls.ridge_first[r + 1];
  for (size_t r = 0; r < distinct.size(); ++r)
    walls.ridge_first[r + 1] += walls.ridge_first[r];
  walls.ridge_walls.resize(ridge.size());
  std::vector<std::int64_t> next = walls.ridge_first;
  for (size_t w = 0; w < wall_nodes.size(); ++w) {
    walls.ridges.push_back({-1, -1, -1, -1});
    for (size_t i = 0; i < per_wall; ++i) {
      walls.ridges[w][i] = ridge[w * per_wall + i];
      walls.ridge_walls[next[ridge[w * per_wall + i]]++] = static_cast<std::int64_t>(w);
    }
  }
}

}  // namespace

FaceKey key_of(std::span<const std::int32_t> nodes) {
  FaceKey key{-1, -1, -1, -1};
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::int64_t CellWalls::between(std::int64_t c, std::int64_t d) const {
  for (int f = 0; f < per_cell; ++f) {
    const auto& of_wall = cells[of_cell[c * per_cell + f]];
    if ((of_wall[0] == c && of_wall[1] == d) || (of_wall[0] == d && of_wall[1] == c))
      return of_cell[c * per_cell + f];
  }
  return -1;
}

CellWalls cell_walls(const Mesh& mesh) {
  CellWalls walls;
  const auto faces = faces_of(mesh.cell_types[0]);
  walls.per_cell = static_cast<int>(faces.size());
  std::vector<FaceKey> keys;
  std::vector<std::vector<std::int32_t>> nodes;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    for (const LocalFace& face : faces) {
      nodes.emplace_back();
      for (int i = 0; i < face.n_nodes; ++i)
        nodes.back().push_back(mesh.cell(c)[face.nodes[i]]);
      keys.push_back(key_of(nodes.back()));
    }
  }
  walls.of_cell = numbered(keys, walls.key);
  walls.cells.assign(walls.key.size(), {-1, -1});
  std::vector<std::vector<std::int32_t>> wall_nodes(walls.key.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    auto& cells = walls.cells[walls.of_cell[i]];
    cells[cells[0] < 0 ? 0 : 1] = static_cast<std::int64_t>(i / faces.size());
    if (cells[1] < 0) wall_nodes[walls.of_cell[i]] = std::move(nodes[i]);
  }
  link_ridges(mesh, wall_nodes, walls);
  return walls;
}

std::map<FaceKey, std::vector<int>> groups_of_faces(const Mesh& mesh) {
  std::vector<std::vector<int>> groups(mesh.boundary_faces.size());
  for (size_t g = 0; g < mesh.boundary_groups.size(); ++g) {
    for (const std::int32_t f : mesh.boundary_groups[g].faces)
      groups[f].push_back(static_cast<int>(g));
  }
  std::map<FaceKey, std::vector<int>> of_face;
  for (size_t f = 0; f < groups.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    of_face[key_of({face.nodes.data(), static_cast<size_t>(face.n_nodes)})] = std::move(groups[f]);
  }
  return of_face;
}

}  // namespace diptych::meshes
