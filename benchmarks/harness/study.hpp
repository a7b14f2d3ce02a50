#pragma once
/// Studies of several runs: both methods side by side, and levels of refinement.

#include "benchmarks/harness/convergence.hpp"
#include "benchmarks/harness/run_case.hpp"
#include "postprocess/report/study_report.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

struct StudyOptions {
  std::vector<std::string> methods{"sph", "fvm"};
  std::vector<int> levels{0};
  int threads = 0;
  std::string directory;  ///< runs go to DIR/<method> (one level) or DIR/level_<L>/<method>
  bool fields = true;
  bool quiet = false;
  bool shapes = false;  ///< keep deformed surfaces of the finest level for the report
  bool resume = false;  ///< runs that the same program has finished there are taken over
};

struct Study {
  std::vector<io::RunSummary> runs;  ///< level by level, methods in the order of the options
  std::map<std::string, std::vector<io::HistoryRow>> histories;  ///< method: finest level
  std::map<std::string, std::vector<io::HistoryColumn>> exact;   ///< method: finest level
  std::vector<std::string> directories;                          ///< of each run
  std::vector<std::string> taken_over;                           ///< directories of such runs
  std::map<std::string, report::ShapeRecord> shapes;             ///< method: finest level
  std::map<std::string, double> differences;  ///< field: L2 at the nodes at the end, finest level,
                                              ///< over its largest norm at any output time
};

/// Runs all methods on all levels; stops after an interrupt.
Study run_study(const run::Case& setup, const StudyOptions& options);

/// The study as the report shows it. @param convergence  of its runs; empty: of one level
report::StudyReport report_of(const run::Case& setup,
                              const Study& study,
                              const std::vector<MethodConvergence>& convergence = {});

/// Law, constants and branches as lines of text.
std::vector<std::string> material_lines(const run::MaterialCase& material);

}  // namespace diptych::harness
