#include "benchmarks/run/case_check.hpp"

#include "benchmarks/run/case_observers.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/scene.hpp"
#include "common/base/error.hpp"
#include "common/run/probes.hpp"
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

/// Mean time of a step, over `timing` seconds of them  [s]. A scene that breaks down is timed as
/// far as it comes: that it does is what a run tells, not this check.
double step_seconds(run::Solver& solver, double end, double timing) {
  const auto start = Clock::now();
  int n = 0;
  do {
    ++n;
    try {
      solver.step(end);
    } catch (const base::BreakdownError&) {
      break;
    }
  } while (seconds_since(start) < timing && solver.time() < end && !interrupt_requested());
  return seconds_since(start) / n;
}

}  // namespace

CaseCheck check_case(const cases::Case& setup,
                     const std::string& method,
                     int level,
                     double timing) {
  CaseCheck check;
  const auto start = Clock::now();
  const std::int64_t before = settled_memory();
  reset_peak_rss();
  Scene scene(setup, method, level, GraphPairs::released,
              [&](ScenePart part, const CaseGraph& made) {
                if (part != ScenePart::graph) return;
                check.quality = scheme::quality(made.graph);
                check.pairs = made.graph.n_pairs();
              });
  run::Solver& solver = *scene.solver;
  check.building_bytes = peak_rss_bytes() - before;
  meshes::Mesh& mesh = scene.mesh.mesh;
  check.estimated_bytes = setup.mesh.file.empty() ? estimate_memory(setup, method, level).bytes
                                                  : estimate_memory(setup, method, mesh).bytes;
  check.operators = scene.operators;
  check.notices = scene.notices;
  check.nodes = scene.graph.n_nodes();
  check.cells = mesh.n_cells();
  check.bytes = solver.bytes();
  (void)run::Probes(setup.probes, scene.graph, mesh_around(mesh));  // has their places
  scheme::release_volumes(scene.graph);
  mesh = {};
  check.running_bytes = settled_memory() - before;
  check.setup_seconds = seconds_since(start);
  const run::StepReport report = solver.step(setup.time.end);
  check.dt = report.dt;
  check.steps =
      static_cast<std::int64_t>(std::min(9e18, std::ceil(setup.time.end / report.dt - 1e-9)));
  if (setup.time.max_steps > 0) check.steps = std::min(check.steps, setup.time.max_steps);
  if (solver.time() < setup.time.end) {
    check.seconds = static_cast<double>(check.steps) * step_seconds(solver, setup.time.end, timing);
  }
  return check;
}

}  // namespace diptych::harness
