#include "fvm/sbp_graph.hpp"

#include "common/closure/sbp_operator.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "meshes/block_measure.hpp"
#include "meshes/line_slopes.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::fvm {

namespace {

using algebra::Vec3;
using meshes::Mesh;

const meshes::BlockUse use{"fvm.stencil = \"sbp\"", "fvm.stencil = \"edge\" or \"integral\""};

/// The operator of every direction.
std::vector<closure::SbpOperator> operators_along(const meshes::StructuredBlock& block, int order) {
  std::vector<closure::SbpOperator> along;
  for (int d = 0; d < block.dimension; ++d)
    along.emplace_back(closure::widest_sbp_table(order, block.n_nodes[d]), block.n_nodes[d]);
  return along;
}

std::vector<std::vector<double>> weights_of(const std::vector<closure::SbpOperator>& along,
                                            const meshes::StructuredBlock& block) {
  std::vector<std::vector<double>> H;
  for (int d = 0; d < block.dimension; ++d) {
    H.emplace_back();
    for (int i = 0; i < block.n_nodes[d]; ++i)
      H.back().push_back(along[d].H(i));
  }
  return H;
}

/// Adds row a to the graph.
void add_row(const meshes::BlockMeasure& measure,
             const std::vector<closure::SbpOperator>& along,
             std::int64_t a,
             scheme::PairGraph& graph) {
  const meshes::StructuredBlock& block = measure.block();
  std::vector<std::pair<std::int32_t, Vec3>> row;
  for (int d = 0; d < block.dimension; ++d) {
    const Vec3 M = measure.area(a, d);
    auto at = block.place[a];
    for (const closure::SbpOperator::Entry& entry : along[d].row(block.place[a][d])) {
      at[d] = entry.node;
      row.emplace_back(block.node_at(at), 2 * entry.Q * M);
    }
  }
  std::sort(row.begin(), row.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (const auto& [b, C] : row) {
    graph.neighbour.push_back(b);
    graph.C.push_back(C);
  }
  graph.row.push_back(graph.n_pairs());
}

}  // namespace

scheme::PairGraph sbp_graph(const Mesh& mesh, int order) {
  meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  const std::vector<closure::SbpOperator> along = operators_along(block, order);
  std::vector<std::vector<double>> H = weights_of(along, block);
  const meshes::BlockMeasure measure(mesh, std::move(block), std::move(H), use);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.row.assign(1, 0);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    graph.Omega.push_back(measure.volume(a));
    graph.boundary_area.push_back(measure.boundary_area(a));
    add_row(measure, along, a, graph);
  }
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    meshes::PatchArea patch = measure.patch(group);
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area)});
  }
  link_reverse_pairs(graph);
  set_classes(graph);
  graph.commutes = true;
  meshes::LineSlopes slopes = meshes::line_slopes(
      measure.block(), measure.edges(), [&](auto a, auto b) { return area_between(graph, a, b); });
  graph.slopes = {std::move(slopes.row), std::move(slopes.neighbour), std::move(slopes.weight),
                  scheme::metric_of_lines(measure.edges())};
  validate(graph);
  return graph;
}

std::string unsure_because(const Mesh& mesh, int order) {
  if (!meshes::is_undistorted_block(mesh)) return "the mesh is no box";
  meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  const std::vector<closure::SbpOperator> along = operators_along(block, order);
  std::vector<std::vector<double>> H = weights_of(along, block);
  if (order == 2) return "fvm.order = 2";
  const int longest = *std::max_element(block.n_nodes.begin(), block.n_nodes.end());
  if (longest < 3) return fmt::format("lines of {} nodes", longest);
  return meshes::BlockMeasure(mesh, std::move(block), std::move(H), use).unfit_group();
}

std::vector<SbpLines> sbp_lines(const Mesh& mesh, int order) {
  const meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  const algebra::Mat3 edges = meshes::cell_edges(mesh, block, use);
  std::vector<SbpLines> lines;
  for (int d = 0; d < block.dimension; ++d) {
    const int n = block.n_nodes[d];
    const Vec3 direction = edges.col(d).normalized() + Vec3::Zero();  // no -0
    lines.push_back({direction, n, closure::widest_sbp_table(order, n).order});
  }
  return lines;
}

std::string lines_text(const std::vector<SbpLines>& lines) {
  std::string text = "sbp:";
  for (const SbpLines& line : lines) {
    const auto& e = line.direction;
    text +=
        fmt::format("{} order {} on {} nodes along ({:.3g}, {:.3g}, {:.3g})",
                    &line == lines.data() ? "" : ",", line.order, line.n_nodes, e[0], e[1], e[2]);
  }
  return text;
}

}  // namespace diptych::fvm
