#include "benchmarks/run/judgement.hpp"

#include "common/base/error.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

cases::BoundCase bound(const std::string& figure, bool at_most, double value) {
  return {"", figure, at_most, value, {}};
}

/// A run whose kinetic energy was 1, 3 and 2 J at its outputs.
class JudgedRun : public testing::Test {
 protected:
  JudgedRun() {
    run.min_jacobian = 0.7;
    io::QuantitySummary& tip = run.quantities.emplace_back();
    tip.name = "tip";
    tip.final_value = 2;
    tip.greatest = 4;
    for (const double kinetic : {1.0, 3.0, 2.0})
      history.emplace_back().energy.kinetic = kinetic;
  }
  Outcome outcome(const std::vector<cases::BoundCase>& bounds = {}) const {
    return judged(run, history, bounds).outcome;
  }
  io::RunSummary run;
  std::vector<io::HistoryRow> history;
};

TEST_F(JudgedRun, IsWrongWhereItEndedAndTheGuardsWouldObject) {
  EXPECT_EQ(outcome(), Outcome::stable);
  run.energy.relative_residual = -0.036;
  EXPECT_EQ(outcome(), Outcome::wrong);
  EXPECT_EQ(judged(run, history, {}).reason, "energy residual 0.036, asked <= 0.01");
  run.energy.relative_residual = std::nan("");
  EXPECT_EQ(outcome(), Outcome::wrong);
  run.energy.relative_residual = 0;
  run.most_inverted_cells = 1;
  EXPECT_EQ(outcome(), Outcome::wrong);
}

TEST_F(JudgedRun, IsWrongWhereABoundDoesNotHold) {
  EXPECT_EQ(outcome({bound("tip, final", true, 2), bound("least J", false, 0.7)}), Outcome::stable);
  const Judgement wrong =
      judged(run, history, {bound("kinetic growth", true, 1), bound("tip, greatest", true, 3)});
  EXPECT_EQ(wrong.outcome, Outcome::wrong);
  EXPECT_EQ(wrong.reason, "kinetic growth 3, asked <= 1; tip, greatest 4, asked <= 3");
  history.front().energy.kinetic = 0;  // at rest: growth says nothing
  EXPECT_EQ(outcome({bound("kinetic growth", true, 1)}), Outcome::wrong);
}

TEST_F(JudgedRun, IsStoppedWithTheFirstLineOfItsMessage) {
  run.status = "breakdown";
  run.failure = io::RunFailure{"2 cells are inside out\n  the worst ...", 0.1, 7, {}, {}};
  run.most_inverted_cells = 2;
  const Judgement stopped = judged(run, history, {bound("least J", false, 1)});
  EXPECT_EQ(stopped.outcome, Outcome::stopped);
  EXPECT_EQ(stopped.reason, "2 cells are inside out");
  run.status = "failed";
  EXPECT_EQ(outcome(), Outcome::refused);
}

TEST_F(JudgedRun, IsUnfinishedWhereItsStepLimitEndedIt) {
  run.status = "step limit";
  run.steps = 60;
  run.end_time = 0.028;
  const Judgement short_one = judged(run, history, {bound("least J", false, 0.5)});
  EXPECT_EQ(short_one.outcome, Outcome::unfinished);
  EXPECT_EQ(short_one.reason, "step limit (time.max_steps) at step 60, t = 0.028 s");
  EXPECT_THAT(judged(run, history, {bound("least J", false, 1)}).reason,
              testing::EndsWith("; so far least J 0.7, asked >= 1"));
}

TEST_F(JudgedRun, SaysWhatItsCaseAsksAndDoesNotHold) {
  cases::ExpectCase expect;
  expect.holds = {bound("kinetic growth", true, 1)};
  EXPECT_EQ(unmet_of(expect, run, history), "") << "a case without [expect]";
  expect.is_given = true;
  EXPECT_EQ(unmet_of(expect, run, history), "kinetic growth 3, asked <= 1");
  expect.holds = {bound("kinetic growth", true, 3)};
  EXPECT_EQ(unmet_of(expect, run, history), "");
  expect.stops = "cells are inside out";
  EXPECT_THAT(unmet_of(expect, run, history), HasSubstr("asked to be stopped"));
}

TEST_F(JudgedRun, HasItsFiguresCheckedBeforeItBegins) {
  cases::Case setup;
  setup.probes.emplace_back().name = "tip";
  setup.expect.holds = {bound("tip, period", true, 1)};
  EXPECT_THROW(check_figures(setup), base::InputError) << "which is not looked at for a period";
  setup.probes.back().oscillation = true;
  for (const char* figure : {"tip, greatest", "tip, period", "numerical share", "kinetic growth"}) {
    setup.expect.holds = {bound(figure, true, 1)};
    EXPECT_NO_THROW(check_figures(setup)) << figure;
  }
  setup.expect.holds = {bound("tipp, greatest", true, 1)};
  EXPECT_THROW(check_figures(setup), base::InputError);
}

TEST_F(JudgedRun, KnowsTheNamesOfItsFigures) {
  try {
    judged(run, history, {bound("tip, finall", true, 1)});
    FAIL() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'tip, final'?"));
  }
}

}  // namespace
}  // namespace diptych::harness
