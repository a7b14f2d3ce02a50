#include "benchmarks/harness/run_case.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/energy_record.hpp"
#include "benchmarks/harness/exact_record.hpp"
#include "benchmarks/harness/frame_fields.hpp"
#include "benchmarks/harness/memory.hpp"
#include "benchmarks/harness/memory_estimate.hpp"
#include "benchmarks/harness/progress.hpp"
#include "benchmarks/harness/provenance.hpp"
#include "benchmarks/harness/quantities.hpp"
#include "benchmarks/harness/resumption.hpp"
#include "benchmarks/harness/shape_recorder.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/exact_errors.hpp"
#include "common/run/field_norms.hpp"
#include "common/run/probes.hpp"
#include "meshes/deformed_cells.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace diptych::harness {

namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Writes, counts and measures at the output times of a run.
class Recorder {
 public:
  Recorder(const run::Case& setup,
           const RunOptions& options,
           const CaseMesh& mesh,
           run::Solver& solver,
           RunResult& result)
      : setup_(setup),
        options_(options),
        solver_(solver),
        result_(result),
        errors_(setup, result.graph, solver),
        probes_(setup.probes, result.graph),
        exact_(setup, result.graph, probes_),
        initial_(solver.balance()),
        energy_(initial_),
        cells_(mesh.mesh) {
    if (!options.directory.empty() && options.fields && setup.output.fields) {
      writer_ = std::make_unique<io::FieldWriter>(options.directory, visual_mesh(mesh));
    }
    if (options.shapes) {
      const auto n_outputs = static_cast<size_t>(setup.output.frames) + 1;
      shapes_ = std::make_unique<ShapeRecorder>(mesh.mesh, n_outputs);
    }
  }

  void record(const run::StepReport& step) {
    const scheme::Balance balance = solver_.balance();
    const scheme::Audit& audit = solver_.audit();
    io::HistoryRow row;
    row.time = solver_.time();
    row.step = step.step;
    row.dt = step.dt;
    row.energy = energy_.at(balance, audit);
    for (int i = 0; i < 3; ++i) {
      row.linear_momentum[i] = balance.linear_momentum[i];
      row.angular_momentum[i] = balance.angular_momentum[i];
    }
    row.min_jacobian = balance.least_J;
    row.involution_H = balance.involution_H;
    row.involution_J = balance.involution_J;
    if (!probes_.empty()) row.probes = probes_.values(solver_);
    result_.history.push_back(row);
    update_drifts(balance, audit);
    run::Snapshot snapshot = solver_.snapshot();
    check_cells(snapshot);
    const bool keeps_shape = shapes_ && shapes_->wants(result_.history.size() - 1);
    if (options_.scales) raise_scales(run::field_norms(result_.graph, snapshot));
    if (errors_.available()) {
      errors_.measure(snapshot);
      exact_.take(errors_.exact());
    }
    if (writer_) write_fields(snapshot);
    if (keeps_shape) shapes_->take(snapshot, row.time);
    result_.final_state = std::move(snapshot);
  }

  /// After every step.
  void record_step(const run::StepReport& step) {
    if (!probes_.has_stepped()) return;
    result_.steps.push_back({step.time, step.step, probes_.stepped_values(solver_)});
  }
  const std::map<std::string, std::vector<double>>& errors() const { return errors_.nodal(); }

  double energy_residual() {
    return energy_.at(solver_.balance(), solver_.audit()).relative_residual;
  }

  void fill(io::RunSummary& s) const {
    s.errors = errors_.relative();
    s.energy = result_.history.back().energy;
    s.linear_momentum_drift = linear_drift_;
    s.angular_momentum_drift = angular_drift_;
    s.quantities = quantities_of(setup_.probes, result_);
    s.least_cell_J = least_cell_J_;
    s.most_inverted_cells = most_inverted_cells_;
    s.inverted_from = inverted_from_;
    if (shapes_) result_.shapes = shapes_->record();
    result_.exact = exact_.columns();
    if (options_.scales) {
      for (const auto& [field, norm] : errors_.scales())  // of errors too, where there are any
        result_.scales[field] = norm;
    }
    for (const io::HistoryRow& row : result_.history) {
      s.involution_H = std::max(s.involution_H, row.involution_H);
      s.involution_J = std::max(s.involution_J, row.involution_J);
    }
  }

