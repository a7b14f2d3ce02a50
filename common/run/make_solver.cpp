/// A case resolved for the solver: every name of a menu becomes what it stands for.

#include "common/functions/break_times.hpp"
#include "common/functions/placed_values.hpp"
#include "common/run/body_solver.hpp"
#include "common/run/boundary_group.hpp"
#include "common/run/default_cfl.hpp"
#include "common/run/energy_record.hpp"
#include "common/run/initial_check.hpp"
#include "common/run/model_menu.hpp"
#include "common/run/ranks/rank_set_up.hpp"
#include "common/run/step_ends.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "common/scheme/option_menus.hpp"
#include "common/scheme/ranks/share_graph.hpp"
#include "common/scheme/volumes/cell_laplacian.hpp"

#include <fmt/format.h>
#include <functional>

namespace diptych::run {

namespace {

/// Expressions at the nodes of a patch.
template <class Value>
class PlacedLoad : public scheme::PlacedField<Value> {
 public:
  PlacedLoad(std::vector<functions::Expression> components, std::span<const algebra::Vec3> X)
      : placed_(std::move(components), X) {}
  std::vector<Value> at(double t) const override {
    std::vector<double> components = placed_.at(t);
    if constexpr (std::is_same_v<Value, double>) {
      return components;
    } else {
      std::vector<Value> values(components.size() / 3);
      for (size_t a = 0; a < values.size(); ++a)
        values[a] = {components[3 * a], components[3 * a + 1], components[3 * a + 2]};
      return values;
    }
  }

 private:
  functions::PlacedExpressions placed_;
};

/// At which boundary conditions show what they are: the start, the end, instants that no symmetry
/// picks out, those of jumps and kinks in time (pulses of min, max and abs), and between them; of
/// many a part, evenly.
std::vector<double> telling_instants(const cases::Case& setup) {
  constexpr size_t most = 32;
  const double end = setup.time.end;
  std::vector<functions::Expression> values;
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    values.insert(values.end(), boundary.value.component.begin(), boundary.value.component.end());
    values.push_back(boundary.pressure);
  }
  std::vector<double> instants{0.0, 0.31 * end, 0.73 * end, end, 0.11 * end, 0.047 * end};
  const std::vector<double> around =
      functions::instants_around(functions::break_times(values, 0, end), 0, 0.37, most);
  instants.insert(instants.end(), around.begin(), around.end());
  return instants;
}

/// @tparam Value     of the field  @param instants  telling ones
template <class Value, class Function>
typename scheme::FieldFunction<Value>::InPlace in_place(const Function& function,
                                                        const std::vector<double>& instants) {
  if (!function.depends_on_position()) return {};
  if (!function.depends_on_time()) return {{0.0}, false};
  return {instants, function.joins_place_and_time()};
}

scheme::VectorFunction field_of(const functions::VectorExpression& vector,
                                const std::vector<double>& instants) {
  return {vector,
          [vector](std::span<const algebra::Vec3> X) {
            const auto& c = vector.component;
            return std::make_unique<PlacedLoad<algebra::Vec3>>(
                std::vector<functions::Expression>(c.begin(), c.end()), X);
          },
          in_place<algebra::Vec3>(vector, instants)};
}

scheme::ScalarFunction field_of(const functions::Expression& scalar,
                                const std::vector<double>& instants) {
  return {scalar,
          [scalar](std::span<const algebra::Vec3> X) {
            return std::make_unique<PlacedLoad<double>>(std::vector<functions::Expression>{scalar},
                                                        X);
          },
          in_place<double>(scalar, instants)};
}

/// Velocity of a motion at the nodes of a patch.
class PlacedVelocity : public scheme::PlacedField<algebra::Vec3> {
 public:
  PlacedVelocity(const exact::Motion& motion, std::span<const algebra::Vec3> X)
      : dimension_(static_cast<size_t>(motion.dimension())),
        placed_(motion.program(), motion.rates(1), X) {}
  std::vector<algebra::Vec3> at(double t) const override {
    const auto n = static_cast<size_t>(placed_.n_places());
    std::vector<double> components(n * dimension_);
    placed_.at(t, components);
    std::vector<algebra::Vec3> values(n, algebra::Vec3::Zero());
    for (size_t k = 0; k < components.size(); ++k)
      values[k / dimension_][static_cast<int>(k % dimension_)] = components[k];
    return values;
  }

