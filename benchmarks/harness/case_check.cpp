#include "benchmarks/harness/case_check.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/memory.hpp"
#include "common/run/solver.hpp"

#include <cmath>
#include <filesystem>

namespace diptych::harness {

CaseCheck check_case(const run::Case& setup, const std::string& method, int level) {
  CaseCheck check;
  const std::int64_t before = settled_memory();
  reset_peak_rss();
  CaseMesh mesh = mesh_of(setup, level, std::filesystem::temp_directory_path().string());
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
  const run::StepReport report = solver->step(setup.time.end);
  check.dt = report.dt;
  check.steps = static_cast<std::int64_t>(std::ceil(setup.time.end / report.dt - 1e-9));
  return check;
}

}  // namespace diptych::harness