 private:
  void raise_scales(const std::map<std::string, double>& norms) {
    for (const auto& [field, norm] : norms)
      result_.scales[field] = std::max(result_.scales[field], norm);
  }

  /// Largest change of momentum beyond the impulse of loads and constraints, relative to sum |p|.
  void update_drifts(const scheme::Balance& now, const scheme::Audit& audit) {
    momentum_scale_ = std::max(momentum_scale_, now.momentum_scale);
    angular_scale_ = std::max(angular_scale_, now.angular_scale);
    const auto drift = [](const algebra::Vec3& p, double scale) {
      return scale > 0 ? p.norm() / scale : 0;
    };
    const algebra::Vec3 p = now.linear_momentum - initial_.linear_momentum - audit.impulse.linear;
    const algebra::Vec3 L =
        now.angular_momentum - initial_.angular_momentum - audit.impulse.angular;
    linear_drift_ = std::max(linear_drift_, drift(p, momentum_scale_));
    angular_drift_ = std::max(angular_drift_, drift(L, angular_scale_));
  }

  void check_cells(const run::Snapshot& state) {
    const auto least = cells_.least(state.u);
    io::HistoryRow& row = result_.history.back();
    row.least_cell_J = least.J;
    least_cell_J_ = std::min(least_cell_J_, least.J);
    most_inverted_cells_ = std::max(most_inverted_cells_, least.n_inverted);
    if (least.n_inverted > 0 && !inverted_from_) inverted_from_ = row.time;
  }

  void write_fields(const run::Snapshot& s) {
    std::vector<io::NamedValue> values;
    const std::vector<double>& probes = result_.history.back().probes;
    for (size_t k = 0; k < probes.size(); ++k)
      values.push_back({setup_.probes[k].column(), probes[k]});
    writer_->write(s.time, frame_fields(s, result_.order), values);
  }

  const run::Case& setup_;
  const RunOptions& options_;
  run::Solver& solver_;
  RunResult& result_;
  run::ExactErrors errors_;
  run::Probes probes_;
  ExactRecord exact_;
  scheme::Balance initial_;
  EnergyRecord energy_;
  meshes::DeformedCells cells_;
  std::unique_ptr<io::FieldWriter> writer_;
  std::unique_ptr<ShapeRecorder> shapes_;
  double momentum_scale_ = 0, angular_scale_ = 0, linear_drift_ = 0, angular_drift_ = 0;
  double least_cell_J_ = 1e300;
  std::int64_t most_inverted_cells_ = 0;
  std::optional<double> inverted_from_;
};

void describe_graph(const scheme::PairGraph& graph, io::RunSummary& s) {
  const scheme::GraphQuality q = scheme::quality(graph);
  s.nodes = graph.n_nodes();
  s.pairs = graph.n_pairs();
  s.dimension = graph.dimension;
  s.mean_neighbours = q.mean_neighbours;
  s.graph_closure = q.closure;
  s.graph_linear_exactness = q.linear_exactness;
  // of the interior nodes: those on the boundary have only a part of their cell inside
  double inside = 0, all = 0;
  std::int64_t n = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    all += graph.Omega[a];
    if (!graph.boundary_area[a].isZero()) continue;
    inside += graph.Omega[a];
    ++n;
  }
  const double mean =
      n > 0 ? inside / static_cast<double>(n) : all / static_cast<double>(graph.n_nodes());
  s.spacing = std::pow(mean, 1.0 / graph.dimension);
}

