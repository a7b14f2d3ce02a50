#include "benchmarks/run/case_observers.hpp"

#include "common/run/quantities.hpp"
#include "common/run/references.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/graph/centroid.hpp"
#include "meshes/cell_checks.hpp"
#include "meshes/incidence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

namespace diptych::harness {

namespace {

/// The share of the energy that numerical dissipation may take: what the case says, all of it where
/// that is 1 (and the error of the steps with it), else half of it unless it has a limiter of
/// shocks, which dissipate.
double largest_loss(const cases::Case& setup) {
  constexpr double all = std::numeric_limits<double>::infinity();
  const double given = setup.guards.numerical_dissipation;
  if (given > 0) return given < 1 ? given : all;
  const std::string& limiter = setup.scheme.limiter;
  return limiter == "none" || limiter == "sign-preserving" ? 0.5 : all;
}

/// Nothing is made before something asks.
run::NodesAround nodes_around(const meshes::Mesh& mesh) {
  auto graph = std::make_shared<std::optional<meshes::NodalGraph>>();
  return [&mesh, graph](std::int32_t a, std::vector<std::int32_t>& nodes) {
    if (!*graph) *graph = meshes::nodal_graph(mesh);
    const auto around = (*graph)->around(a);
    nodes.insert(nodes.end(), around.begin(), around.end());
  };
}

run::LeastCell least_cell(const meshes::Mesh& mesh, const meshes::DeformedCells::Least& least) {
  return {least.J, least.n_inverted, mesh.n_cells(), meshes::centre_of(mesh, least.cell),
          mesh.cell(least.cell)[0]};
}

/// Nothing holds it, and no wall stops it.
bool is_free(const cases::Case& setup) {
  return std::all_of(
      setup.boundaries.begin(), setup.boundaries.end(), [](const cases::BoundaryCase& boundary) {
        return scheme::boundary_menu().at(boundary.type).acts == scheme::BoundaryKind::Acts::load;
      });
}

run::EnergyUnits energy_units(const cases::Case& setup, const Scene& scene) {
  const std::vector<double>& Omega = scene.graph.Omega;
  run::EnergyUnits units{
      run::energy_of_rounding(setup.material.density, scene.solver->undeformed_speed(), Omega)};
  if (!is_free(setup)) return units;
  const double mass = setup.material.density * std::accumulate(Omega.begin(), Omega.end(), 0.0);
  const double momentum = scene.solver->balance().linear_momentum.norm();
  units.carried = 0.5 * momentum * momentum / mass;
  const double eps = setup.scheme.precision == "single" ? std::numeric_limits<float>::epsilon()
                                                        : std::numeric_limits<double>::epsilon();
  constexpr double steps = 1e4;  // of which each rounds once, the same way
  units.rounding = std::max(units.rounding, steps * eps * units.carried);
  return units;
}

/// Those of a body all of which moves with the energy that rounding makes, as far from the centroid
/// as its farthest node.
run::MomentumUnits momentum_units(const cases::Case& setup,
                                  const Scene& scene,
                                  const run::EnergyUnits& energies) {
  const std::vector<double>& Omega = scene.graph.Omega;
  const double mass = setup.material.density * std::accumulate(Omega.begin(), Omega.end(), 0.0);
  const algebra::Vec3 centroid = scheme::centroid_of(scene.graph);
  double reach = 0;
  for (const algebra::Vec3& X : scene.graph.X)
    reach = std::max(reach, (X - centroid).norm());
  const double momentum = std::sqrt(2 * mass * energies.rounding);
  return {momentum, momentum * reach};
}

}  // namespace

CaseObservers::CaseObservers(const cases::Case& setup,
                             const RunOptions& options,
                             const Scene& scene)
    : setup_(setup),
      options_(options),
      scene_(scene),
      probes_(setup.probes, scene.graph, nodes_around(scene.mesh.mesh)),
      deformed_(scene.mesh.mesh),
      cells_(
          [this](std::span<const algebra::Vec3> u) {
            return least_cell(scene_.mesh.mesh, deformed_.least(u));
          },
          [this](std::int64_t step) { return cell_watch_ ? cell_watch_->seen(step) : nullptr; }),
      units_(energy_units(setup, scene)),
      history_(*scene.solver, probes_, cells_, units_, momentum_units(setup, scene, units_)),
      steps_(*scene.solver, probes_),
      exact_(setup, scene.graph, *scene.solver, probes_),
      fields_(scene.mesh.order, run::probe_columns(setup.probes, false), history_),
      progress_(setup, options, history_),
      energy_guard_(
          scene.solver->balance(), setup.guards.energy_residual, largest_loss(setup), units_),
      involution_guard_(*scene.solver, setup.guards.involution),
      momentum_guard_(scene.solver->balance(), setup.guards.angular_drift, units_.rounding) {
  if (options.scales) scales_.emplace(scene.graph);
  if (options.shapes)
    shapes_.emplace(scene.mesh.mesh, static_cast<size_t>(setup.output.frames) + 1);
  if (setup.guards.inverted_cells == "stop") {
    cell_watch_.emplace(*scene.solver, [this](const run::Motion& motion, double dt) {
      const auto outlook = deformed_.outlook(motion.u, motion.v, dt);
      return run::CellOutlook{least_cell(scene_.mesh.mesh, outlook.now), outlook.steps_left};
    });
    cell_guard_.emplace(cells_);
  }
}

void CaseObservers::check_files() const {
  io::require_frames(options_.directory, fields_.frame_times());
}

void CaseObservers::open() {
  if (options_.directory.empty()) return;
  const std::filesystem::path folder = options_.directory;
  const auto columns = run::probe_columns(setup_.probes, false);
  history_.write_to((folder / "history.csv").string(), columns);
  if (probes_.has_stepped()) {
    steps_.write_to((folder / "steps.csv").string(), run::probe_columns(setup_.probes, true));
  }
  if (options_.fields && setup_.output.fields) {
    fields_.write_with(
        io::FieldWriter(options_.directory, visual_mesh(scene_.mesh), fields_.frame_times()));
  } else if (!options_.checkpoint.empty()) {
    io::keep_frames(options_.directory, fields_.frame_times());
  }
}

std::vector<run::Observer*> CaseObservers::all() {
  std::vector<run::Observer*> all{&cells_};
  if (cell_watch_) all.push_back(&*cell_watch_);
  all.push_back(&history_);
  if (scales_) all.push_back(&*scales_);
  all.push_back(&exact_);
  all.push_back(&fields_);
  if (shapes_) all.push_back(&*shapes_);
  all.push_back(&steps_);
  all.push_back(&progress_);
  // last: what they stop at has been written
  all.push_back(&energy_guard_);
  all.push_back(&involution_guard_);
  all.push_back(&momentum_guard_);
  if (cell_guard_) all.push_back(&*cell_guard_);
  return all;
}

void CaseObservers::give(RunResult& result) {
  if (history_.rows().empty()) return;
  io::RunSummary& summary = result.summary;
  history_.fill(summary);
  cells_.fill(summary);
  summary.errors = exact_.errors().relative();
  result.history = history_.take_rows();
  result.steps = steps_.take_rows();
  summary.quantities = run::quantities_of(setup_.probes, result.history, result.steps);
  summary.references = run::references_of(setup_, result.history, result.steps);
  result.exact = exact_.columns();
  if (shapes_) result.shapes = shapes_->record();
  if (!scales_) return;
  result.scales = scales_->largest();
  for (const auto& [field, norm] : exact_.errors().scales())  // of errors too, where there are any
    result.scales[field] = norm;
}

}  // namespace diptych::harness
