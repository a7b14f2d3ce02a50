#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/physics/moduli.hpp"
#include "common/run/model_menu.hpp"

namespace diptych::run {

std::unique_ptr<Solver> make_neo_hookean(const cases::Case& setup,
                                         const scheme::PairGraph& graph,
                                         SolverSetup solver_setup,
                                         scheme::AppliedBoundary boundary) {
  const auto p =
      physics::mooney_rivlin_parameters({setup.material.shear_modulus, setup.material.lame}, 0);
  const physics::NeoHookean material{p.xi, 0, p.lambda_hat};
  return solver_of(material, setup, graph, std::move(solver_setup), std::move(boundary));
}

}  // namespace diptych::run
