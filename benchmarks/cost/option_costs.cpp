#include "benchmarks/cost/option_costs.hpp"

#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/scene.hpp"
#include "benchmarks/terminal/status_line.hpp"
#include "common/cases/reader.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/solver.hpp"
#include "common/time/step_begin.hpp"
#include "meshes/deformed_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>

namespace diptych::harness {

namespace {

constexpr char scene_text[] = R"toml(
[mesh]
element = "{element}"
lower = [0, 0{third}]
upper = [1, 1{third_upper}]
cells = [{n}, {n}{third_cells}]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
{motion}
[time]
end = 1
integrator = "ssp-rk3"
[scheme]
unknowns = "F"
reconstruction = "none"
)toml";

/// A body that moves by itself, or one that follows a motion with its body force.
constexpr char free_motion[] = "[initial]\nvelocity = [\"sin(3*y)\", \"cos(2*x)\"{third}]";
constexpr char known_motion[] =
    "[manufactured]\ndisplacement = [\"0.1*(1 - cos(20*t))*sin(2*x + 0.3)*cos(y)\", "
    "\"0.1*sin(20*t)*sin(2*y)*cos(x)\"{third}]";

enum class Work { stage, energies, cells, row, snapshot };

/// A row before it is measured: what it sets, on top of what the row `against` sets.
struct Option {
  const char* name;
  const char* against;
  std::vector<std::string> overrides;
  int n_branches = 0;
  Work work = Work::stage;
  int n = 4;  ///< steps, rows or sets of fields that are timed together
  bool manufactured = false;
};

std::vector<Option> options() {
  const std::string linear = "scheme.reconstruction=linear";
  const std::vector<std::string> mooney{"material.model=mooney-rivlin", "material.zeta_ratio=0.5"};
  const std::vector<std::string> leapfrog{"time.integrator=leapfrog"};
  constexpr int between_copies = time::StepBegin<3>::period;  // of what a step begins with
  const std::vector<std::string> second{"sph.gradient=corrected", "fvm.stencil=edge"},
      cells{"scheme.volumes=cells"};
  const auto with = [](std::vector<std::string> all, const std::string& more) {
    all.push_back(more);
    return all;
  };
  return {
      {"barest", "", {}},
      {"J evolved", "", {"scheme.unknowns=FJ"}},
      {"H and J evolved", "", {"scheme.unknowns=FHJ"}},
      {"angular-momentum projection", "", {"scheme.angular_momentum_projection=true"}},
      {"reconstruction", "", {linear}},
      {"limiter, on reconstruction", "reconstruction", {linear, "scheme.limiter=sign-preserving"}},
      {"objective reconstruction, on reconstruction",
       "reconstruction",
       {"scheme.reconstruction=objective"}},
      {"symmetric reconstruction, on reconstruction",
       "reconstruction",
       {"scheme.reconstruction=symmetric"}},
      {"exact impedance, on reconstruction", "reconstruction", {linear, "scheme.impedance=exact"}},
      {"face correction, on reconstruction",
       "reconstruction",
       {linear, "scheme.face_correction=1/6"}},
      {"second order", "", second},
      {"volumes of cells, on second order", "second order", with(cells, "scheme.cell_shear=0")},
      {"shear of cells, on volumes of cells", "volumes of cells, on second order", cells},
      {"single precision, on reconstruction",
       "reconstruction",
       {linear, "scheme.precision=single"}},
      {"Mooney-Rivlin", "", mooney},
      {"1 branch, on Mooney-Rivlin", "Mooney-Rivlin", mooney, 1},
      {"3 branches, on Mooney-Rivlin", "Mooney-Rivlin", mooney, 3},
      {"no retries", "", {"time.max_retries=0"}},
      {"no retries, 1 branch", "1 branch, on Mooney-Rivlin", with(mooney, "time.max_retries=0"), 1},
      {"leapfrog", "", leapfrog, 0, Work::stage, between_copies},
      {"no retries, leapfrog", "leapfrog", with(leapfrog, "time.max_retries=0"), 0, Work::stage,
       between_copies},
      {"manufactured motion", "", {}, 0, Work::stage, 4, true},
      {"manufactured motion, 1 branch", "1 branch, on Mooney-Rivlin", mooney, 1, Work::stage, 4,
       true},
      {"energies for the guards (each)", "leapfrog", leapfrog, 0, Work::energies},
      {"look at cells (each)", "leapfrog", leapfrog, 0, Work::cells},
      {"history row (each)", "leapfrog", leapfrog, 0, Work::row},
      {"fields for a frame (each)", "leapfrog", leapfrog, 0, Work::snapshot}};
}

std::string text_of(int dimension, int cells, bool manufactured) {
  using fmt::arg;
  const bool solid = dimension == 3;
  const int n = solid ? cells : static_cast<int>(std::lround(std::pow(cells + 1, 1.5))) - 1;
  return fmt::format(
      scene_text, arg("element", solid ? "hexahedron" : "quadrilateral"),
      arg("motion", fmt::format(fmt::runtime(manufactured ? known_motion : free_motion),
                                arg("third", solid ? ", 0" : ""))),
      arg("third", solid ? ", 0" : ""), arg("third_upper", solid ? ", 1" : ""),
      arg("third_cells", solid ? fmt::format(", {}", n) : ""), arg("n", n));
}

/// Seconds of one stage, look of the guards, history row or set of fields.
double measured(run::Solver& solver, const meshes::DeformedCells& cells, Work work, int n) {
  scheme::Snapshot fields;
  run::NodeReads all_nodes = solver.reads({});
  if (work == Work::snapshot) solver.take_snapshot(fields);  // its memory
  const double start = probes::seconds(1);
  for (int i = 0; i < n; ++i) {
    if (work == Work::energies || work == Work::row) solver.balance();
    if (work == Work::cells || work == Work::row) {  // as the watch of cells does at outputs, too
      const run::Motion motion = solver.motion(all_nodes);
      cells.outlook(motion.u, motion.v, 1e-6);
    }
    if (work == Work::snapshot) solver.take_snapshot(fields);
    if (work == Work::stage) solver.step(1e6);
  }
  const double each = (probes::seconds(1) - start) / n;
  return work == Work::stage ? each / solver.evaluations_per_step() : each;
}

/// One column: all options in turns. @return ns per node
std::vector<double> column(const std::string& method,
                           int dimension,
                           int cells,
                           int rounds,
                           const std::string& name,
                           StatusLine& status) {
  using Operators = std::array<std::string, 4>;
  std::map<Operators, CaseGraph> scenes;  // by what makes their graphs
  const auto all = options();
  std::vector<std::unique_ptr<run::Solver>> solvers;
  for (const Option& option : all) {
    cases::Case setup = cases::case_from_text(text_of(dimension, cells, option.manufactured),
                                              "costs", option.overrides);
    for (int k = 0; k < option.n_branches; ++k)
      setup.material.branches.push_back({0.5, 1e-3 * (k + 1), 0.5, 2e-3 * (k + 1)});
    const Operators operators{setup.scheme.precision, setup.scheme.volumes, setup.sph.gradient,
                              setup.fvm.stencil};
    if (scenes.count(operators) == 0) scenes.emplace(operators, graph_of(setup, method, 0));
    solvers.push_back(run::make_solver(setup, scenes.at(operators).graph));
    solvers.back()->step(1e6);  // pages and caches
  }
  const meshes::DeformedCells deformed(scenes.begin()->second.mesh.mesh);
  std::vector<double> least(all.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds && !interrupt_requested(); ++round) {
    status.show(fmt::format("{}: round {} of {}", name, round + 1, rounds));
    for (size_t i = 0; i < all.size(); ++i)
      least[i] = std::min(least[i], measured(*solvers[i], deformed, all[i].work, all[i].n));
  }
  for (double& seconds : least)
    seconds *= 1e9 / static_cast<double>(scenes.begin()->second.graph.n_nodes());
  return least;
}

/// The row with this option, or the barest.
const CostRow& reference_of(const CostTable& table, const CostRow& row) {
  const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const CostRow& r) { return r.option == row.against; });
  return found == table.rows.end() ? table.rows.front() : *found;
}

}  // namespace

