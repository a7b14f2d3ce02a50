#include "benchmarks/harness/backends.hpp"

#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"

namespace diptych::harness {

namespace {

scheme::PairGraph in_precision(scheme::PairGraph graph, const std::string& precision) {
  if (precision == "single") round_to_single(graph);
  return graph;
}

}  // namespace

const base::Registry<GraphMaker>& method_menu() {
  static const auto menu =
      base::Registry<GraphMaker>("method")
          .add("sph",
               [](const meshes::Mesh& mesh, const run::Case& setup) {
                 return in_precision(
                     sph::build_graph(mesh, {setup.sph.kernel, setup.sph.kappa, setup.sph.closure}),
                     setup.scheme.geometry_precision);
               })
          .add("fvm", [](const meshes::Mesh& mesh, const run::Case& setup) {
            return in_precision(fvm::build_graph(mesh, {setup.fvm.stencil}),
                                setup.scheme.geometry_precision);
          });
  return menu;
}

}  // namespace diptych::harness
