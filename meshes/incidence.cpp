#include "meshes/incidence.hpp"

namespace diptych::meshes {

Incidence cells_around_nodes(const Mesh& mesh) {
  Incidence around;
  around.first.assign(static_cast<size_t>(mesh.n_nodes()) + 1, 0);
  for (std::int32_t a : mesh.cell_nodes)
    ++around.first[a + 1];
  for (size_t a = 1; a < around.first.size(); ++a)
    around.first[a] += around.first[a - 1];
  std::vector<std::int64_t> next(around.first.begin(), around.first.end() - 1);
  around.cell.resize(mesh.cell_nodes.size());
  around.place.resize(mesh.cell_nodes.size());
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell(c);
    for (size_t i = 0; i < nodes.size(); ++i) {
      const std::int64_t slot = next[nodes[i]]++;
      around.cell[slot] = c;
      around.place[slot] = static_cast<std::uint8_t>(i);
    }
  }
  return around;
}

}  // namespace diptych::meshes
