#pragma once
/// One run of one method on one level of a case: mesh, graph, solver, output, summary.

#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/node_measures.hpp"
#include "benchmarks/harness/schedule.hpp"
#include "common/io/run_record.hpp"
#include "common/run/case.hpp"
#include "common/run/solver.hpp"
#include "postprocess/report/shapes.hpp"

#include <memory>
#include <string>
#include <vector>

namespace diptych::harness {

struct RunOptions {
  std::string method = "fvm";
  int level = 0;
  int threads = 0;        ///< 0: all processors
  std::string directory;  ///< of this run; empty: nothing is written
  bool fields = true;     ///< write field frames (besides output.fields of the case)
  bool quiet = false;     ///< no progress
  bool shapes = false;    ///< keep deformed surfaces for a report
  bool scales = false;    ///< find the largest norms of the fields over the output times
  std::vector<NodeMeasure> measures;   ///< of the final state, for summary.json
  const Schedule* schedule = nullptr;  ///< of the command that makes this run among others
};

struct RunResult {
  io::RunSummary summary;
  std::vector<io::HistoryRow> history;
  std::vector<io::StepRow> steps;        ///< of the probes with every_step
  std::vector<io::HistoryColumn> exact;  ///< what the exact solution gives at the output times
  std::map<std::string, double> scales;  ///< field: largest L2 norm, exact where errors have one
  run::Snapshot final_state;             ///< in the numbering of `mesh`
  report::ShapeRecord shapes;            ///< where they were asked for
  std::vector<std::int32_t> order;       ///< [node] its number in the user's mesh
  scheme::PairGraph graph;               ///< without its pairs
};

/// @throws base::InputError, base::EnvironmentError before anything is written;
///         base::BreakdownError after the summary with status "breakdown" has been written
RunResult run_case(const run::Case& setup, const RunOptions& options);

/// What `diptych check` tells of a case without running it.
struct CaseCheck {
  std::int64_t nodes = 0, cells = 0, pairs = 0, steps = 0;
  std::int64_t bytes = 0;           ///< arrays of the solver
  std::int64_t running_bytes = 0;   ///< resident set once the solver stands
  std::int64_t building_bytes = 0;  ///< largest resident set until then
  double estimated_bytes = 0;       ///< of that, from the case alone
  double setup_seconds = 0;         ///< until the solver stood
  double seconds = 0;               ///< of all steps, as the first ones went; without output
  double dt = 0;                    ///< s, of the first step
  scheme::GraphQuality quality;
};
CaseCheck check_case(const run::Case& setup, const std::string& method, int level);

/// Set by a signal handler: the run ends its step, writes what there is, status "interrupted".
void request_interrupt();
bool interrupt_requested();

/// Creates DIR for a run, or takes one that an earlier run made (it has a summary.json).
/// @throws base::EnvironmentError where it cannot, base::InputError where it holds something else
void claim_directory(const std::string& directory);

}  // namespace diptych::harness
