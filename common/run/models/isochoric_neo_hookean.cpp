#include "common/physics/materials/isochoric_neo_hookean.hpp"

#include "common/physics/moduli.hpp"
#include "common/run/model_menu.hpp"

namespace diptych::run {

std::unique_ptr<Solver> make_isochoric_neo_hookean(const cases::Case& setup,
                                                   const scheme::PairGraph& graph,
                                                   SolverSetup solver_setup,
                                                   scheme::AppliedBoundary boundary) {
  const double mu = setup.material.shear_modulus;
  const physics::IsochoricNeoHookean material{mu, setup.material.lame + 2 * mu / 3};
  return solver_of(material, setup, graph, std::move(solver_setup), std::move(boundary));
}

}  // namespace diptych::run
