/// Studies of refinement as tables: what is extrapolated, what is left out, how it is written.

#include "benchmarks/convergence/convergence.hpp"

#include "benchmarks/study/study.hpp"
#include "postprocess/report/verdict.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <sstream>

namespace diptych::harness {
namespace {

using test::sample_run;
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Kinetic energy 1 + 4 h^2 (h = 1/4, 1/8, 1/16), a probe that goes to and fro, and no work.
std::vector<LevelRecord> records() {
  std::vector<LevelRecord> all;
  for (const int level : {2, 0, 1}) {
    const io::RunSummary run = sample_run("sph", level);
    const double h = run.spacing;
    all.push_back({run,
                   {{"time", "s", {0, 1}},
                    {"kinetic energy", "J", {7, 1 + 4 * h * h}},
                    {"external work", "J", {0, 0}},
                    {"linear momentum x", "kg m/s", {0, 1e-17}},
                    {"tip_x, 50 %", "m^2", {0, level == 1 ? 2.0 : 1.0}}}});
  }
  return all;
}

TEST(Convergence, ExtrapolatesEveryScalarOfTheHistory) {
  const auto studies = convergence_of(records(), {});
  ASSERT_EQ(studies.size(), 1u);
  const ColumnConvergence& study = studies[0];
  ASSERT_EQ(study.scalars.size(), 2u) << "neither time nor momentum, nor what is zero";
  EXPECT_THAT(study.zero, ElementsAre("external work"));
  const auto g = estimate(study, study.scalars[0], 2);
  ASSERT_TRUE(g.has_value());
  EXPECT_NEAR(g->order, 2, 1e-10);
  EXPECT_NEAR(g->extrapolated, 1, 1e-12);
  EXPECT_NEAR(g->error_bar, 1.25 * 4 / 256, 1e-12);
  EXPECT_FALSE(estimate(study, study.scalars[0], 1).has_value()) << "two levels";
  EXPECT_NEAR(order_of_error(study, study.errors[1], 2), 2, 1e-12);
  EXPECT_EQ(convergence_of(records(), {"all"})[0].scalars.size(), 4u);
}

/// Coarse levels may be far off: what they come to does not make wide bars narrow.
TEST(Convergence, HasOneScaleForTerminalAndReportThatOfTheFinestRun) {
  std::vector<LevelRecord> all;
  for (const int level : {0, 1, 2}) {
    const double off = std::exp2(-2 * level);  // 1, 1/4, 1/16
    all.push_back({sample_run("sph", level),
                   {{"time", "s", {0, 1, 2}},
                    {"kinetic energy", "J", {3, 1, 2}},
                    {"strain energy", "J", {0, 4, 1}},
                    {"external work", "J", {0, -2 - 32 * off, off}},
                    {"tip", "m", {0, 8 * off, off}}}});
  }
  const auto studies = convergence_of(all, {});
  ASSERT_EQ(studies[0].scalars.size(), 4U);
  EXPECT_EQ(studies[0].scalars[0].scale, 5) << "kinetic and strain energy together";
  EXPECT_EQ(studies[0].scalars[1].scale, 5);
  EXPECT_EQ(studies[0].scalars[2].scale, 4) << "work by itself, of the finest level";
  EXPECT_EQ(studies[0].scalars[3].scale, 0.5);
  const report::StudyReport report = report_of(cases::Case{}, Study{}, studies);
  for (const Quantity& scalar : studies[0].scalars) {
    const auto& series = report.quantities.at({scalar.name, scalar.unit});
    EXPECT_EQ(report::scale_of(series), scalar.scale) << scalar.name;
  }
}

TEST(Convergence, SaysWhereValuesDoNotConverge) {
  const std::string text = quantity_table(convergence_of(records(), {})[0]);
  EXPECT_THAT(text, ContainsRegex("kinetic energy \\[J\\] +1.015625 +1 +2.00 +1.9 % +2.0e-02\n"));
  EXPECT_THAT(text, ContainsRegex("tip_x, 50 % \\[m\\^2\\] +1 +- +- +3e\\+02 % +3.0e\\+00 "
                                  " oscillates\n"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 100u) << line;
}

/// Bars of 1.25 * 4/256 = 0.0195 each for the energy, 3 for the probe.
TEST(Convergence, SaysWhetherTwoMethodsAgree) {
  auto all = records();
  for (LevelRecord record : records()) {
    record.summary.method = "fvm";
    record.history[1].values.back() += 0.05;
    record.history[4].values.back() += 0.05;
    all.push_back(record);
  }
  const std::string text = agreement_table(convergence_of(all, {}));
  EXPECT_THAT(text,
              ContainsRegex("kinetic energy \\[J\\] +5.00e-02 +3.91e-02  APART: the case has no"));
  EXPECT_THAT(text, ContainsRegex("tip_x, 50 % \\[m\\^2\\] +5.00e-02 +6.00e\\+00  "
                                  "unresolved: each method oscillates\n"));
  EXPECT_THAT(agreement_table(convergence_of(all, {}), {{"kinetic energy", "late by 2 %"}}),
              ContainsRegex("kinetic energy.*APART: late by 2 %\n"));
  EXPECT_EQ(agreement_table(convergence_of(records(), {})), "") << "one method";
}

TEST(Convergence, LeavesOutRunsThatWereNotFinished) {
  auto some = records();
  some[0].summary.status = "interrupted";  // the finest
  EXPECT_EQ(convergence_of(some, {})[0].levels.size(), 2u);
}

TEST(Convergence, WritesALineForEachMethodQuantityAndLevel) {
  const std::string csv = convergence_csv(convergence_of(records(), {}));
  EXPECT_THAT(csv, testing::StartsWith("method,quantity,unit,level,spacing [m],"));
  EXPECT_THAT(csv, HasSubstr("\nsph,kinetic energy,J,2,0.0625,8000,240,1.015625,"));
  EXPECT_THAT(csv, HasSubstr("\nsph,\"tip_x, 50 %\",m^2,1,0.125,1000,120,2,,,1,0.5,two grids\n"));
  EXPECT_THAT(csv, HasSubstr("\nsph,velocity error L2,-,0,"));
  // 4 fields with 3 norms and 2 scalars on 3 levels, and the headings
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * (12 + 2));
}

TEST(Convergence, WritesLatexThatNeedsNoPackage) {
  const std::string tex = convergence_tex(convergence_of(records(), {}));
  EXPECT_THAT(tex, AllOf(HasSubstr("\\begin{tabular}{rrrrrrrrrr}"), HasSubstr("$h$ [m] & nodes"),
                         HasSubstr("tip\\_x, 50 \\% [m$^{2}$]"),
                         HasSubstr("$1.00\\cdot10^{-3}$ & 2.00"), HasSubstr("oscillates")));
  EXPECT_THAT(tex, Not(HasSubstr("rule")));
}

}  // namespace
}  // namespace diptych::harness
