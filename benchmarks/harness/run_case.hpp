#pragma once
/// One run of one method on one level of a case: mesh, graph, solver, output, summary.

#include "benchmarks/harness/case_mesh.hpp"
#include "benchmarks/harness/node_measures.hpp"
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
  std::vector<NodeMeasure> measures;  ///< of the final state, for summary.json
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

}  // namespace diptych::harness