CostTable measure_option_costs(int cells, int rounds, bool quiet) {
  CostTable table;
  for (const Option& option : options())
    table.rows.push_back({option.name, option.against, {}});
  StatusLine status(quiet);
  parallel::set_threads(1);
  for (const int dimension : {3, 2}) {
    for (const std::string method : {"sph", "fvm"}) {
      if (interrupt_requested()) return table;
      const std::string name = fmt::format("{} {}-D", method == "sph" ? "SPH" : "FVM", dimension);
      const auto ns = column(method, dimension, cells, rounds, name, status);
      table.columns.push_back(name);
      for (size_t i = 0; i < ns.size(); ++i)
        table.rows[i].ns.push_back(ns[i]);
      status.keep(name + " done");
    }
  }
  return table;
}

std::string cost_text(const CostTable& table) {
  std::string text = fmt::format("{:<36}", "ns per node and stage, ratio");
  for (const std::string& column : table.columns)
    text += fmt::format("{:>16}", column);
  text += '\n';
  text.append(36 + 16 * table.columns.size(), '-');
  text += '\n';
  for (const CostRow& row : table.rows) {
    const CostRow& reference = reference_of(table, row);
    text += fmt::format("{:<36}", row.option);
    for (size_t k = 0; k < row.ns.size(); ++k)
      text += fmt::format("{:>9.1f}{:>7.2f}", row.ns[k], row.ns[k] / reference.ns[k]);
    text += "\n";
  }
  return text;
}

std::string cost_csv(const CostTable& table) {
  std::string csv = "option,against";
  for (const std::string& column : table.columns)
    csv += fmt::format(",{} [ns],{} ratio [-]", column, column);
  csv += "\n";
  for (const CostRow& row : table.rows) {
    const CostRow& reference = reference_of(table, row);
    csv += fmt::format("\"{}\",\"{}\"", row.option, reference.option);
    for (size_t k = 0; k < row.ns.size(); ++k)
      csv += fmt::format(",{:.6g},{:.6g}", row.ns[k], row.ns[k] / reference.ns[k]);
    csv += "\n";
  }
  return csv;
}

}  // namespace diptych::harness