 private:
  size_t dimension_;
  functions::PlacedValues placed_;
};

/// Velocity of a motion; its traction comes from the known state.
void follow_motion(const scheme::VectorFunction& velocity, scheme::BoundaryValues& values) {
  values.vector = velocity;
  values.known = true;
  values.depends_on_time = true;
}

/// Loads act on a face once. What holds the normals of two groups holds both where they meet.
std::vector<const scheme::BoundaryPatch*> patches_of(const cases::BoundaryCase& boundary,
                                                     const scheme::PairGraph& graph) {
  if (scheme::boundary_menu().at(boundary.type).acts == scheme::BoundaryKind::Acts::load)
    return patches_with_each_face_once(graph, boundary.groups, boundary.where);
  std::vector<const scheme::BoundaryPatch*> patches;
  for (const std::string& group : boundary.groups)
    patches.push_back(&boundary_group(graph, group, boundary.where));
  return patches;
}

/// @param speed  of waves in the undeformed body  [m/s]
scheme::AppliedBoundary boundary_of(const cases::Case& setup,
                                    const scheme::PairGraph& graph,
                                    double speed) {
  std::vector<scheme::PlacedCondition> conditions;
  const std::vector<double> instants = telling_instants(setup);
  scheme::VectorFunction velocity;  // of the motion, one for all
  if (const auto motion = setup.motion) {
    velocity = {[motion](const algebra::Vec3& X, double t) { return motion->velocity(X, t); },
                [motion](std::span<const algebra::Vec3> X) {
                  return std::make_unique<PlacedVelocity>(*motion, X);
                }};
  }
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    const auto make = scheme::boundary_menu().at(boundary.type).make;
    scheme::BoundaryValues values;
    values.vector = field_of(boundary.value, instants);
    values.scalar = field_of(boundary.pressure, instants);
    values.point = boundary.point;
    values.normal = boundary.normal;
    values.depends_on_time =
        boundary.value.depends_on_time() || boundary.pressure.depends_on_time();
    if (boundary.manufactured) follow_motion(velocity, values);
    for (const scheme::BoundaryPatch* patch : patches_of(boundary, graph))
      conditions.push_back({make(values), patch});
  }
  scheme::check_shared_nodes(graph, conditions, instants, speed);
  scheme::VectorFunction body_force;
  if (!setup.body_force.is_zero()) body_force = field_of(setup.body_force, instants);
  return {graph, std::move(conditions), body_force, setup.body_force.depends_on_time()};
}

/// @param has_moments  of the body, which the rank that made it may have from its graph
scheme::Reconstruction reconstruction_of(const cases::Case& setup, bool has_moments) {
  if (has_moments) return scheme::Reconstruction::symmetric;
  switch (scheme::reconstruction_menu().at(setup.scheme.reconstruction)) {
    case scheme::ReconstructionChoice::none:
      return scheme::Reconstruction::none;
    case scheme::ReconstructionChoice::objective:
      return scheme::Reconstruction::objective;
    default:
      return scheme::Reconstruction::linear;
  }
}

scheme::SweepOptions sweep_options_of(const cases::Case& setup, bool has_moments) {
  scheme::SweepOptions options;
  options.dissipation = {reconstruction_of(setup, has_moments),
                         scheme::limiter_menu().at(setup.scheme.limiter),
                         scheme::impedance_menu().at(setup.scheme.impedance)};
  options.dissipation_factor = setup.scheme.dissipation;
  options.face_correction = setup.scheme.face_correction;
  return options;
}

