#pragma once
/// What the regression shows: a line a case and method, below it every failure; the difference of
/// two baselines; for other programs JUnit XML as GitLab, Jenkins and the readers of GitHub Actions
/// take it, and JSON with stable keys (benchmarks/CI.md names them).
/// Test: tests/harness/regress_report_test.cpp

#include "benchmarks/regression/regress.hpp"
#include "common/io/run_record.hpp"

#include <array>
#include <string>
#include <vector>

namespace diptych::harness {

struct RegressRow {
  std::string case_name, method;  ///< sph, fvm, or both
  std::vector<RegressCheck> checks;
  double seconds = 0;  ///< of the runs behind them
};

/// How many checks came to which verdict.
struct VerdictCounts {
  std::array<size_t, 4> n{};
  size_t of(Verdict verdict) const { return n.at(static_cast<size_t>(verdict)); }
  size_t all() const { return n[0] + n[1] + n[2] + n[3]; }
};
VerdictCounts count_verdicts(const std::vector<RegressRow>& rows);

/// For 100 columns; with a line of totals at the end.
std::string regress_table(const std::vector<RegressRow>& rows);

bool has_failed(const std::vector<RegressRow>& rows);

/// What the program ends with: of all that failed the kind that says most about the rest, in the
/// order environment, wrong input, breakdown, bound; done where nothing failed.
base::ExitCode exit_code_of(const std::vector<RegressRow>& rows);

/// "1 breakdown, 2 checks failed"
std::string failures_in_words(const std::vector<RegressRow>& rows);

/// Who recorded what when, and figures old -> new where they differ, the largest changes first.
std::string difference_text(const RegressBaseline& old, const RegressBaseline& now);

struct RegressedCase {
  std::string name, file, baseline;  ///< paths, empty where there is none
  double seconds = 0;
  std::vector<RegressRow> rows;
};

enum class RegressState { running, interrupted, done };

struct RegressReport {
  RegressState state = RegressState::running;
  std::vector<RegressedCase> cases;
  size_t n_wanted = 0;  ///< cases that are to be checked
  double seconds = 0;
  std::string cases_folder, baselines_folder;
  io::Provenance provenance;

  std::vector<RegressRow> rows() const;
};

/// What a failure is called: bound, breakdown, input, environment, interrupted.
const char* kind_of(base::ExitCode code);

/// <testsuites>, a <testsuite> for each case, a <testcase> for each check of a method: <failure>
/// where a bound is not met, <error> where there was nothing to judge, <skipped>. A regression that
/// has not come to its end has a suite more, with an error.
std::string junit_xml(const RegressReport& report);

/// Numbers that are not finite are null.
std::string regress_json(const RegressReport& report);

}  // namespace diptych::harness
