#include "fvm/fvm_graph.hpp"

#include "common/base/registry.hpp"
#include "common/scheme/classify_rows.hpp"
#include "common/scheme/closure_repair.hpp"
#include "fvm/cell_stencil.hpp"
#include "meshes/dual_measure.hpp"

namespace diptych::fvm {

namespace {

base::Registry<meshes::Quadrature> stencils() {
  base::Registry<meshes::Quadrature> menu("stencil of fvm");
  menu.add("edge", meshes::Quadrature::vertex).add("integral", meshes::Quadrature::exact);
  return menu;
}

}  // namespace

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options) {
  const meshes::Quadrature quadrature = stencils().at(options.stencil);
  meshes::DualMeasure measure = meshes::dual_measure(mesh, quadrature);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.Omega = std::move(measure.Omega);
  graph.boundary_area = std::move(measure.boundary_area);
  for (meshes::PatchArea& patch : measure.patches) {
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area)});
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
    repair_closure_pairs(graph, k);
  }
  set_classes(graph);
  validate(graph);
  return graph;
}

}  // namespace diptych::fvm