scheme::BodyOptions body_options_of(const cases::Case& setup,
                                    const scheme::PairGraph& graph,
                                    const scheme::MaterialModel& material,
                                    const time::Integrator& integrator) {
  const auto n_branches = static_cast<int>(material.branches().size());
  scheme::BodyOptions options;
  options.rho_R = material.rho_R();
  options.n_branches = n_branches;
  options.has_G = material.has_H();
  options.unknowns = scheme::unknowns_menu().at(setup.scheme.unknowns);
  options.exact_impedance =
      scheme::impedance_menu().at(setup.scheme.impedance) == scheme::Impedance::exact;
  const scheme::Reconstruction reconstruction = reconstruction_of(setup, is_symmetric(setup));
  options.has_frames = reconstruction == scheme::Reconstruction::objective;
  options.has_moments = reconstruction == scheme::Reconstruction::symmetric;
  options.has_slopes = has_line_slopes(setup, graph);
  options.keeps_L_0 = integrator.gauss_relaxation && n_branches > 0;
  options.face_correction = setup.scheme.face_correction != 0;
  options.volumes = volumes_of(setup, graph);
  options.cell_shear = cell_shear_of(setup, options.volumes);
  options.hourglass = hourglass_of(setup, graph);
  return options;
}

/// The parts of a solver that its case and its nodes give.
struct Parts {
  Parts(const cases::Case& setup, const scheme::PairGraph& graph)
      : material(model_menu().at(setup.material.model).model(setup.material)),
        boundary(boundary_of(setup, graph, material->undeformed_speed())),
        integrator(time::integrator_menu().at(setup.time.integrator)) {
    if (!setup.motion) return;
    known = model_menu().at(setup.material.model).known(*material, setup, graph);
    boundary.follow(known);
  }
  std::shared_ptr<const scheme::MaterialModel> material;
  scheme::AppliedBoundary boundary;
  const time::Integrator& integrator;
  std::shared_ptr<exact::KnownState> known;
};

template <int Dim>
std::unique_ptr<BodySolver<Dim>> assembled(const cases::Case& setup,
                                           const scheme::PairGraph& graph,
                                           Parts parts,
                                           scheme::Body<Dim> body,
                                           double cfl,
                                           double geometric_rate) {
  scheme::SweepOptions options = sweep_options_of(setup, body.options.has_moments);
  options.time_step = {scheme::speeds_menu().at(setup.time.speeds), cfl,
                       scheme::frequency_factor(setup.scheme.face_correction)};
  scheme::Sweeps<Dim> sweeps(body, parts.material, options, geometric_rate);
  time::MovingBody<Dim> moving{std::move(body), std::move(sweeps), std::move(parts.boundary),
                               parts.integrator, setup.scheme.angular_momentum_projection};
  moving.clock.least_share = setup.guards.least_step;
  const BudgetOfStart::Bounds start{setup.guards.energy_residual / 2,
                                    energy_units(setup, graph, parts.material->undeformed_speed())};
  return std::make_unique<BodySolver<Dim>>(std::move(moving), std::move(parts.known),
                                           setup.time.max_retries, start);
}

/// Called once the solver needs no pairs of the graph any more.
using PairsTaken = std::function<void()>;

template <int Dim>
std::unique_ptr<Solver> solver_in(const cases::Case& setup,
                                  const scheme::PairGraph& graph,
                                  const PairsTaken& taken) {
  check_initial_deformation(setup, graph);
  Parts parts(setup, graph);
  if (setup.scheme.angular_momentum_projection && parts.boundary.has_walls()) {
    throw base::InputError(
        "scheme.angular_momentum_projection does not go with rigid walls, whose impulses come and "
        "go within a step: remove one of the two");
  }
  const double geometric_rate = scheme::geometric_rate(graph);
  double cfl = setup.time.cfl;
  const scheme::BodyOptions options =
      body_options_of(setup, graph, *parts.material, parts.integrator);
  // the records of a body with the exact impedance are not those that the rates read
  if (!(cfl > 0))
    cfl = options.exact_impedance
              ? default_cfl(setup, graph, parts.integrator)
              : sampled_cfl<Dim>(setup, graph, geometric_rate, parts.integrator);
  scheme::Body<Dim> body(graph, options);
  taken();
  if (!(cfl > 0)) cfl = default_cfl(setup, *parts.material, body, geometric_rate, parts.integrator);
  auto solver =
      assembled<Dim>(setup, graph, std::move(parts), std::move(body), cfl, geometric_rate);
  solver->begin(setup.initial, setup.scheme.face_correction, start_of(setup));
  return solver;
}

