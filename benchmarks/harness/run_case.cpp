#include "benchmarks/harness/run_case.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/harness/memory.hpp"
#include "benchmarks/harness/progress.hpp"
#include "benchmarks/harness/provenance.hpp"
#include "benchmarks/harness/recorder.hpp"
#include "benchmarks/harness/resumption.hpp"
#include "benchmarks/harness/run_folder.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

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

/// Steps to the end; time in the loop without output is summed in s.loop_seconds.
void advance(const run::Case& setup,
             const RunOptions& options,
             run::Solver& solver,
             Recorder& recorder,
             io::RunSummary& s) {
  Progress progress(fmt::format("{} level {}", options.method, options.level), setup.time.end,
                    options.quiet);
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

}  // namespace

RunResult run_case(const run::Case& setup, const RunOptions& options) {
  const auto start = Clock::now();
  reset_peak_rss();
  parallel::set_threads(options.threads);
  RunResult result;
  io::RunSummary& s = result.summary;
  CaseMesh mesh = mesh_of(setup, options.level, std::filesystem::temp_directory_path().string());
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
  s.building_rss_bytes = peak_rss_bytes();
  s.running_rss_bytes = settled_memory();
  announce(options, s);
  s.setup_seconds = seconds_since(start);
  const auto finish = [&] {
    s.stages = s.steps * solver->evaluations_per_step();
    s.end_time = solver->time();
    s.wall_seconds = seconds_since(start);
    s.peak_rss_bytes = peak_rss_bytes();
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

}  // namespace diptych::harness
