/// Pass numbers of a case in the regression: what is met, known, and what must not pass as either.

#include "benchmarks/regression/regress.hpp"
#include "benchmarks/regression/report.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Expectation : public testing::Test {
 protected:
  Expectation() {
    expect.is_given = true;
    history.emplace_back();
    expect.holds.push_back({"", "least J", false, 0.5, {}});
  }
  void stop(const std::string& message, std::int64_t step) {
    run.status = "breakdown";
    run.failure = io::RunFailure{message, 0.1, step, {}, {}};
  }
  void knows(const std::string& stops, std::int64_t by_step) {
    expect.unmet = {{"sph", "", "", stops, by_step, "bulk pressure", {}}};
  }
  RegressRow row() const {
    return {"mould", "sph", expectation_checks(expect, {"sph", ""}, run, history)};
  }
  base::ExitCode code() const { return exit_code_of({row()}); }
  size_t count(Verdict verdict) const { return count_verdicts({row()}).of(verdict); }

  cases::ExpectCase expect;
  io::RunSummary run;
  std::vector<io::HistoryRow> history;
};

TEST_F(Expectation, IsMetByAWholeRun) {
  EXPECT_EQ(count(Verdict::met), 4U) << "ending, residual, cells, least J";
  EXPECT_EQ(code(), base::ExitCode::done);
}

TEST_F(Expectation, FailsWhereABoundDoesNotHoldOrTheRunIsStopped) {
  run.min_jacobian = 0.4;
  EXPECT_EQ(code(), base::ExitCode::bound_not_met);
  EXPECT_THAT(regress_table({row()}), HasSubstr("least J 0.4 of at least 0.5"));
  stop("2 cells are inside out, step 7", 7);
  EXPECT_EQ(code(), base::ExitCode::breakdown);
  EXPECT_THAT(regress_table({row()}), HasSubstr("is stopped: 2 cells are inside out"));
}

TEST_F(Expectation, CanBeToBeStoppedWithACauseInTime) {
  expect.holds.clear();
  expect.stops = "inside out";
  expect.by_step = 10;
  EXPECT_EQ(code(), base::ExitCode::bound_not_met) << "ended";
  stop("2 cells are inside out", 10);
  EXPECT_EQ(code(), base::ExitCode::done);
  stop("2 cells are inside out", 11);
  EXPECT_EQ(code(), base::ExitCode::bound_not_met) << "too late";
  stop("J <= 0", 3);
  EXPECT_EQ(code(), base::ExitCode::bound_not_met) << "another cause";
}

TEST_F(Expectation, ThatIsNotMetIsKnownWithItsCauseAsLongAsTheRunEndsAsIsSaid) {
  knows("inside out", 10);
  stop("2 cells are inside out", 9);
  EXPECT_EQ(code(), base::ExitCode::done);
  EXPECT_EQ(count(Verdict::known), 1U);
  EXPECT_THAT(regress_table({row()}),
              AllOf(HasSubstr("not met: ending: is stopped: 2 cells"), HasSubstr("bulk pressure")));
  stop("2 cells are inside out", 11);
  EXPECT_NE(code(), base::ExitCode::done) << "stopped too late";
  stop("J <= 0", 3);
  EXPECT_NE(code(), base::ExitCode::done) << "stopped for another reason";
  run.status = "done";
  run.min_jacobian = 0.4;
  EXPECT_NE(code(), base::ExitCode::done) << "ended while wrong";
}

TEST_F(Expectation, ThatEndsWhileWrongIsKnownWhereTheCaseSaysSo) {
  knows("", 0);
  run.min_jacobian = 0.4;
  EXPECT_EQ(code(), base::ExitCode::done);
  EXPECT_EQ(count(Verdict::known), 1U);
  stop("2 cells are inside out", 9);
  EXPECT_EQ(code(), base::ExitCode::breakdown);
}

TEST_F(Expectation, OfOneFigureLeavesTheOthersAsked) {
  knows("", 0);
  expect.unmet[0].figure = "least J";
  run.min_jacobian = 0.4;
  EXPECT_EQ(code(), base::ExitCode::done);
  EXPECT_EQ(count(Verdict::known), 1U);
  run.energy.relative_residual = 0.5;
  EXPECT_EQ(code(), base::ExitCode::bound_not_met) << "another bound does not hold";
  run.min_jacobian = 0.6;
  EXPECT_THAT(regress_table({row()}), HasSubstr("met now: remove this entry"));
  expect.unmet[0].figure = "least K";
  EXPECT_EQ(code(), base::ExitCode::bound_not_met);
  EXPECT_THAT(regress_table({row()}), HasSubstr("'least K' was not judged"));
}

TEST_F(Expectation, EachOfSeveralEntriesIsOfItsFigure) {
  knows("", 0);
  expect.unmet.push_back(expect.unmet[0]);
  expect.unmet[0].figure = "least J";
  expect.unmet[1].figure = "energy residual";
  run.min_jacobian = 0.4;
  run.energy.relative_residual = 0.5;
  EXPECT_EQ(count(Verdict::known), 2U);
  EXPECT_EQ(code(), base::ExitCode::done);
  run.min_jacobian = 0.6;
  EXPECT_EQ(count(Verdict::known), 1U);
  EXPECT_THAT(regress_table({row()}), HasSubstr("met now: remove this entry"));
}

TEST_F(Expectation, ThatIsMetInSpiteOfAnEntryAsksToRemoveIt) {
  knows("inside out", 10);
  EXPECT_EQ(code(), base::ExitCode::bound_not_met);
  EXPECT_THAT(regress_table({row()}), HasSubstr("met now: remove this entry (bulk pressure)"));
}

TEST(ExpectedRuns, AreOfBothMethodsButForKeysOfOne) {
  cases::ExpectCase expect;
  expect.variants = {"sph.kappa=0.75", "parameters.p=3"};
  std::vector<std::string> runs;
  for (const ExpectedRun& run : expected_runs(expect))
    runs.push_back(run.method + " " + run.variant);
  EXPECT_THAT(runs, testing::ElementsAre("sph ", "sph sph.kappa=0.75", "sph parameters.p=3", "fvm ",
                                         "fvm parameters.p=3"));
}

}  // namespace
}  // namespace diptych::harness
