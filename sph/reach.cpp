#include "sph/reach.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/joined.hpp"

#include <fmt/format.h>

namespace diptych::sph {

namespace {

/// Of the mean radius. Edges of a lattice at kappa 1.2 are 0.42 of it, diagonals of its cubes,
/// which are edges of tetrahedra, 0.73.
constexpr double far_in_others = 0.7, far_in_simplices = 0.9;

}  // namespace

void require_joined(const meshes::Mesh& mesh, const scheme::PairGraph& graph) {
  meshes::Joined joined(mesh.n_nodes());
  for (std::int32_t a = 0; a < mesh.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
      joined.join(a, graph.neighbour[p]);
  }
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    for (const std::int32_t a : corners) {
      if (joined.of(a) == joined.of(corners[0])) continue;
      const algebra::Vec3 &X = mesh.nodes[corners[0]], &Y = mesh.nodes[a];
      throw base::InputError(fmt::format(
          "supports of particles do not reach from layer to layer of these cells, which are long "
          "in "
          "directions that turn over the body: the nodes at ({:.4g}, {:.4g}, {:.4g}) and ({:.4g}, "
          "{:.4g}, {:.4g}) m of one cell are joined by no pairs. Make cells about as wide as long, "
          "or raise sph.kappa",
          X[0], X[1], X[2], Y[0], Y[1], Y[2]));
    }
  }
}

double share_of_far_edges(const meshes::Mesh& mesh, const std::vector<double>& radius) {
  std::int64_t n = 0, n_far = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto corners = mesh.cell(c);
    const double far = meshes::is_simplex(mesh.cell_types[c]) ? far_in_simplices : far_in_others;
    for (const meshes::LocalEdge& e : meshes::edges_of(mesh.cell_types[c])) {
      const std::int32_t a = corners[e[0]], b = corners[e[1]];
      const double reach = 0.5 * (radius[a] + radius[b]);
      ++n;
      n_far += (mesh.nodes[b] - mesh.nodes[a]).norm() > far * reach ? 1 : 0;
    }
  }
  return static_cast<double>(n_far) / static_cast<double>(n);
}

}  // namespace diptych::sph
