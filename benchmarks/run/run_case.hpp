#pragma once
/// One run of one method on one level of a case: mesh, graph, solver, output, summary.

#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/node_measures.hpp"
#include "benchmarks/terminal/schedule.hpp"
#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"
#include "common/run/solver.hpp"
#include "postprocess/report/shapes.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych::harness {

struct RunOptions {
  std::string method = "fvm";
  std::string variant;  ///< name of the variant that the case is, see RunSummary
  int level = 0;
  int threads = 0;                  ///< 0: all processors
  std::string partition = "metis";  ///< of the body among ranks: parallel::partitioners()
  std::string directory;            ///< of this run; empty: nothing is written
  bool fields = true;               ///< write field frames (besides output.fields of the case)
  bool quiet = false;               ///< no progress
  bool shapes = false;              ///< keep deformed surfaces for a report
  bool final_state = true;          ///< keep the fields of the end
  bool scales = false;              ///< find the largest norms of the fields over the output times
  bool checkpoints = false;  ///< keep its state when the case says so, and where it is interrupted
  std::string checkpoint;    ///< file to go on from; empty: the run begins at t = 0
  std::vector<NodeMeasure> measures;     ///< of the final state, for summary.json
  const Schedule* schedule = nullptr;    ///< of the command that makes this run among others
  std::function<void()> before_writing;  ///< called once mesh, graph and solver stand, before the
                                         ///< folder of the run is made; may be empty

  std::string column() const { return io::column_name(method, variant); }
};

struct RunResult {
  io::RunSummary summary;
  std::vector<io::HistoryRow> history;
  std::vector<io::StepRow> steps;        ///< of the probes with every_step
  std::vector<io::HistoryColumn> exact;  ///< what the exact solution gives at the output times
  std::map<std::string, double> scales;  ///< field: largest L2 norm, exact where errors have one
  scheme::Snapshot final_state;          ///< in the numbering of `mesh`
  report::ShapeRecord shapes;            ///< where they were asked for
  std::vector<std::int32_t> order;       ///< [node] its number in the user's mesh
  scheme::PairGraph graph;               ///< without its pairs
};

/// A breakdown is a result: summary.status "breakdown" and summary.failure say so, the rest is
/// what had been computed until then.
/// @throws base::InputError, base::EnvironmentError, std::bad_alloc: before anything is written, or
///         after the summary with status "failed" and the message has been;
///         base::Interruption where the user ended the meshing: nothing is written
RunResult attempt_case(const cases::Case& setup, const RunOptions& options);

/// The same where a breakdown is the end.
/// @throws base::BreakdownError too, after the summary with status "breakdown" has been written
RunResult run_case(const cases::Case& setup, const RunOptions& options);

}  // namespace diptych::harness
