#include "meshes/incidence.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>

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

NodalGraph nodal_graph(const Mesh& mesh) {
  const Incidence cells = cells_around_nodes(mesh);
  std::vector<std::vector<std::int32_t>> all(static_cast<size_t>(mesh.n_nodes()));
  parallel::for_chunks(mesh.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (auto a = static_cast<std::int32_t>(begin); a < end; ++a) {
      std::vector<std::int32_t>& nodes = all[a];
      for (const std::int64_t c : cells.cells(a)) {
        const auto corners = mesh.cell(c);
        nodes.insert(nodes.end(), corners.begin(), corners.end());
      }
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  });
  NodalGraph graph;
  graph.first.push_back(0);
  for (const std::vector<std::int32_t>& nodes : all) {
    graph.node.insert(graph.node.end(), nodes.begin(), nodes.end());
    graph.first.push_back(static_cast<std::int64_t>(graph.node.size()));
  }
  return graph;
}

}  // namespace diptych::meshes
