#pragma once
/// What `diptych study` does with a case and its variants: stability limits; error against cost;
/// quantities where there is no exact solution, or where they are asked for.

#include "benchmarks/cost/stability.hpp"
#include "postprocess/report/study_report.hpp"

#include <limits>
#include <string>
#include <vector>

namespace diptych::harness {

struct StudyRequest {
  std::string case_file;
  std::vector<std::string> overrides, variations;  ///< of --set and --vary
  std::vector<std::string> methods;
  std::vector<std::string> integrators;  ///< stability only; empty: all
  int level = 0;                         ///< the first
  static constexpr int by_default = std::numeric_limits<int>::min();
  int n_levels = 3;
  int repeats = by_default;  ///< timings of every run; by default 3, without an exact solution 1
  std::string field;         ///< whose error is shown; empty: the first that the case measures
  std::vector<std::string> quantities;  ///< to show; empty: only without an exact solution
  int threads = 0;
  std::string directory;
  bool quiet = false, fresh = false;
  bool force = false;  ///< results of another case in the folder may be replaced
  StabilityOptions stability;
};

/// Prints the table, writes DIR/stability.csv. Rows found before an interrupt are kept.
void study_stability(const StudyRequest& request);

/// Runs all variants, methods and levels. Where the case has an exact solution, prints the table of
/// errors against cost and writes DIR/work_precision.csv and .html; else, and where quantities are
/// asked for, those with DIR/quantities.csv and .html. Runs are kept in DIR/runs, and taken over
/// where the same program has finished them with as many threads on the same kind of processor.
/// A run that breaks down is left out.
/// @return the runs that broke down
/// @throws base::InputError before the first run
std::vector<report::Breakdown> study_variants(const StudyRequest& request);

}  // namespace diptych::harness
