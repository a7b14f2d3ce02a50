#pragma once
/// Studies of several runs: both methods side by side with their variants, and levels of
/// refinement.

#include "benchmarks/convergence/convergence.hpp"
#include "benchmarks/run/columns.hpp"
#include "benchmarks/run/run_case.hpp"
#include "postprocess/report/study_report.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

struct StudyOptions {
  std::vector<std::string> methods{"sph", "fvm"};
  std::vector<Column> variants;  ///< further columns
  std::vector<int> levels{0};
  int threads = 0;
  std::string partition = "metis";  ///< see RunOptions
  std::string directory;  ///< runs go to DIR/<column> (one level) or DIR/level_<L>/<column>
  bool fields = true;
  bool quiet = false;
  bool shapes = false;  ///< keep deformed surfaces of both methods, finest level, for the report
  bool resume = false;  ///< runs that the same program has finished there are taken over
  bool force = false;   ///< results of another case in the folder may be replaced
  bool goes_past_refusals = false;  ///< a method that cannot begin leaves the other one to run; a
                                    ///< variant always leaves the others
  bool differences = true;          ///< find how far columns are apart at the end
  bool keeps_checkpoints = false;   ///< of runs, see RunOptions::checkpoints
  bool goes_on = false;             ///< with what lies in the folder (one level)
  std::map<std::string, std::string> checkpoints;  ///< method: file to go on from
};

/// A run that could not be begun, of which nothing was written.
struct Refusal {
  std::string column;
  int level = 0;
  std::string message;
};

/// What a run that broke down had until then.
struct BrokenRun {
  io::RunSummary summary;
  std::vector<io::HistoryRow> history;
  report::ShapeRecord shapes;  ///< of the finest level, where they are kept
};

struct Study {
  std::vector<Column> columns;  ///< both methods, then the variants
  /// level by level, in the order of the columns; without those that broke down or were refused
  std::vector<io::RunSummary> runs;
  std::vector<BrokenRun> broken;
  std::vector<Refusal> refusals;  ///< where the options go past them
  // of each column the finest level that did not break down
  std::map<std::string, std::vector<io::HistoryRow>> histories;  ///< column: rows
  std::map<std::string, std::vector<io::HistoryColumn>> exact;   ///< column: columns of exact.csv
  std::vector<std::string> directories;                          ///< of each run
  std::vector<std::string> taken_over;                           ///< directories of such runs
  std::map<std::string, report::ShapeRecord> shapes;             ///< method: finest level
  std::map<std::string, double> differences;  ///< field: L2 at the nodes at the end, finest level,
                                              ///< over its largest norm at any output time
  std::vector<report::ColumnDistance> distances;  ///< the same of each variant from each method

  /// All of one level came to their ends, but for those that broke down and variants that could
  /// not be begun.
  bool has_all() const {
    const auto n_refused = std::count_if(refusals.begin(), refusals.end(), [](const Refusal& one) {
      return !report::variant_of_column(one.column).empty();
    });
    return runs.size() + broken.size() + static_cast<size_t>(n_refused) == columns.size();
  }
  /// What ended each of the broken runs.
  std::vector<report::Breakdown> breakdowns() const;
  /// The only run of a column, or null.
  const io::RunSummary* run_of(const std::string& column) const;

  /// Nothing was run or taken over.
  bool is_empty() const { return runs.empty() && broken.empty(); }
};

/// Runs both methods and the variants on all levels; a breakdown ends only its own run, an
/// interrupt all.
/// @throws base::InputError where results of another case lie in the folder, and of a run that
///         cannot be begun: where the options go past refusals, once no method can
Study run_study(const cases::Case& setup, const StudyOptions& options);

/// The study as the report shows it. @param convergence  of its runs; empty: of one level
report::StudyReport report_of(const cases::Case& setup,
                              const Study& study,
                              const std::vector<ColumnConvergence>& convergence = {});

/// Why the methods are apart on a quantity, as the case says ([[apart]]).
std::map<std::string, std::string> causes_of(const cases::Case& setup);

/// Law, constants and branches as lines of text.
std::vector<std::string> material_lines(const cases::MaterialCase& material);

}  // namespace diptych::harness