/// Steps to the end; time in the loop without output is summed in s.loop_seconds.
void advance(const run::Case& setup,
             const RunOptions& options,
             run::Solver& solver,
             Recorder& recorder,
             io::RunSummary& s) {
  Progress progress(fmt::format("{} level {}", options.method, options.level), setup.time.end,
                    options.quiet, options.schedule);
  run::StepReport report;
  report.step = 0;
  recorder.record(report);
  recorder.record_step(report);
  s.dt_min = 1e300;
  s.min_jacobian = 1e300;
  for (int frame = 1; frame <= setup.output.frames; ++frame) {
    const bool final_frame = frame == setup.output.frames;
    const double limit =
        final_frame ? setup.time.end : setup.time.end * frame / setup.output.frames;
    while (solver.time() < limit && !interrupt_requested()) {
      const auto start = Clock::now();
      report = solver.step(limit);
      s.loop_seconds += seconds_since(start);
      s.steps = report.step;
      s.dt_min = std::min(s.dt_min, report.dt);
      s.dt_max = std::max(s.dt_max, report.dt);
      s.min_jacobian = std::min(s.min_jacobian, report.least_J);
      recorder.record_step(report);
      if (progress.due()) {
        progress.show(solver.time(), report.step, report.dt, recorder.energy_residual());
      }
      if (setup.time.max_steps > 0 && report.step >= setup.time.max_steps) break;
    }
    recorder.record(report);
    if (interrupt_requested()) s.status = "interrupted";
    if (setup.time.max_steps > 0 && report.step >= setup.time.max_steps &&
        solver.time() < setup.time.end) {
      s.status = "step limit";
    }
    if (s.status != "done") break;
  }
}

/// Leaves word that a run is under way here: until it is over, no one takes what lies in its folder
/// for a result.
void announce(const RunOptions& options, io::RunSummary summary) {
  if (options.directory.empty()) return;
  summary.status = "running";
  io::write_file_atomically((std::filesystem::path(options.directory) / "summary.json").string(),
                            io::to_json(summary));
}

void write_record(const run::Case& setup, const RunOptions& options, const RunResult& result) {
  if (options.directory.empty()) return;
  const std::filesystem::path directory = options.directory;
  io::write_file_atomically((directory / "history.csv").string(),
                            io::history_csv(result.history, probe_columns(setup, false)));
  std::filesystem::remove(directory / "exact.csv");  // of an earlier run of another case
  if (!result.exact.empty()) {
    io::write_file_atomically((directory / "exact.csv").string(), io::columns_csv(result.exact));
  }
  const std::vector<std::string> stepped = probe_columns(setup, true);
  if (!stepped.empty()) {
    io::write_file_atomically((directory / "steps.csv").string(),
                              io::steps_csv(result.steps, stepped));
  }
  io::write_file_atomically((directory / "summary.json").string(), io::to_json(result.summary));
}

}  // namespace

void request_interrupt() {
  interrupt_flag = 1;
}

bool interrupt_requested() {
  return interrupt_flag != 0;
}

void claim_directory(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path = directory;
  if (fs::exists(path, error)) {
    if (!fs::is_directory(path, error)) {
      throw base::InputError(directory + ": is not a folder; give another --out");
    }
    if (!fs::is_empty(path, error) && !fs::exists(path / "summary.json")) {
      throw base::InputError(directory +
                             ": holds files that no run of diptych made; give another --out");
    }
  }
  fs::create_directories(path, error);
  if (error) {
    throw base::EnvironmentError(directory + ": cannot be created: " + error.message());
  }
}

