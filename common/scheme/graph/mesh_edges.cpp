#include "common/scheme/graph/mesh_edges.hpp"

#include "meshes/cell_topology.hpp"

#include <algorithm>

namespace diptych::scheme {

void set_edges(const meshes::Mesh& mesh, PairGraph& graph) {
  graph.edges.clear();
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    for (const meshes::LocalEdge& e : meshes::edges_of(mesh.cell_types[c])) {
      const std::int32_t a = corners[e[0]], b = corners[e[1]];
      graph.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  std::erase_if(graph.edges, [&](const std::array<std::int32_t, 2>& edge) {
    const auto begin = graph.neighbour.begin();
    return !std::binary_search(begin + graph.row[edge[0]], begin + graph.row[edge[0] + 1], edge[1]);
  });
}

}  // namespace diptych::scheme
