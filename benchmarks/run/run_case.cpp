#include "benchmarks/run/run_case.hpp"

#include "benchmarks/run/breakdown_place.hpp"
#include "benchmarks/run/case_observers.hpp"
#include "benchmarks/run/checkpoints.hpp"
#include "benchmarks/run/first_step.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/judgement.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/ranked_runs.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/run/run_folder.hpp"
#include "benchmarks/run/run_identity.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/thread_count.hpp"
#include "common/run/exact_survey.hpp"
#include "common/run/simulation.hpp"
#include "common/run/solver.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "common/scheme/option_menus.hpp"
#include "meshes/dual_measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <map>
#include <new>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace diptych::harness {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Mean spacing of the nodes [m]. Of the interior nodes: those on the boundary have only a part of
/// their cell inside. Volumes of operators that sum by parts differ from node to node near the
/// boundary: there by the part of the full angle that the body fills at each node.
double spacing_of(const CaseGraph& scene) {
  const scheme::PairGraph& graph = scene.graph;
  double volume = 0, n = 0;
  if (scene.operators.starts_with("sbp")) {
    for (const double part : meshes::filled_angle(scene.mesh.mesh))
      n += part;
    volume = std::accumulate(graph.Omega.begin(), graph.Omega.end(), 0.0);
    return std::pow(volume / n, 1.0 / graph.dimension);
  }
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    if (!graph.boundary_area[a].isZero(0)) continue;
    volume += graph.Omega[a];
    ++n;
  }
  if (n == 0) {
    volume = std::accumulate(graph.Omega.begin(), graph.Omega.end(), 0.0);
    n = static_cast<double>(graph.n_nodes());
  }
  return std::pow(volume / n, 1.0 / graph.dimension);
}

void describe_graph(const CaseGraph& scene, io::RunSummary& s) {
  const scheme::PairGraph& graph = scene.graph;
  const scheme::GraphQuality q = scheme::quality(graph);
  s.nodes = graph.n_nodes();
  s.pairs = graph.n_pairs();
  s.dimension = graph.dimension;
  s.mean_neighbours = q.mean_neighbours;
  s.graph_closure = q.closure;
  s.graph_linear_exactness = q.linear_exactness;
  s.graph_operators = scene.operators;
  s.spacing = spacing_of(scene);
}

/// One run, whose parts refer to each other.
class CaseRun {
 public:
  CaseRun(const cases::Case& setup, const RunOptions& options);
  CaseRun(const CaseRun&) = delete;
  CaseRun& operator=(const CaseRun&) = delete;

  /// Steps to the end, or to a breakdown, and writes what came of it.
  void go();
  /// Writes the summary of a run that could not be finished.
  void fail(const std::string& message) noexcept;
  RunResult take() { return std::move(result_); }

 private:
  void identify();
  void go_on();
  void note_other_instants();
  void keep_checkpoints();
  void archive(algebra::Archive& archive);
  void tell(const std::string& notice) const;
  void warn(const std::string& notice) const;
  void note_running_memory();
  void note_breakdown();
  void note_dissipation();
  std::optional<std::string> notice_of_little_motion() const;
  void note_contradictions();
  void measure();
  void finish();
  std::map<std::string, std::vector<double>> final_errors() const;

  Clock::time_point start_ = Clock::now();
  double seconds_before_ = 0;  // a checkpoint
  RunMemory memory_;
  const cases::Case& setup_;
  const RunOptions& options_;
  RunFolder folder_;
  RunResult result_;
  std::unique_ptr<Scene> scene_;
  std::optional<CaseObservers> observers_;
  FirstStep first_step_{[this] { note_running_memory(); }};
  std::optional<run::Simulation> simulation_;
};

CaseRun::CaseRun(const cases::Case& setup, const RunOptions& options)
    : setup_(setup), options_(options), folder_(options.directory) {
  check_figures(setup);
  parallel::set_threads(options.threads);
  scene_ = scene_of_run(setup, options, [this](ScenePart part, const CaseGraph& scene) {
    if (part == ScenePart::graph) describe_graph(scene, result_.summary);
  });
  identify();
  result_.summary.notices = scene_->notices;
  for (const std::string& notice : scene_->notices)
    tell(notice);
  observers_.emplace(setup, options, *scene_, result_.summary.spacing);
  std::vector<run::Observer*> observers = observers_->all();
  observers.push_back(&first_step_);
  simulation_.emplace(setup_, *scene_->solver, std::move(observers), interrupt_requested);
  if (!options.checkpoint.empty()) go_on();
  folder_.check();
  if (folder_.is_written() && options.before_writing) options.before_writing();
  folder_.open(setup, result_.summary, !options.checkpoint.empty());
  if (folder_.is_written() && options.checkpoints) keep_checkpoints();
}

