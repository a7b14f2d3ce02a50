#pragma once
/// What `diptych study` does: stability limits, or error against cost, of a case and its variants.

#include "benchmarks/harness/stability.hpp"
#include "postprocess/report/study_report.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

struct StudyRequest {
  std::string case_file;
  std::vector<std::string> overrides, variations;  ///< of --set and --vary
  std::vector<std::string> methods;
  std::vector<std::string> integrators;  ///< stability only; empty: all
  int level = 0;                         ///< the first
  int n_levels = 3, repeats = 3;         ///< work-precision only
  std::string field;  ///< whose error is shown; empty: the first that the case measures
  int threads = 0;
  std::string directory;
  bool quiet = false, fresh = false;
  bool force = false;  ///< results of another case in the folder may be replaced
  StabilityOptions stability;
};

/// Prints the table, writes DIR/stability.csv. Rows found before an interrupt are kept.
void study_stability(const StudyRequest& request);

/// Prints the table, writes DIR/work_precision.csv and DIR/work_precision.html. Repetitions go
/// round the curves, so that a slow minute of the machine hits all of them. Runs are kept in
/// DIR/runs, and taken over where the same program has finished them with as many threads on the
/// same kind of processor.
/// A run that breaks down is left out.
/// @return the runs that broke down
/// @throws base::InputError where the case has no exact solution
std::vector<report::Breakdown> study_work_precision(const StudyRequest& request);

}  // namespace diptych::harness
