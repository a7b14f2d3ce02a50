#include "fvm/sbp_cells_graph.hpp"

#include "common/closure/summation_by_parts.hpp"
#include "common/scheme/graph/equal_widths.hpp"
#include "common/scheme/graph/mesh_edges.hpp"
#include "fvm/cell_stencil.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/quadratic_measure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych::fvm {

namespace {

/// Rings of neighbours by which rows reach further where two or three do not do.
constexpr int most_rings_more = 2;
/// Neighbours below which a row reaches a ring further, by dimension: a row has 5 or 9 conditions,
/// but neighbours of corners may lie in few planes.
constexpr std::int64_t enough[] = {12, 24};
constexpr double width = 1.2;  ///< of the weight, in mean spacings

struct Rows {
  std::vector<std::int64_t> row{0};
  std::vector<std::int32_t> neighbour;
};

/// Nodes that so many rings of neighbours around node a reach, without itself.
std::vector<std::int32_t> reached(const scheme::PairGraph& edges, std::int32_t a, int n_rings) {
  std::vector<std::int32_t> nodes{a};
  for (int ring = 0; ring < n_rings; ++ring) {
    const size_t n = nodes.size();
    for (size_t i = 0; i < n; ++i) {
      const std::int32_t b = nodes[i];
      nodes.insert(nodes.end(), edges.neighbour.begin() + edges.row[b],
                   edges.neighbour.begin() + edges.row[b + 1]);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  std::erase(nodes, a);
  return nodes;
}

/// How many rings of neighbours each row reaches: two, and a third where they are few.
std::vector<int> rings_of(const scheme::PairGraph& edges) {
  std::vector<int> rings(edges.X.size(), 2);
  for (std::int32_t a = 0; a < edges.n_nodes(); ++a) {
    if (static_cast<std::int64_t>(reached(edges, a, 2).size()) < enough[edges.dimension - 2])
      rings[a] = 3;
  }
  return rings;
}

/// Symmetric: a row that reaches a ring further joins the rows of whom it reaches.
Rows wide_rows(const scheme::PairGraph& edges, const std::vector<int>& rings) {
  std::vector<std::vector<std::int32_t>> all(edges.X.size());
  for (std::int32_t a = 0; a < edges.n_nodes(); ++a) {
    for (const std::int32_t b : reached(edges, a, rings[a])) {
      all[a].push_back(b);
      all[b].push_back(a);
    }
  }
  Rows rows;
  for (auto& nodes : all) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    rows.neighbour.insert(rows.neighbour.end(), nodes.begin(), nodes.end());
    rows.row.push_back(static_cast<std::int64_t>(rows.neighbour.size()));
  }
  return rows;
}

/// Spacings are those that nodes of the boundary would have inside. [n_pairs]
std::vector<double> weights_of(const meshes::Mesh& mesh, const scheme::PairGraph& graph) {
  std::vector<double> k(graph.neighbour.size());
  std::vector<double> spacing = meshes::filled_angle(mesh);
  const meshes::DualMeasure measure = meshes::dual_measure(mesh, meshes::Quadrature::exact);
  for (size_t a = 0; a < spacing.size(); ++a)
    spacing[a] = std::pow(measure.Omega[a] / spacing[a], 1.0 / graph.dimension);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const double h = 0.5 * (spacing[a] + spacing[b]);
      const double q = (graph.X[b] - graph.X[a]).norm() / (width * h);
      k[p] = graph.Omega[a] * graph.Omega[b] * std::exp(-q * q) / h;
    }
  }
  return k;
}

scheme::PairGraph graph_by_distances(const meshes::Mesh& mesh) {
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
  graph.Omega = std::move(measure.Omega);
  graph.boundary_area = std::move(measure.boundary_area);
  for (meshes::PatchArea& patch : measure.patches) {
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
  find_pairs(mesh, meshes::Quadrature::vertex, graph);
  std::vector<int> rings = rings_of(graph);
  scheme::PairGraph summing = closure::summing_by_parts(
      meshes::dual_measure(mesh, meshes::Quadrature::vertex).Omega, most_rings_more,
      [&] {
        scheme::PairGraph wide = graph;
        Rows rows = wide_rows(graph, rings);
        wide.row = std::move(rows.row);
        wide.neighbour = std::move(rows.neighbour);
        link_reverse_pairs(wide);
        add_cells(mesh, meshes::Quadrature::vertex, wide);
        std::vector<double> k = weights_of(mesh, wide);
        return closure::WeightedGraph{std::move(wide), std::move(k)};
      },
      [&](const auto& rows, const scheme::PairGraph&) {
        for (const std::int32_t a : rows)
          ++rings[a];
      });
  scheme::set_edges(mesh, summing);
  validate(summing);
  return summing;
}

}  // namespace

scheme::PairGraph sbp_graph_of_cells(const meshes::Mesh& mesh) {
  return scheme::on_equal_widths(mesh, graph_by_distances);
}

}  // namespace diptych::fvm
