#include "benchmarks/cost/size_costs.hpp"

#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/scene.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/solver.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

constexpr char scene_text[] = R"toml(
[mesh]
element = "{}"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [{}, {}, {}]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[initial]
velocity = ["sin(3*y)", "cos(2*x)", 0]
[time]
end = 1
integrator = "leapfrog"
)toml";

struct Graph {
  const char* name;
  const char* method;
  const char* element;
};
constexpr Graph graphs[] = {{"SPH", "sph", "hexahedron"},
                            {"FVM hexahedra", "fvm", "hexahedron"},
                            {"FVM tetrahedra", "fvm", "tetrahedron"}};

/// At least this much work is timed, in steps.
constexpr double least_node_steps = 3e6;
constexpr int least_steps = 12;

SizeRow measured(const Graph& kind, int side, const std::vector<std::string>& overrides) {
  const std::string text = fmt::format(scene_text, kind.element, side - 1, side - 1, side - 1);
  const cases::Case setup = cases::case_from_text(text, "sizes", overrides);
  SizeRow row;
  row.graph = kind.name;
  const std::int64_t before = settled_memory();
  reset_peak_rss();
  const int threads = parallel::n_threads();
  double start = probes::seconds(threads);
  const auto lap = [&] {
    const double now = probes::seconds(threads), taken = now - start;
    start = now;
    return taken;
  };
  const auto made = [&](ScenePart part, const CaseGraph& scene) {
    (part == ScenePart::mesh    ? row.mesh_seconds
     : part == ScenePart::graph ? row.graph_seconds
                                : row.solver_seconds) = lap();
    if (part == ScenePart::graph) row.pairs = scene.graph.n_pairs();
  };
  Scene scene(setup, kind.method, 0, GraphPairs::released, made);
  run::Solver& solver = *scene.solver;
  row.nodes = scene.graph.n_nodes();
  const auto n = static_cast<double>(row.nodes);
  row.building = static_cast<double>(peak_rss_bytes() - before) / n;
  scheme::release_volumes(scene.graph);
  scene.mesh.mesh = {};
  row.counted = static_cast<double>(solver.bytes()) / n;
  row.step_seconds = std::numeric_limits<double>::infinity();
  const int n_steps = std::max(least_steps, static_cast<int>(least_node_steps / n));
  solver.step(1e6);  // pages and caches
  row.running = static_cast<double>(settled_memory() - before) / n;
  for (int i = 0; i < n_steps && !interrupt_requested(); ++i) {
    lap();
    solver.step(1e6);
    row.step_seconds = std::min(row.step_seconds, lap());
  }
  row.stage_ns = 1e9 * row.step_seconds / (n * solver.evaluations_per_step());
  return row;
}

/// The first row of the same graph.
const SizeRow& smallest(const std::vector<SizeRow>& rows, const SizeRow& row) {
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const SizeRow& r) { return r.graph == row.graph; });
}

}  // namespace

std::vector<SizeRow> measure_size_costs(const SizeRequest& request) {
  for (const int side : request.sides) {
    if (side < 3 || side > 1000) {
      throw base::InputError(
          fmt::format("--sizes {}: nodes along the side of a cube; use 3 to 1000", side));
    }
  }
  parallel::set_threads(request.threads);
  StatusLine status(request.quiet);
  std::vector<SizeRow> rows;
  for (const Graph& graph : graphs) {
    for (const int side : request.sides) {
      if (interrupt_requested()) return rows;
      status.show(fmt::format("{}, {}^3 nodes", graph.name, side));
      rows.push_back(measured(graph, side, request.overrides));
    }
    status.keep(fmt::format("{} done", graph.name));
  }
  return rows;
}

std::string size_text(const std::vector<SizeRow>& rows) {
  std::string text =
      fmt::format("{:<15}{:>9}{:>6}{:>9}{:>7}{:>8}{:>8}{:>7}{:>8}{:>8}{:>9}\n", "", "", "pairs",
                  "ns/node", "", "graph", "solver", "in", "counted", "running", "building");
  text +=
      fmt::format("{:<15}{:>9}{:>6}{:>9}{:>7}{:>8}{:>8}{:>7}{:>8}{:>8}{:>9}\n", "graph", "nodes",
                  "/node", "& stage", "ratio", "s", "s", "steps", "B/node", "B/node", "B/node");
  text.append(94, '-');
  text += "\n";
  for (const SizeRow& row : rows) {
    text += fmt::format(
        "{:<15}{:>9}{:>6.1f}{:>9.1f}{:>7.2f}{:>8.3f}{:>8.3f}{:>7.1f}{:>8.0f}{:>8.0f}{:>9.0f}\n",
        row.graph, row.nodes, static_cast<double>(row.pairs) / static_cast<double>(row.nodes),
        row.stage_ns, row.stage_ns / smallest(rows, row).stage_ns, row.graph_seconds,
        row.solver_seconds, row.setup_steps(), row.counted, row.running, row.building);
  }
  return text;
}

std::string size_csv(const std::vector<SizeRow>& rows) {
  std::string csv =
      "graph,nodes,pairs,stage [ns/node],mesh [s],graph [s],solver [s],step [s],counted [B/node],"
      "running [B/node],building [B/node]\n";
  for (const SizeRow& row : rows) {
    csv +=
        fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.graph,
                    row.nodes, row.pairs, row.stage_ns, row.mesh_seconds, row.graph_seconds,
                    row.solver_seconds, row.step_seconds, row.counted, row.running, row.building);
  }
  return csv;
}

}  // namespace diptych::harness