RunResult run_case(const run::Case& setup, const RunOptions& options) {
  const auto start = Clock::now();
  const RunMemory memory;
  parallel::set_threads(options.threads);
  RunResult result;
  io::RunSummary& s = result.summary;
  require_memory(setup, {options.method}, {options.level});
  CaseMesh mesh = mesh_of(setup, options.level);
  require_memory(setup, options.method, options.level, mesh.mesh);
  result.graph = method_menu().at(options.method)(mesh.mesh, setup);
  const auto solver = run::make_solver(setup, result.graph);
  if (!options.directory.empty()) claim_directory(options.directory);
  s.method = options.method;
  s.case_name = setup.name;
  s.title = setup.title;
  s.level = options.level;
  s.threads = parallel::n_threads();
  s.integrator = setup.time.integrator;
  s.precision = setup.scheme.precision;
  s.unknowns_per_node = solver->unknowns_per_node();
  s.arrangement = solver->arrangement();
  s.provenance = provenance(setup.hash);
  s.provenance.input_hash = input_hash(setup, options.measures);
  describe_graph(result.graph, s);
  Recorder recorder(setup, options, mesh, *solver, result);
  // from here on the solver's arrays are all that is needed, and the nodes
  result.order = std::move(mesh.order);
  release_pairs(result.graph);
  s.solver_bytes = solver->bytes();
  s.building_rss_bytes = memory.peak();
  s.running_rss_bytes = memory.settled();
  announce(options, s);
  s.setup_seconds = seconds_since(start);
  const auto finish = [&] {
    s.stages = s.steps * solver->evaluations_per_step();
    s.end_time = solver->time();
    s.wall_seconds = seconds_since(start);
    s.peak_rss_bytes = memory.peak();
    if (s.stages > 0) {
      s.nanoseconds_per_node_stage =
          1e9 * s.loop_seconds / (static_cast<double>(s.stages) * static_cast<double>(s.nodes));
      const double crossings = s.end_time * solver->undeformed_speed() / s.spacing;
      s.nanoseconds_per_node_crossing =
          1e9 * s.loop_seconds / (crossings * static_cast<double>(s.nodes));
    }
    s.state_hash = solver->state_hash(result.order);
    recorder.fill(s);
    if (s.status == "done")
      s.measures =
          measured(options.measures, {result.graph, result.final_state, recorder.errors()});
    write_record(setup, options, result);
  };
  try {
    advance(setup, options, *solver, recorder, s);
  } catch (const base::BreakdownError& error) {
    s.status = "breakdown";
    finish();
    throw base::BreakdownError(
        fmt::format("{} level {}: {}", options.method, options.level, error.what()));
  }
  finish();
  return result;
}

namespace {

constexpr double timing_seconds = 0.5;

/// Mean time of a step, over half a second of them  [s]
double step_seconds(run::Solver& solver, double end) {
  const auto start = Clock::now();
  int n = 0;
  do {
    solver.step(end);
    ++n;
  } while (seconds_since(start) < timing_seconds && solver.time() < end && !interrupt_requested());
  return seconds_since(start) / n;
}

}  // namespace

CaseCheck check_case(const run::Case& setup, const std::string& method, int level) {
  CaseCheck check;
  const auto start = Clock::now();
  require_memory(setup, {method}, {level});
  const std::int64_t before = settled_memory();
  reset_peak_rss();
  CaseMesh mesh = mesh_of(setup, level);
  require_memory(setup, method, level, mesh.mesh);
  check.estimated_bytes = setup.mesh.file.empty() ? estimate_memory(setup, method, level).bytes
                                                  : estimate_memory(setup, method, mesh.mesh).bytes;
  scheme::PairGraph graph = method_menu().at(method)(mesh.mesh, setup);
  check.quality = scheme::quality(graph);
  check.nodes = graph.n_nodes();
  check.cells = mesh.mesh.n_cells();
  check.pairs = graph.n_pairs();
  const auto solver = run::make_solver(setup, graph);
  check.bytes = solver->bytes();
  check.building_bytes = peak_rss_bytes() - before;
  release_pairs(graph);
  mesh.mesh = {};
  check.running_bytes = settled_memory() - before;
  check.setup_seconds = seconds_since(start);
  const run::StepReport report = solver->step(setup.time.end);
  check.dt = report.dt;
  check.steps =
      static_cast<std::int64_t>(std::min(9e18, std::ceil(setup.time.end / report.dt - 1e-9)));
  if (setup.time.max_steps > 0) check.steps = std::min(check.steps, setup.time.max_steps);
  if (solver->time() < setup.time.end) {
    check.seconds = static_cast<double>(check.steps) * step_seconds(*solver, setup.time.end);
  }
  return check;
}

}  // namespace diptych::harness
