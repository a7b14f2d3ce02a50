#include "benchmarks/run/run_case.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/breakdown_place.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/run/recorder.hpp"
#include "benchmarks/run/resumption.hpp"
#include "benchmarks/run/run_folder.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/thread_count.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <new>
#include <optional>
#include <utility>

namespace diptych::harness {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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

/// What the graph is made of, and a line for the log where that is less than was asked for.
void describe_operators(const meshes::Mesh& mesh,
                        const cases::Case& setup,
                        const RunOptions& options,
                        io::RunSummary& s) {
  const GraphDescription description = graph_description(options.method, mesh, setup);
  s.graph_operators = description.operators;
  if (options.quiet) return;
  for (const std::string& notice : description.notices)
    std::fputs(fmt::format("{} level {}: {}\n", options.method, options.level, notice).c_str(),
               stderr);
}

/// Steps to the end; time in the loop without output is summed in s.loop_seconds.
void advance(const cases::Case& setup,
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
  void measure();
  void finish();

  Clock::time_point start_ = Clock::now();
  RunMemory memory_;
  const cases::Case& setup_;
  const RunOptions& options_;
  RunFolder folder_;
  RunResult result_;
  std::optional<CaseMesh> mesh_;
  std::unique_ptr<run::Solver> solver_;
  std::optional<Recorder> recorder_;
};

CaseRun::CaseRun(const cases::Case& setup, const RunOptions& options)
    : setup_(setup), options_(options), folder_(options.directory) {
  parallel::set_threads(options.threads);
  require_memory(setup, {options.method}, {options.level});
  mesh_ = mesh_of(setup, options.level);
  require_memory(setup, options.method, options.level, mesh_->mesh);
  result_.graph = method_menu().at(options.method)(mesh_->mesh, setup);
  solver_ = run::make_solver(setup, result_.graph);
  identify();
  describe_graph(result_.graph, result_.summary);
  describe_operators(mesh_->mesh, setup, options, result_.summary);
  recorder_.emplace(setup, options, *mesh_, *solver_, result_);
  folder_.check();
  if (folder_.is_written() && options.before_writing) options.before_writing();
  folder_.open(setup, result_.summary);
}

void CaseRun::identify() {
  io::RunSummary& s = result_.summary;
  s.method = options_.method;
  s.case_name = setup_.name;
  s.case_file = setup_.file;
  s.title = setup_.title;
  s.level = options_.level;
  s.threads = parallel::running_threads();
  s.integrator = setup_.time.integrator;
  s.precision = setup_.scheme.precision;
  s.unknowns_per_node = solver_->unknowns_per_node();
  s.arrangement = solver_->arrangement();
  s.provenance = provenance(setup_.hash);
  s.provenance.input_hash = input_hash(setup_, options_.measures);
}

void CaseRun::go() {
  io::RunSummary& s = result_.summary;
  recorder_->open(*mesh_);
  // from here on the solver's arrays are all that is needed, and the nodes
  result_.order = std::move(mesh_->order);
  release_pairs(result_.graph);
  s.solver_bytes = solver_->bytes();
  s.building_rss_bytes = memory_.peak();
  s.running_rss_bytes = memory_.settled();
  s.setup_seconds = seconds_since(start_);
  try {
    advance(setup_, options_, *solver_, *recorder_, s);
  } catch (const base::BreakdownError& error) {
    s.status = "breakdown";
    s.failure = failure_of(error, *solver_, result_.graph, s.steps, result_.order);
  }
  finish();
}

/// What the run cost.
void CaseRun::measure() {
  io::RunSummary& s = result_.summary;
  s.stages = s.steps * solver_->evaluations_per_step();
  s.end_time = solver_->time();
  s.wall_seconds = seconds_since(start_);
  s.peak_rss_bytes = memory_.peak();
  if (s.stages == 0) return;
  s.nanoseconds_per_node_stage =
      1e9 * s.loop_seconds / (static_cast<double>(s.stages) * static_cast<double>(s.nodes));
  const double crossings = s.end_time * solver_->undeformed_speed() / s.spacing;
  s.nanoseconds_per_node_crossing =
      1e9 * s.loop_seconds / (crossings * static_cast<double>(s.nodes));
}

void CaseRun::finish() {
  io::RunSummary& s = result_.summary;
  measure();
  s.state_hash = solver_->state_hash(result_.order);
  recorder_->finish();
  if (!result_.history.empty()) recorder_->fill(s);
  if (s.status == "done") {
    s.measures =
        measured(options_.measures, {result_.graph, result_.final_state, recorder_->errors()});
  }
  folder_.close(result_);
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
    throw base::BreakdownError(fmt::format("{} level {}: {}", options.method, options.level,
                                           result.summary.failure->message));
  }
  return result;
}

}  // namespace diptych::harness
