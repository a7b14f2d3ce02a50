#pragma once
/// The menu of compiled models: material x dimension. Branches, unknowns and scheme options are
/// chosen inside. Adding a material: its file in common/physics/materials and a line here.

#include "common/run/body_solver.hpp"

#include <memory>

namespace diptych::run {

/// The Maxwell branches of a case for a material with these moduli.
std::vector<physics::MaxwellBranch> branches_of(const cases::MaterialCase& material,
                                                double xi,
                                                double zeta);

/// A solver for this material in the graph's dimension.
template <class Material>
std::unique_ptr<Solver> solver_of(const Material& material,
                                  const cases::Case& setup,
                                  const scheme::PairGraph& graph,
                                  SolverSetup solver_setup,
                                  scheme::AppliedBoundary boundary) {
  const auto branches = branches_of(setup.material, material.branch_xi(), material.branch_zeta());
  const scheme::Model<Material> model{material, setup.material.density, branches};
  if (setup.motion) {
    const auto known = graph.dimension == 2 ? exact::manufactured_solution<2, Material>
                                            : exact::manufactured_solution<3, Material>;
    solver_setup.known = known(setup.motion, model, graph.X, setup.initial.relaxed, setup.time.end);
    boundary.follow(solver_setup.known);
  }
  if (graph.dimension == 2) {
    return std::make_unique<BodySolver<2, Material>>(graph, model, std::move(solver_setup),
                                                     std::move(boundary));
  }
  return std::make_unique<BodySolver<3, Material>>(graph, model, std::move(solver_setup),
                                                   std::move(boundary));
}

using SolverMaker = std::unique_ptr<Solver> (*)(const cases::Case& setup,
                                                const scheme::PairGraph& graph,
                                                SolverSetup solver_setup,
                                                scheme::AppliedBoundary boundary);

// one file each in models/, so that they compile side by side
std::unique_ptr<Solver> make_mooney_rivlin(const cases::Case&,
                                           const scheme::PairGraph&,
                                           SolverSetup,
                                           scheme::AppliedBoundary);
std::unique_ptr<Solver> make_neo_hookean(const cases::Case&,
                                         const scheme::PairGraph&,
                                         SolverSetup,
                                         scheme::AppliedBoundary);
std::unique_ptr<Solver> make_isochoric_neo_hookean(const cases::Case&,
                                                   const scheme::PairGraph&,
                                                   SolverSetup,
                                                   scheme::AppliedBoundary);
std::unique_ptr<Solver> make_isochoric_neo_hookean_j2(const cases::Case&,
                                                      const scheme::PairGraph&,
                                                      SolverSetup,
                                                      scheme::AppliedBoundary);

/// mooney-rivlin, neo-hookean, neo-hookean-isochoric, neo-hookean-isochoric-j2
const base::Registry<SolverMaker>& model_menu();

}  // namespace diptych::run