void CaseRun::tell(const std::string& notice) const {
  if (!options_.quiet) warn(notice);
}

/// Told where no progress is, too.
void CaseRun::warn(const std::string& notice) const {
  const std::string text =
      fmt::format("{} level {}: {}\n", options_.column(), options_.level, notice);
  std::fputs(base::folded(text, 2).c_str(), stderr);
}

/// Takes state and records from the checkpoint.
void CaseRun::go_on() {
  io::CheckpointReader reader(options_.checkpoint);
  archive(reader);
  reader.finish();
  observers_->check_files();
  tell(fmt::format("goes on from {}, step {}, t = {:.6g} s", options_.checkpoint,
                   simulation_->totals().steps, scene_->solver->time()));
  note_other_instants();
}

/// Steps are cut for the next instant of output: where those before the checkpoint were of another
/// setting, so are its steps and rows.
void CaseRun::note_other_instants() {
  std::vector<double> were;
  for (const io::HistoryRow& row : observers_->rows())
    were.push_back(row.time);
  if (simulation_->instant_ahead() > scene_->solver->time())
    were.push_back(simulation_->instant_ahead());
  const std::vector<double> are = simulation_->instants_of_steps();
  const auto [was, is] = std::mismatch(were.begin(), were.end(), are.begin(), are.end());
  if (was == were.end() && is == are.end()) return;
  const std::string first =
      was == were.end() ? fmt::format("t = {} s was none", *is)
      : is == are.end() ? fmt::format("t = {} s is none any more", *was)
                        : fmt::format("the first that differs was t = {} s, is {} s", *was, *is);
  result_.summary.notices.push_back(fmt::format(
      "goes on from a run with other instants of output ({}; time.end, output.frames): steps and "
      "rows before the checkpoint are those of that run, and bits are not those of a run that "
      "never "
      "ended",
      first));
  tell(result_.summary.notices.back());
}

void CaseRun::keep_checkpoints() {
  if (!options_.checkpoint.empty())
    remove_later_checkpoints(folder_.path(), simulation_->totals().steps);
  simulation_->keep({setup_.time.checkpoint_every, setup_.time.checkpoint_seconds,
                     setup_.time.checkpoint_interval, base::take_checkpoint_request, [this] {
                       write_checkpoint(folder_.path(), simulation_->totals().steps,
                                        [this](algebra::Archive& to) { archive(to); });
                     }});
}

/// @throws base::InputError where it is loading a checkpoint of another run
void CaseRun::archive(algebra::Archive& archive) {
  io::RunSummary& s = result_.summary;
  const RunIdentity now = identity_of(setup_, scene_->graph, s);
  RunIdentity identity = now;
  identity.archive(archive);
  const std::string difference = difference_of(identity, now);
  if (!difference.empty()) throw base::InputError(options_.checkpoint + ": " + difference);
  const std::string doubt = doubt_about(identity, now);
  if (!doubt.empty()) warn(options_.checkpoint + " " + doubt);
  std::string hash = scene_->solver->state_hash(scene_->mesh.order);
  archive.text("identity/state hash", hash);
  archive.integer("run/restarts", s.restarts);
  double seconds = seconds_before_ + seconds_since(start_);
  archive.real("run/wall seconds", "s", seconds);
  simulation_->archive(archive);
  if (!archive.is_loading()) return;
  ++s.restarts;
  seconds_before_ = seconds;
  if (scene_->solver->state_hash(scene_->mesh.order) == hash) return;
  throw base::InputError(options_.checkpoint +
                         ": the state in it is not the one that it was written of");
}