std::unique_ptr<Solver> solver_taking(const cases::Case& setup,
                                      const scheme::PairGraph& graph,
                                      const PairsTaken& taken) {
  return graph.dimension == 2 ? solver_in<2>(setup, graph, taken)
                              : solver_in<3>(setup, graph, taken);
}

template <int Dim>
std::unique_ptr<Solver> given_solver_in(const cases::Case& setup,
                                        const scheme::PairGraph& nodes,
                                        const RankSetUp& set_up,
                                        parallel::Communicator& ranks) {
  scheme::SweepGraph<Dim> graph;
  scheme::share_indices(ranks, graph);
  return assembled<Dim>(setup, nodes, Parts(setup, nodes),
                        scheme::Body<Dim>(nodes, set_up.body, std::move(graph)), set_up.cfl,
                        set_up.geometric_rate);
}

}  // namespace

bool wants_line_slopes(const cases::Case& setup) {
  using Choice = scheme::ReconstructionChoice;
  const Choice asked = scheme::reconstruction_menu().at(setup.scheme.reconstruction);
  if (asked != Choice::automatic) return asked == Choice::quartic;
  return !scheme::limits_slopes(scheme::limiter_menu().at(setup.scheme.limiter));
}

bool has_line_slopes(const cases::Case& setup, const scheme::PairGraph& graph) {
  if (!graph.slopes.empty()) return wants_line_slopes(setup);
  if (scheme::reconstruction_menu().at(setup.scheme.reconstruction) ==
      scheme::ReconstructionChoice::quartic) {
    throw base::InputError(
        fmt::format("{}: scheme.reconstruction = \"quartic\" needs operators that sum by parts on "
                    "an undistorted "
                    "box of hexahedra or quadrilaterals; use \"linear\" or \"auto\"",
                    setup.file));
  }
  return false;
}

bool is_symmetric(const cases::Case& setup) {
  return scheme::reconstruction_menu().at(setup.scheme.reconstruction) ==
         scheme::ReconstructionChoice::symmetric;
}

scheme::Volumes volumes_of(const cases::Case& setup, const scheme::PairGraph& graph) {
  using scheme::Volumes;
  const Volumes asked = scheme::volumes_menu().at(setup.scheme.volumes);
  if (asked == Volumes::automatic) return scheme::safe_volumes(graph);
  if (asked == Volumes::cells && graph.cells.empty()) {
    throw base::InputError(
        "scheme.volumes = \"cells\" is not for this graph: faces of the boundary are no "
        "parallelograms, or the operators sum by parts, whose boundary areas are not those of "
        "cells; use \"auto\"");
  }
  if (asked == Volumes::lines && graph.lines.empty()) {
    throw base::InputError(
        "scheme.volumes = \"lines\" is for SPH that sums by parts (sph.gradient = \"sbp\") on "
        "undistorted boxes of hexahedra or quadrilaterals; use \"auto\"");
  }
  return asked;
}

double cell_shear_of(const cases::Case& setup, scheme::Volumes volumes) {
  return volumes == scheme::Volumes::cells ? setup.scheme.cell_shear * setup.material.shear_modulus
                                           : 0;
}

double hourglass_of(const cases::Case& setup, const scheme::PairGraph& graph) {
  if (graph.edges.empty() || !is_symmetric(setup)) return 0;
  return setup.scheme.hourglass * setup.material.shear_modulus;
}

std::unique_ptr<Solver> make_solver(const cases::Case& setup, const scheme::PairGraph& graph) {
  return solver_taking(setup, graph, [] {});
}

std::unique_ptr<Solver> make_solver_of_pairs(const cases::Case& setup, scheme::PairGraph& graph) {
  return solver_taking(setup, graph, [&] { scheme::release_pairs(graph); });
}

std::unique_ptr<Solver> make_given_solver(const cases::Case& setup,
                                          scheme::PairGraph& graph,
                                          parallel::Communicator& ranks) {
  RankSetUp set_up;
  parallel::share(ranks, set_up);
  scheme::share_nodes(ranks, graph, set_up.body.volumes);
  return graph.dimension == 2 ? given_solver_in<2>(setup, graph, set_up, ranks)
                              : given_solver_in<3>(setup, graph, set_up, ranks);
}

}  // namespace diptych::run
