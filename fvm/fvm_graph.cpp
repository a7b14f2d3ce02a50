#include "fvm/fvm_graph.hpp"

#include "common/base/registry.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/closure/sbp_operator.hpp"
#include "common/closure/summation_by_parts.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "fvm/cell_stencil.hpp"
#include "fvm/sbp_blocks_graph.hpp"
#include "fvm/sbp_cells_graph.hpp"
#include "fvm/sbp_graph.hpp"
#include "meshes/cell_shares.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/structured_block.hpp"

#include <fmt/format.h>

namespace diptych::fvm {

namespace {

enum class Stencil { automatic, edge, integral, sbp };

const base::Registry<Stencil>& stencils() {
  static const auto menu = base::Registry<Stencil>("stencil of fvm")
                               .add("auto", Stencil::automatic)
                               .add("edge", Stencil::edge)
                               .add("integral", Stencil::integral)
                               .add("sbp", Stencil::sbp);
  return menu;
}

scheme::PairGraph graph_of_cells(const meshes::Mesh& mesh, meshes::Quadrature quadrature) {
  meshes::DualMeasure measure = meshes::dual_measure(mesh, quadrature);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.Omega = std::move(measure.Omega);
  graph.boundary_area = std::move(measure.boundary_area);
  for (meshes::PatchArea& patch : measure.patches) {
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
  find_pairs(mesh, quadrature, graph);
  link_reverse_pairs(graph);
  const std::vector<double> volume = add_cells(mesh, quadrature, graph);
  // The vertex volumes are scaled to the exact total (dual_measure.hpp); so is each row.
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const double factor = graph.Omega[a] / volume[a];
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
      graph.C[p] *= factor;
  }
  if (quadrature == meshes::Quadrature::vertex) {
    std::vector<double> k(graph.C.size());
    for (size_t p = 0; p < k.size(); ++p) {
      k[p] = 0.5 * (graph.C[p].norm() + graph.C[graph.reverse[p]].norm());
    }
    closure::repair_closure_pairs(graph, k);
  }
  set_classes(graph);
  graph.commutes = quadrature == meshes::Quadrature::vertex && meshes::is_undistorted_block(mesh);
  if (meshes::areas_are_of_cells(mesh, quadrature)) {
    auto cells = meshes::cell_shares(mesh, quadrature);
    graph.cells = {std::move(cells.row), std::move(cells.corner), std::move(cells.share)};
  }
  validate(graph);
  return graph;
}

/// What stencil = "auto" comes to on a mesh.
struct Choice {
  Stencil stencil = Stencil::edge;
  std::string text;  ///< why it is not sbp, where it was to choose
};

Choice choice_of(const meshes::Mesh& mesh, const Options& options) {
  const Stencil asked = stencils().at(options.stencil);
  if (asked != Stencil::automatic) return {asked, ""};
  const std::string because = unsure_because(mesh, options.order);
  if (because.empty()) return {Stencil::sbp, ""};
  return {Stencil::edge, fmt::format("edge stencil: {}", because)};
}

}  // namespace

const std::vector<std::string>& stencil_names() {
  return stencils().names();
}

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options) {
  const Stencil stencil = choice_of(mesh, options).stencil;
  if (stencil == Stencil::sbp) {
    if (meshes::is_undistorted_block(mesh)) return sbp_graph(mesh, options.order);
    const std::vector<meshes::LatticeBlock> blocks = smooth_blocks(mesh);
    return blocks.empty() ? sbp_graph_of_cells(mesh)
                          : sbp_blocks_graph(mesh, blocks, options.order);
  }
  return graph_of_cells(
      mesh, stencil == Stencil::edge ? meshes::Quadrature::vertex : meshes::Quadrature::exact);
}

Operators operators_of(const meshes::Mesh& mesh, const Options& options) {
  const Choice choice = choice_of(mesh, options);
  if (choice.stencil != Stencil::sbp)
    return {choice.text, {}, !choice.text.empty() && !meshes::is_undistorted_block(mesh)};
  if (!meshes::is_undistorted_block(mesh)) {
    const std::vector<meshes::LatticeBlock> blocks = smooth_blocks(mesh);
    if (!blocks.empty())
      return {blocks_text(blocks, options.order), blocks_notices(blocks, options.order), false};
    return {fmt::format("sbp: order 2 on the cells around {} nodes", mesh.n_nodes()),
            {closure::sign_notice},
            false};
  }
  const std::vector<SbpLines> lines = sbp_lines(mesh, options.order);
  Operators operators{lines_text(lines), {}, false};
  for (const SbpLines& line : lines) {
    if (line.order == options.order) continue;
    operators.lost.push_back(fmt::format(
        "order {} instead of {} along ({:.3g}, {:.3g}, {:.3g}): its lines have {} nodes, order {} "
        "takes {}",
        line.order, options.order, line.direction[0], line.direction[1], line.direction[2],
        line.n_nodes, options.order, closure::sbp_table(options.order).least_nodes()));
  }
  return operators;
}

}  // namespace diptych::fvm
