#pragma once
/// What `diptych study` does with a case and its variants: stability limits; what local steps would
/// save; error against cost; quantities where there is no exact solution, or where they are asked
/// for. Test: tests/command_line/study_test.cpp

#include "benchmarks/cost/stability.hpp"
#include "benchmarks/run/output_folder.hpp"
#include "benchmarks/study/study.hpp"
#include "benchmarks/study/variants.hpp"
#include "benchmarks/study/work_precision.hpp"

#include <limits>
#include <string>
#include <vector>

namespace diptych::harness {

struct StudyRequest {
  std::string case_file;
  std::vector<std::string> overrides, variations;  ///< of --set and --vary
  StudyOptions run;                                ///< stability: of its first level
  std::vector<std::string> integrators;            ///< stability only; empty: all
  static constexpr int by_default = std::numeric_limits<int>::min();
  int repeats = by_default;  ///< timings of every run; by default 3, without an exact solution 1
  std::string field;         ///< whose error is shown; empty: the first that the case measures
  std::vector<std::string> quantities;  ///< to show; empty: only without an exact solution
  StabilityOptions stability;
};

/// Prints the table, writes DIR/stability.csv. Rows found before an interrupt are kept.
void study_stability(const StudyRequest& request);

/// Prints the table of local_steps.hpp of the first level, writes DIR/local_steps.csv.
void study_local_steps(const StudyRequest& request);

struct StudyRuns {
  std::vector<WorkCurve> curves;              ///< those with a run at least
  std::string field;                          ///< whose error is shown, or empty
  std::vector<report::Breakdown> breakdowns;  ///< with the variant in the message
  std::vector<io::RunSummary> unsound;        ///< or unmet, of the runs in the curves
  std::vector<io::RunSummary> cut_short;      ///< at their step limit: they are in no curve
};

/// Runs all variants, methods and levels. Where the case has an exact solution, prints the table of
/// errors against cost and writes DIR/work_precision.csv and .html; else, and where quantities are
/// asked for, those with DIR/quantities.csv and .html. Runs are kept in DIR/runs, and taken over
/// where the same program has finished them with as many threads on the same kind of processor.
/// A run that breaks down or is cut short is left out.
/// @throws base::InputError before the first run
StudyRuns study_variants(const StudyRequest& request);

/// All are read, and what they ask of the machine is known, before the first is run.
/// @throws base::InputError
std::vector<cases::Case> cases_of_study(const StudyRequest& request,
                                        const std::vector<Variant>& variants);

/// Every variant, method and level, timed as often as asked. Repetitions go round the curves, so
/// that a slow minute of the machine hits all of them.
/// @param cases   of the variants
/// @param output  prepared once the first run has shown that what was asked makes sense
/// @throws base::InputError where --field is not measured, after the first run
StudyRuns runs_of_study(const StudyRequest& request,
                        const std::vector<Variant>& variants,
                        const std::vector<cases::Case>& cases,
                        OutputFolder& output);

}  // namespace diptych::harness