void CaseRun::identify() {
  io::RunSummary& s = result_.summary;
  s.method = options_.method;
  s.variant = options_.variant;
  s.case_name = setup_.name;
  s.case_file = setup_.file;
  s.title = setup_.title;
  s.level = options_.level;
  s.threads = parallel::running_threads();
  s.integrator = setup_.time.integrator;
  s.volumes = scheme::name_of(run::volumes_of(setup_, scene_->graph));
  s.precision = setup_.scheme.precision;
  s.unknowns_per_node = scene_->solver->unknowns_per_node();
  s.arrangement = scene_->solver->arrangement();
  s.provenance = provenance(setup_.hash);
  s.provenance.input_hash = input_hash(setup_, options_.measures);
}

void CaseRun::go() {
  io::RunSummary& s = result_.summary;
  observers_->open();
  scheme::release_volumes(scene_->graph);
  if (parallel::all_ranks() != nullptr) scene_->mesh.mesh = {};  // each rank has its own cells
  s.solver_bytes = scene_->solver->bytes();
  s.building_rss_bytes = memory_.peak();
  note_running_memory();
  s.setup_seconds = seconds_since(start_);
  try {
    s.status = run::status_of(simulation_->run());
  } catch (...) {  // of an observer, which may have been closing a file after a breakdown
    note_breakdown();
    throw;
  }
  note_breakdown();
  finish();
}

/// Arrays are there once they are written to: after a step.
void CaseRun::note_running_memory() {
  result_.summary.running_rss_bytes = memory_.settled();
  note_memory(*scene_, result_.summary);
}

void CaseRun::note_breakdown() {
  if (!simulation_->breakdown()) return;
  io::RunSummary& s = result_.summary;
  s.status = run::status_of(run::Ending::breakdown);
  s.failure = failure_of(*simulation_->breakdown(), *scene_->solver, scene_->graph,
                         simulation_->totals().begun, scene_->mesh.order);
  const io::FrameEntry frame = observers_->last_frame();
  if (frame.path.empty()) return;
  s.failure->message += fmt::format("\n  the last state that was kept, of time {:.6g} s, is in {}",
                                    frame.time, frame.path);
}

/// Far below what stops a run much of its energy may have gone into the mesh; shocks dissipate, of
/// which limiters tell.
void CaseRun::note_dissipation() {
  constexpr double worth_telling = 0.1;
  io::RunSummary& s = result_.summary;
  const bool is_meant = scheme::limits_slopes(scheme::limiter_menu().at(setup_.scheme.limiter)) ||
                        setup_.guards.numerical_dissipation != 0;
  if (is_meant || result_.history.empty()) return;
  const double share = numerical_share(s);
  const double caught = s.largest_energy > 0 ? s.contact_loss / s.largest_energy : 0;
  const double of_mobile =
      s.mobile_energy > 0 ? s.energy.numerical_dissipation / s.mobile_energy : 0;
  std::string took;
  if (share + caught > worth_telling) {
    took = fmt::format(
        "{:.2g} of the largest energy{}", share,
        caught > 0.01 ? fmt::format(", walls {:.2g} as they caught nodes", caught) : "");
  } else if (of_mobile > worth_telling) {
    took = fmt::format(
        "{:.2g} of what the body moves with ({:.3g} J; strain energy that was there "
        "all the time apart)",
        of_mobile, s.mobile_energy);
  }
  if (took.empty()) return;
  s.notices.push_back(
      fmt::format("numerical dissipation took {}: the mesh hardly resolves the "
                  "motion; see how much a finer one changes (--level, converge)",
                  took));
  tell(s.notices.back());
}

/// Where a body stays at rest, or moves so little that nothing can be said of its energies.
std::optional<std::string> CaseRun::notice_of_little_motion() const {
  const double rounding = observers_->energy_rounding();
  double kinetic = 0, strain = 0;
  for (const io::HistoryRow& row : result_.history) {
    kinetic = std::max(kinetic, row.energy.kinetic);
    strain = std::max(strain, std::abs(row.energy.strain));
  }
  if (std::max(kinetic, strain) > rounding) return std::nullopt;
  if (kinetic <= 1e-12 * rounding) {
    if (!result_.summary.is_ended()) return std::nullopt;  // it may be to come
    return "nothing moves the body: its loads, velocities and displacements are zero where it is, "
           "or come after the end";
  }
  return fmt::format(
      "strains are so small that strain energy is what rounding leaves of it (up to {:.1g} J), and "
      "neither the energy budget nor its guards say anything; scale loads or velocities up",
      rounding);
}

