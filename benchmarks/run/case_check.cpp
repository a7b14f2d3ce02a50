#include "benchmarks/run/case_check.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "common/run/solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace diptych::harness {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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

CaseCheck check_case(const cases::Case& setup, const std::string& method, int level) {
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
  check.operators = graph_description(method, mesh.mesh, setup).operators;
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
