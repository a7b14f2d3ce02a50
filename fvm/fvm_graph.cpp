#include "fvm/fvm_graph.hpp"

#include "common/base/error.hpp"
#include "common/base/registry.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/closure/sbp_operator.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/equal_widths.hpp"
#include "fvm/cell_stencil.hpp"
#include "fvm/sbp_blocks_graph.hpp"
#include "fvm/sbp_cells_graph.hpp"
#include "fvm/sbp_graph.hpp"
#include "meshes/cell_shares.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/structured_block.hpp"

#include <algorithm>
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
  std::vector<algebra::Vec3>& C = graph.C.each();
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const double factor = graph.Omega[a] / volume[a];
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
      C[p] *= factor;
  }
  if (quadrature == meshes::Quadrature::vertex) {
    std::vector<double> k(graph.C.size());
    for (size_t p = 0; p < k.size(); ++p) {
      k[p] = 0.5 * (graph.C[p].norm() + graph.C[graph.reverse(p)].norm());
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

/// Along the lines of a box.
scheme::Operators sbp_on_box(const meshes::Mesh& mesh, int order) {
  const std::vector<SbpLines> lines = sbp_lines(mesh, order);
  scheme::Operators operators{sbp_graph(mesh, order), lines_text(lines), {}};
  for (const SbpLines& line : lines) {
    if (line.order == order) continue;
    operators.notices.push_back(fmt::format(
        "order {} instead of {} along ({:.3g}, {:.3g}, {:.3g}): its lines have {} nodes, order {} "
        "takes {}",
        line.order, order, line.direction[0], line.direction[1], line.direction[2], line.n_nodes,
        order, closure::sbp_table(order).least_nodes()));
  }
  return operators;
}

/// On any nodes.
scheme::Operators sbp_on_cells(const meshes::Mesh& mesh) {
  return {sbp_graph_of_cells(mesh),
          fmt::format("sbp: order 2 on the cells around {} nodes", mesh.n_nodes()),
          {},
          true};
}

/// Lines of three nodes along several directions are none to derive along.
/// @param blocks  of the mesh, smooth; empty where it is none
scheme::Operators sbp_off_boxes(const meshes::Mesh& mesh,
                                const std::vector<meshes::LatticeBlock>& blocks,
                                const Options& options) {
  if (!blocks.empty() && !is_too_small(blocks)) {
    std::vector<std::string> notices = blocks_notices(blocks, options.order);
    if (!options.jumps_are_symmetric && gives_energy(blocks, options.order)) {
      notices.emplace_back(
          "lines of six nodes: D_ab gives energy to some motions unless scheme.reconstruction = "
          "\"symmetric\" or scheme.limiter = \"sign-preserving\"; five or seven nodes are safer "
          "(notes 4.6)");
    }
    return {sbp_blocks_graph(mesh, blocks, options.order), blocks_text(blocks, options.order),
            std::move(notices), true};
  }
  return sbp_on_cells(mesh);
}

/// Edges of other cells than simplices bend too stiffly themselves.
scheme::Operators edge_on(const meshes::Mesh& mesh,
                          std::string text,
                          std::vector<std::string> notices = {}) {
  scheme::Operators operators{graph_of_cells(mesh, meshes::Quadrature::vertex), std::move(text),
                              std::move(notices)};
  operators.errs_less_with_cells =
      std::all_of(mesh.cell_types.begin(), mesh.cell_types.end(), meshes::is_simplex);
  return operators;
}

scheme::Operators integral_on(const meshes::Mesh& mesh) {
  scheme::Operators operators{graph_of_cells(mesh, meshes::Quadrature::exact), "", {}};
  operators.errs_less_with_cells = true;
  return operators;
}

scheme::Operators edge_because(const meshes::Mesh& mesh,
                               const std::string& because,
                               std::vector<std::string> notices = {}) {
  return edge_on(mesh, fmt::format("edge stencil: {}", because), std::move(notices));
}

/// Why "auto" takes operators over cells where lines of curved blocks are there to derive along,
/// and what to do where these refuse; no reason: it does not.
struct CellsBecause {
  std::string reason, remedy;
};

CellsBecause cells_because(const meshes::Mesh& mesh,
                           const std::vector<meshes::LatticeBlock>& blocks,
                           const Options& options) {
  if (blocks.empty()) return {};
  if (options.is_hardly_compressible)
    return {"lock where lame >= 99 shear_modulus (nu >= 0.495)", ""};
  if (has_lines_of_two(blocks))
    return {"twist and bend too little where lines have two nodes", "give these lines three nodes"};
  const double ratio = unevenness_of_short_lines(mesh, blocks);
  if (ratio <= most_uneven) return {};
  return {
      fmt::format(
          "bend too little where lines of fewer than eight nodes have uneven cells (here {:.3g} "
          "times as long as the next ones)",
          ratio),
      "make the cells of these lines even, or give lines eight nodes"};
}

scheme::Operators edge_as_refused(const meshes::Mesh& mesh, const base::InputError& refusal) {
  return edge_because(mesh, "sbp does not go with this mesh",
                      {fmt::format("edge stencil, since {}. Where few cells are across bodies then "
                                   "bend tens of percent too little or too far; compare levels",
                                   refusal.what())});
}

/// What stencil = "auto" comes to where nothing presses hard.
scheme::Operators chosen_off_boxes(const meshes::Mesh& mesh, const Options& options) {
  const std::vector<meshes::LatticeBlock> blocks = smooth_blocks(mesh);
  std::vector<std::string> notices;
  if (const auto [because, remedy] = cells_because(mesh, blocks, options); !because.empty()) {
    try {
      scheme::Operators operators = sbp_on_cells(mesh);
      operators.notices.push_back(fmt::format(
          "operators over cells, not along the lines of curved blocks, which {}", because));
      return operators;
    } catch (const base::InputError& refusal) {
      if (options.is_hardly_compressible) return edge_as_refused(mesh, refusal);
      notices.push_back(
          fmt::format("operators along the lines of curved blocks, which {}: tens of percent; "
                      "those over cells do not go with this mesh ({}); {}",
                      because, refusal.what(), remedy));
    }
  }
  if (!is_too_small(blocks) && !options.jumps_are_symmetric &&
      gives_energy(blocks, options.order)) {
    return edge_because(
        mesh,
        "curved lines of six nodes, on which D_ab of sbp gives energy; five or seven take it");
  }
  try {
    scheme::Operators operators = sbp_off_boxes(mesh, blocks, options);
    operators.notices.insert(operators.notices.begin(), notices.begin(), notices.end());
    return operators;
  } catch (const base::InputError& refusal) {
    return edge_as_refused(mesh, refusal);
  }
}

/// What stencil = "auto" comes to.
scheme::Operators chosen_on(const meshes::Mesh& mesh, const Options& options) {
  if (!options.second_order_because.empty())
    return edge_because(mesh, options.second_order_because);
  if (const std::string because = unsure_because(mesh, options.order); !because.empty())
    return edge_because(mesh, because);
  if (meshes::is_undistorted_block(mesh)) return sbp_on_box(mesh, options.order);
  if (!options.strong_pressure_because.empty())
    return edge_because(mesh, options.strong_pressure_because);
  return chosen_off_boxes(mesh, options);
}

}  // namespace

const std::vector<std::string>& stencil_names() {
  return stencils().names();
}

scheme::Operators operators_on(const meshes::Mesh& mesh, const Options& options) {
  switch (stencils().at(options.stencil)) {
    case Stencil::automatic:
      return chosen_on(mesh, options);
    case Stencil::sbp:
      if (meshes::is_undistorted_block(mesh)) return sbp_on_box(mesh, options.order);
      try {
        return sbp_off_boxes(mesh, smooth_blocks(mesh), options);
      } catch (const base::InputError& refusal) {
        throw base::InputError(
            fmt::format("fvm.stencil = \"sbp\" does not go with this mesh: {}, or use \"edge\"",
                        refusal.what()));
      }
    case Stencil::edge:
      return edge_on(mesh, "");
    case Stencil::integral:
      return integral_on(mesh);
  }
  __builtin_unreachable();
}

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options) {
  return operators_on(mesh, options).graph;
}

}  // namespace diptych::fvm
