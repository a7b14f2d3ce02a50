#include "fvm/sbp_graph.hpp"

#include "common/closure/sbp_operator.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "meshes/block_measure.hpp"
#include "meshes/line_slopes.hpp"

#include <algorithm>
#include <array>
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

/// Begins of all rows, and room for their pairs.
void set_row_lengths(const meshes::StructuredBlock& block,
                     const std::vector<closure::SbpOperator>& along,
                     scheme::PairGraph& graph) {
  std::array<std::vector<std::int64_t>, 3> lengths;
  for (int d = 0; d < block.dimension; ++d) {
    for (int i = 0; i < block.n_nodes[d]; ++i)
      lengths[d].push_back(std::ssize(along[d].row(i)));
  }
  graph.row.assign(graph.X.size() + 1, 0);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    graph.row[a + 1] = graph.row[a];
    for (int d = 0; d < block.dimension; ++d)
      graph.row[a + 1] += lengths[d][block.place[a][d]];
  }
  graph.neighbour.resize(graph.row.back());
  graph.C = algebra::SharedVectors(std::vector<Vec3>(graph.neighbour.size()));
}

using Row = std::vector<std::pair<std::int32_t, Vec3>>;

/// Row a of the graph. @param row  scratch
void set_row(const meshes::BlockMeasure& measure,
             const std::vector<closure::SbpOperator>& along,
             std::int64_t a,
             Row& row,
             scheme::PairGraph& graph,
             std::vector<Vec3>& C) {
  const meshes::StructuredBlock& block = measure.block();
  row.clear();
  for (int d = 0; d < block.dimension; ++d) {
    const Vec3 M = measure.area(a, d);
    auto at = block.place[a];
    for (const closure::SbpOperator::Entry& entry : along[d].row(block.place[a][d])) {
      at[d] = entry.node;
      row.emplace_back(block.node_at(at), 2 * entry.Q * M);
    }
  }
  std::sort(row.begin(), row.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (size_t k = 0; k < row.size(); ++k) {
    graph.neighbour[graph.row[a] + k] = row[k].first;
    C[graph.row[a] + k] = row[k].second;
  }
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
  graph.Omega.resize(graph.X.size());
  graph.boundary_area.resize(graph.X.size());
  set_row_lengths(measure.block(), along, graph);
  std::vector<Vec3>& C = graph.C.each();
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    Row row;
    for (std::int64_t a = begin; a < end; ++a) {
      graph.Omega[a] = measure.volume(a);
      graph.boundary_area[a] = measure.boundary_area(a);
      set_row(measure, along, a, row, graph, C);
    }
  });
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    meshes::PatchArea patch = measure.patch(group);
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
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
  if (order == 2) return "fvm.order = 2";
  if (!meshes::is_undistorted_block(mesh)) return "";
  meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  const std::vector<closure::SbpOperator> along = operators_along(block, order);
  std::vector<std::vector<double>> H = weights_of(along, block);
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
