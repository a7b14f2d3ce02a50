#include "benchmarks/run/case_observers.hpp"

#include "benchmarks/run/cell_survey.hpp"
#include "benchmarks/run/surveys.hpp"
#include "common/run/quantities.hpp"
#include "common/run/references.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "meshes/cell_at.hpp"
#include "meshes/incidence.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
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
  return scheme::limits_slopes(scheme::limiter_menu().at(setup.scheme.limiter)) ? all : 0.5;
}

run::LossBound loss_bound(const cases::Case& setup) {
  constexpr double set_off = 0.1;  // part of the run, guards.numerical_dissipation
  run::LossBound bound{largest_loss(setup), set_off * setup.time.end};
  if (setup.time.max_steps > 0) bound.from_step = setup.time.max_steps / 10;
  return bound;
}

}  // namespace

run::MeshAround mesh_around(const meshes::Mesh& mesh) {
  auto graph = std::make_shared<std::optional<meshes::NodalGraph>>();
  return {[&mesh, graph](std::int32_t a, std::vector<std::int32_t>& nodes) {
            if (!*graph) *graph = meshes::nodal_graph(mesh);
            const auto around = (*graph)->around(a);
            nodes.insert(nodes.end(), around.begin(), around.end());
          },
          [&mesh](const meshes::Vec3& place) { return meshes::nodes_of_cells_at(mesh, place); }};
}

CaseObservers::CaseObservers(const cases::Case& setup,
                             const RunOptions& options,
                             const Scene& scene,
                             double spacing)
    : setup_(setup),
      options_(options),
      scene_(scene),
      probes_(setup.probes, scene.graph, mesh_around(scene.mesh.mesh)),
      n_cells_(scene.mesh.mesh.n_cells()),
      cells_([this] { return look(0).now; },
             [this](std::int64_t step) { return cell_watch_ ? cell_watch_->seen(step) : nullptr; }),
      units_(run::energy_units(setup, scene.graph, scene.solver->undeformed_speed())),
      rounding_(units_.rounding(units_.frame.carried(scene.solver->balance()))),
      history_(*scene.solver,
               probes_,
               cells_,
               units_,
               run::momentum_units(setup, scene.graph, rounding_)),
      steps_(*scene.solver, probes_),
      exact_(setup,
             *scene.solver,
             survey_of_exact,
             probes_,
             run::natural_sizes(setup, scene.graph, scene.solver->undeformed_speed())),
      fields_(scene.mesh.order, run::probe_columns(setup.probes, false), history_),
      progress_(setup, options, history_),
      walls_(setup, scene.mesh.mesh, spacing),
      sliding_(setup, scene.mesh.mesh),
      energy_guard_(
          scene.solver->balance(), setup.guards.energy_residual, loss_bound(setup), units_),
      involution_guard_(*scene.solver, setup.guards.involution),
      momentum_guard_(scene.solver->balance(),
                      run::inertia_if_held(setup, scene.graph),
                      setup.guards.angular_drift,
                      rounding_),
      volume_guard_(*scene.solver, setup.guards.volumes_apart) {
  if (options.scales) scales_.emplace(scene.graph);
  if (options.shapes)
    shapes_.emplace(scene.mesh.mesh, static_cast<size_t>(setup.output.frames) + 1);
  if (setup.guards.inverted_cells == "stop") {
    cell_watch_.emplace([this](double dt) { return look(dt); });
    cell_guard_.emplace(cells_);
  }
}

run::CellOutlook CaseObservers::look(double dt) const {
  return outlook_of(scene_.solver->ask(survey_of_cells, {&dt, 1}), n_cells_);
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
  all.push_back(&walls_);
  all.push_back(&sliding_);
  // last: what they stop at has been written
  all.push_back(&energy_guard_);
  all.push_back(&involution_guard_);
  all.push_back(&momentum_guard_);
  all.push_back(&volume_guard_);
  if (cell_guard_) all.push_back(&*cell_guard_);
  return all;
}

std::optional<std::string> CaseObservers::notice_of_exact() const {
  constexpr double most = 0.5;  // a jump in the initial state may fall between two nodes
  for (const auto& [field, error] : exact_.errors().relative_at_first()) {
    if ((field != "displacement" && field != "velocity") || !(error > most)) continue;
    return fmt::format(
        "at the first output {} of the exact solution is not that of the run: they differ by "
        "{:.0f} % of its largest norm, so that errors say how far two motions are apart",
        field, 100 * error);
  }
  return exact_.notice();
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