void CaseRun::note_contradictions() {
  for (const auto& notice : {observers_->notice_of_walls(), observers_->notice_of_sliding(),
                             observers_->notice_of_cells(), observers_->notice_of_exact(),
                             observers_->notice_of_volumes(), notice_of_little_motion()}) {
    if (!notice) continue;
    result_.summary.notices.push_back(*notice);
    tell(*notice);
  }
}

/// What the run cost.
void CaseRun::measure() {
  io::RunSummary& s = result_.summary;
  if (simulation_ && simulation_->totals().begun > 0) {
    const run::StepTotals& totals = simulation_->totals();
    s.steps = totals.steps;
    s.rejected_steps = totals.rejected;
    s.dt_min = totals.dt_min;
    s.dt_max = totals.dt_max;
    s.min_jacobian = totals.least_J;
    s.loop_seconds = totals.seconds;
  }
  s.stages = s.steps * scene_->solver->evaluations_per_step();
  const scheme::Interventions& acts = scene_->solver->interventions();
  s.projections = acts.projections;
  s.resynchronisations = acts.resynchronisations;
  s.limited_pairs = acts.limited_pairs;
  s.end_time = scene_->solver->time();
  s.wall_seconds = seconds_before_ + seconds_since(start_);
  s.peak_rss_bytes = memory_.peak();
  if (s.stages == 0) return;
  s.nanoseconds_per_node_stage =
      1e9 * s.loop_seconds / (static_cast<double>(s.stages) * static_cast<double>(s.nodes));
  const double crossings = s.end_time * scene_->solver->undeformed_speed() / s.spacing;
  s.nanoseconds_per_node_crossing =
      1e9 * s.loop_seconds / (crossings * static_cast<double>(s.nodes));
}

void CaseRun::finish() {
  io::RunSummary& s = result_.summary;
  measure();
  s.state_hash = scene_->solver->state_hash(scene_->mesh.order);
  note_ranks(*scene_, s);
  observers_->give(result_);
  if (options_.final_state || !options_.measures.empty())
    result_.final_state = simulation_->take_state();
  result_.order = std::move(scene_->mesh.order);
  result_.graph = std::move(scene_->graph);
  note_contradictions();
  if (s.status == "done") {
    note_dissipation();
    s.unmet = unmet_of(setup_.expect, s, result_.history);
    if (!s.unmet.empty()) s.status = "unmet";
    if (s.most_inverted_cells > 0) s.status = "unsound";
  }
  if (s.is_ended()) {
    s.measures = measured(options_.measures, {result_.graph, result_.final_state, final_errors()});
  }
  folder_.close(result_);
}

/// At each node, for measures.
std::map<std::string, std::vector<double>> CaseRun::final_errors() const {
  if (options_.measures.empty() || !run::ExactSurvey::is_for(setup_)) return {};
  const run::Solver& solver = *scene_->solver;
  const scheme::Snapshot& state = result_.final_state;
  std::optional<scheme::Snapshot> exact = solver.exact_state(state.time);
  if (!exact) {
    const auto stress = [&](const algebra::Mat3& F) { return solver.equilibrium_stress(F); };
    exact = run::ExactFields(setup_, result_.graph.X, run::length_of(result_.graph), stress)
                .at(state.time);
  }
  return run::nodal_errors(setup_, state, *exact);
}

void CaseRun::fail(const std::string& message) noexcept {
  io::RunSummary& s = result_.summary;
  measure();
  if (s.status != "breakdown") {
    s.status = "failed";
    s.failure = io::RunFailure{message, s.end_time, s.steps, {}, {}};
  }
  folder_.close_failed(s);
}

}  // namespace

RunResult attempt_case(const cases::Case& setup, const RunOptions& options) {
  CaseRun run(setup, options);
  try {
    run.go();
  } catch (const std::bad_alloc&) {
    run.fail("out of memory; use a smaller --level");
    throw;
  } catch (const std::exception& error) {
    run.fail(error.what());
    throw;
  }
  return run.take();
}

RunResult run_case(const cases::Case& setup, const RunOptions& options) {
  RunResult result = attempt_case(setup, options);
  if (result.summary.status == "breakdown") {
    throw base::BreakdownError(fmt::format("{} level {}: {}", options.column(), options.level,
                                           result.summary.failure->message));
  }
  return result;
}

}  // namespace diptych::harness
