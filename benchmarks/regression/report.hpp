#pragma once
/// A regression for other programs: JUnit XML as GitLab, Jenkins and the readers of GitHub Actions
/// take it, and JSON with stable keys (benchmarks/CI.md names them).
/// Test: tests/harness/regress_report_test.cpp

#include "benchmarks/regression/table.hpp"
#include "common/io/run_record.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

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
