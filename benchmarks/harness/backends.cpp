#include "benchmarks/harness/backends.hpp"

#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"

namespace diptych::harness {

namespace {

const base::Registry<scheme::Precision>& precision_menu() {
  static const auto menu = base::Registry<scheme::Precision>("scheme.precision")
                               .add("double", scheme::Precision::full)
                               .add("mixed", scheme::Precision::mixed)
                               .add("single", scheme::Precision::single);
  return menu;
}

scheme::PairGraph in_precision(scheme::PairGraph graph, const std::string& precision) {
  set_precision(graph, precision_menu().at(precision));
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
                     setup.scheme.precision);
               })
          .add("fvm", [](const meshes::Mesh& mesh, const run::Case& setup) {
            return in_precision(fvm::build_graph(mesh, {setup.fvm.stencil}),
                                setup.scheme.precision);
          });
  return menu;
}

}  // namespace diptych::harness
