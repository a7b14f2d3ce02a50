#include "benchmarks/run/menus.hpp"

#include "common/run/model_menu.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/kernels/kernel.hpp"
#include "sph/sph_graph.hpp"

namespace diptych::harness {

const cases::Menus& menus() {
  static const cases::Menus all{{"material.model", run::model_menu().names()},
                                {"sph.kernel", sph::kernels().names()},
                                {"sph.gradient", sph::gradient_names()},
                                {"fvm.stencil", fvm::stencil_names()}};
  return all;
}

cases::Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  return cases::read_case(path, overrides, menus());
}

}  // namespace diptych::harness
