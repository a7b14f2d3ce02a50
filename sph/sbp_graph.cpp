#include "sph/sbp_graph.hpp"

#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "meshes/block_measure.hpp"
#include "meshes/line_slopes.hpp"
#include "sph/lattice_operator.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::sph {

namespace {

using meshes::StructuredBlock;

const meshes::BlockUse use{"sph.gradient = \"sbp\"", "sph.gradient = \"corrected\""};

std::vector<std::vector<double>> weights_of(const StructuredBlock& block) {
  std::vector<std::vector<double>> H;
  for (int d = 0; d < block.dimension; ++d) {
    H.emplace_back();
    for (int i = 0; i < block.n_nodes[d]; ++i)
      H.back().push_back(lattice_weight(i, block.n_nodes[d]));
  }
  return H;
}

/// Adds row a to the graph.
void add_row(const meshes::BlockMeasure& measure,
             const LatticeOperator& lattice,
             std::int64_t a,
             scheme::PairGraph& graph) {
  const StructuredBlock& block = measure.block();
  std::vector<std::pair<std::int32_t, Vec3>> row;
  for (const LatticeOffset& offset : lattice.offsets()) {
    auto at = block.place[a];
    bool is_inside = true;
    for (int d = 0; d < block.dimension; ++d) {
      at[d] += offset[d];
      is_inside = is_inside && at[d] >= 0 && at[d] < block.n_nodes[d];
    }
    if (!is_inside) continue;
    const Vec3 C = lattice.C(block.place[a], offset);
    Vec3 in_space = Vec3::Zero();
    for (int d = 0; d < block.dimension; ++d)
      in_space += C[d] * measure.face(d);
    row.emplace_back(block.node_at(at), in_space);
  }
  std::sort(row.begin(), row.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (const auto& [b, C] : row) {
    graph.neighbour.push_back(b);
    graph.C.push_back(C);
  }
  graph.row.push_back(graph.n_pairs());
}

}  // namespace

scheme::PairGraph sbp_graph(const meshes::Mesh& mesh, const Kernel& kernel, double kappa) {
  StructuredBlock block = meshes::structured_block(mesh, use);
  std::vector<std::vector<double>> H = weights_of(block);
  const LatticeOperator lattice(kernel, kappa, block.n_nodes);
  const meshes::BlockMeasure measure(mesh, std::move(block), std::move(H), use);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.row.assign(1, 0);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    graph.Omega.push_back(measure.volume(a));
    graph.boundary_area.push_back(measure.boundary_area(a));
    add_row(measure, lattice, a, graph);
  }
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    meshes::PatchArea patch = measure.patch(group);
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
  link_reverse_pairs(graph);
  graph.dissipation_metric = scheme::metric_of_lines(measure.edges());
  meshes::LineSlopes slopes = meshes::line_slopes(
      measure.block(), measure.edges(), [&](auto a, auto b) { return area_between(graph, a, b); });
  graph.slopes = {std::move(slopes.row), std::move(slopes.neighbour), std::move(slopes.weight),
                  scheme::metric_of_lines(measure.edges())};
  set_classes(graph);
  validate(graph);
  return graph;
}

std::string unsure_because(const meshes::Mesh& mesh, const Kernel& kernel, double kappa) {
  if (!meshes::is_undistorted_block(mesh)) return "the nodes are no lattice";
  const double support = kernel.support * kappa;
  if (!(support > 2)) return "the support is two spacings or less";
  if (support > widest_sure_support) return "the support is more than four spacings";
  StructuredBlock block = meshes::structured_block(mesh, use);
  for (int d = 0; d < block.dimension; ++d) {
    if (block.n_nodes[d] < least_sure_nodes)
      return fmt::format("lines of {} nodes", block.n_nodes[d]);
  }
  std::vector<std::vector<double>> H = weights_of(block);
  return meshes::BlockMeasure(mesh, std::move(block), std::move(H), use).unfit_group();
}

std::string sbp_text(double kappa) {
  return fmt::format("sbp: order 4 inside, 2 within {} nodes of the boundary, kappa {:.4g}",
                     lattice_layers, kappa);
}

std::vector<std::string> sbp_notices(const meshes::Mesh& mesh) {
  constexpr int enough = 2 * lattice_layers;
  const StructuredBlock block = meshes::structured_block(mesh, use);
  const algebra::Mat3 edges = meshes::cell_edges(mesh, block, use);
  std::vector<std::string> notices;
  for (int d = 0; d < block.dimension; ++d) {
    if (block.n_nodes[d] >= enough) continue;
    const Vec3 e = edges.col(d).normalized() + Vec3::Zero();  // no -0
    notices.push_back(fmt::format(
        "sbp: {} nodes along ({:.3g}, {:.3g}, {:.3g}): with fewer than {} the sign of the "
        "numerical "
        "dissipation is not known, and a nearly incompressible body may come apart (notes 4.4)",
        block.n_nodes[d], e[0], e[1], e[2], enough));
  }
  return notices;
}

}  // namespace diptych::sph
