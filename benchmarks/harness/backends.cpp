#include "benchmarks/harness/backends.hpp"

#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"

namespace diptych::harness {

const base::Registry<GraphMaker>& method_menu() {
  static const auto menu =
      base::Registry<GraphMaker>("method")
          .add("sph",
               [](const meshes::Mesh& mesh, const run::Case& setup) {
                 return sph::build_graph(mesh,
                                         {setup.sph.kernel, setup.sph.kappa, setup.sph.closure});
               })
          .add("fvm", [](const meshes::Mesh& mesh, const run::Case& setup) {
            return fvm::build_graph(mesh, {setup.fvm.stencil});
          });
  return menu;
}

}  // namespace diptych::harness
