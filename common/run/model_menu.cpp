#include "common/run/model_menu.hpp"

#include "common/run/boundary_group.hpp"
#include "common/run/default_cfl.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "common/scheme/option_menus.hpp"

#include <fmt/format.h>

namespace diptych::run {

const base::Registry<SolverMaker>& model_menu() {
  static const auto menu = base::Registry<SolverMaker>("material.model")
                               .add("mooney-rivlin", make_mooney_rivlin)
                               .add("neo-hookean", make_neo_hookean)
                               .add("neo-hookean-isochoric", make_isochoric_neo_hookean)
                               .add("neo-hookean-isochoric-j2", make_isochoric_neo_hookean_j2);
  return menu;
}

std::vector<physics::MaxwellBranch> branches_of(const cases::MaterialCase& material,
                                                double xi,
                                                double zeta) {
  std::vector<physics::MaxwellBranch> branches;
  for (const cases::BranchCase& b : material.branches) {
    branches.push_back({b.beta_C * xi, b.tau_C, b.beta_G * zeta, b.tau_G});
  }
  return branches;
}

namespace {

/// Velocity of a motion; its traction comes from the known state.
void follow_motion(const std::shared_ptr<const exact::Motion>& motion,
                   scheme::BoundaryValues& values) {
  values.vector = [motion](const algebra::Vec3& X, double t) { return motion->velocity(X, t); };
  values.known = true;
  values.depends_on_time = true;
}

scheme::AppliedBoundary boundary_of(const cases::Case& setup, const scheme::PairGraph& graph) {
  std::vector<scheme::PlacedCondition> conditions;
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    const auto make = scheme::boundary_menu().at(boundary.type).make;
    scheme::BoundaryValues values;
    values.vector = boundary.value;
    values.scalar = boundary.pressure;
    values.point = boundary.point;
    values.normal = boundary.normal;
    values.depends_on_time =
        boundary.value.depends_on_time() || boundary.pressure.depends_on_time();
    if (boundary.manufactured) follow_motion(setup.motion, values);
    for (const std::string& group : boundary.groups) {
      conditions.push_back({make(values), &boundary_group(graph, group, boundary.where)});
    }
  }
  scheme::VectorFunction body_force;
  if (!setup.body_force.is_zero()) body_force = setup.body_force;
  return {graph, std::move(conditions), body_force, setup.body_force.depends_on_time()};
}

scheme::TimeStepRule time_step_of(const cases::Case& setup,
                                  const scheme::PairGraph& graph,
                                  const SolverSetup& s) {
  const double cfl = setup.time.cfl > 0 ? setup.time.cfl : default_cfl(setup, graph, s.integrator);
  return {scheme::speeds_menu().at(setup.time.speeds), cfl,
          scheme::frequency_factor(s.face_correction)};
}

SolverSetup solver_setup_of(const cases::Case& setup,
                            const scheme::PairGraph& graph,
                            const scheme::AppliedBoundary& boundary) {
  using namespace scheme;
  SolverSetup s;
  s.dissipation = {reconstruction_menu().at(setup.scheme.reconstruction),
                   limiter_menu().at(setup.scheme.limiter),
                   impedance_menu().at(setup.scheme.impedance)};
  s.dissipation_factor = setup.scheme.dissipation;
  s.face_correction = setup.scheme.face_correction;
  s.unknowns = unknowns_menu().at(setup.scheme.unknowns);
  s.integrator = time::integrator_menu().at(setup.time.integrator);
  s.time_step = time_step_of(setup, graph, s);
  s.angular_momentum_projection = setup.scheme.angular_momentum_projection;
  if (s.angular_momentum_projection && boundary.has_constraints()) {
    throw base::InputError(
        "scheme.angular_momentum_projection is for free bodies; this case prescribes velocities on "
        "its boundary: remove one of the two");
  }
  s.energy_budget = setup.scheme.energy_budget;
  s.initial = setup.initial;
  return s;
}

}  // namespace

std::unique_ptr<Solver> make_solver(const cases::Case& setup, const scheme::PairGraph& graph) {
  const SolverMaker maker = model_menu().at(setup.material.model);
  scheme::AppliedBoundary boundary = boundary_of(setup, graph);
  SolverSetup solver_setup = solver_setup_of(setup, graph, boundary);
  return maker(setup, graph, std::move(solver_setup), std::move(boundary));
}

}  // namespace diptych::run
