/// The verdict in plain words: which method errs less and at what cost, whether they agree, what is
/// too coarse to say, what broke down first of all.

#include "postprocess/report/verdict.hpp"

#include "postprocess/report/orders.hpp"
#include "postprocess/report/price.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::report {
namespace {

using test::sample_run;
using test::sample_study;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string verdict_text(const StudyReport& study) {
  return fmt::format("{}", fmt::join(verdict(study), " "));
}

StudyReport without_errors(StudyReport study) {
  for (io::RunSummary& run : study.runs)
    run.errors.clear();
  study.differences = {{"displacement", 0.02}, {"stress", 0.6}};
  return study;
}

TEST(Verdict, SaysWhichMethodErrsLessAndAtWhatCost) {
  // SPH: 0.016/16 on level 2, finite volume 0.032/4
  const std::string text = verdict_text(sample_study());
  EXPECT_THAT(text, StartsWith("SPH errs less: on level 2 its velocity is off by 0.100 %, that of "
                               "finite volume by 0.800 %, and it errs less in every other field"));
  // finite volume needs all its 12.8 s for 0.8 %; SPH has it between 0.08 s (1.6 %) and 1.28 s
  EXPECT_THAT(text, HasSubstr("For the same error, 0.800 %, finite volume takes 40.0 times the "
                              "seconds of SPH (12.8 s against 0.320 s)."));
}

/// A variant that errs ten times less, with quantities and energies a hundred times larger.
TEST(Verdict, IsOnTheTwoMethodsWhateverVariantsStandBesideThem) {
  StudyReport study = test::full_study();
  const std::string before = verdict_text(study);
  for (int level = 0; level < 3; ++level) {
    io::RunSummary run = sample_run("sph", level);
    run.variant = "compact";
    run.quantities = study.runs.front().quantities;
    run.quantities[0].greatest *= 100;
    for (auto& [field, norms] : run.errors)
      norms.l2 /= 10;
    study.runs.push_back(run);
  }
  study.histories["sph-compact"] = study.histories["sph"];
  for (io::HistoryRow& row : study.histories["sph-compact"])
    row.energy.strain *= 100;
  for (auto& [quantity, series] : study.quantities) {
    series.push_back(series.front());
    series.back().column = "sph-compact";
    series.back().points.back().value *= 100;
  }
  study.distances = {{"sph-compact", "fvm", {{"velocity", 0.9}}}};
  EXPECT_EQ(verdict_text(study), before);
  EXPECT_THAT(columns_of(study.runs), testing::ElementsAre("sph", "fvm", "sph-compact"));
  study.breakdowns = {{"fvm-sbp", 2, 1e-3, 7, -1, "J <= 0"}};
  EXPECT_THAT(verdict_text(study), StartsWith("Finite volume sbp broke down on level 2"));
}

TEST(Verdict, CallsErrorsAlikeThatAreWithinAFewPercent) {
  StudyReport study = sample_study();
  study.runs = {sample_run("sph", 0), sample_run("fvm", 0)};
  for (io::RunSummary& run : study.runs)
    run.errors = {{"velocity", {0, run.method == "sph" ? 0.0200 : 0.0198, 0}}};
  EXPECT_THAT(verdict_text(study),
              AllOf(StartsWith("On level 0 both err alike: their velocity is off by 2.00 % and "
                               "1.98 %."),
                    HasSubstr("On the same nodes SPH takes 1.60 times the seconds of finite volume "
                              "(0.0800 s against 0.0500 s).")));
}

// One field is not all: a cube's velocity was off by 2 % with both, its strains by 15 and 2 %.
TEST(Verdict, CallsErrorsOfOneFieldAlikeOfThatFieldAlone) {
  StudyReport study = sample_study();
  study.runs = {sample_run("sph", 0), sample_run("fvm", 0)};
  for (io::RunSummary& run : study.runs) {
    const bool is_sph = run.method == "sph";
    run.errors = {{"velocity", {0, is_sph ? 0.0200 : 0.0198, 0}},
                  {"deformation_gradient", {0, is_sph ? 0.15 : 0.03, 0}},
                  {"stress", {0, is_sph ? 0.01 : 0.02, 0}}};
  }
  EXPECT_THAT(verdict_text(study),
              StartsWith("On level 0 the velocity of both is off alike, by 2.00 % and 1.98 %; in "
                         "other fields SPH errs less, by up to 2.00 times (stress), and finite "
                         "volume errs less, by up to 5.00 times (deformation gradient)."));
}

TEST(Verdict, CountsTheFieldsWhereTheMethodsTakeTurns) {
  StudyReport study = sample_study();
  for (io::RunSummary& run : study.runs)
    if (run.method == "sph") run.errors["stress"].l2 = 0.3;
  EXPECT_THAT(verdict_text(study), HasSubstr("; of the 4 fields it errs less in 3."));
}

TEST(Verdict, IsTooCoarseToSayWhereTheMethodsDifferByMoreThanHalf) {
  StudyReport study = sample_study();
  study.differences = {{"velocity", 0.4}, {"displacement", 0.62}, {"stress", 3}};
  EXPECT_THAT(verdict_text(study),
              StartsWith("Too coarse to say: on level 2 the two methods end 62.0 % of the largest "
                         "displacement apart, more than half."));
  study.differences["displacement"] = 0.5;
  EXPECT_THAT(verdict_text(study), AllOf(Not(HasSubstr("Too coarse")),
                                         HasSubstr("50.0 % of the largest displacement apart.")));
}

TEST(Verdict, IsTooCoarseToSayWhereBothMissMoreThanHalf) {
  StudyReport study = sample_study();
  study.differences.clear();
  for (io::RunSummary& run : study.runs)
    run.errors["velocity"].l2 = run.method == "sph" ? 0.7 : 0.9;
  EXPECT_THAT(verdict_text(study), StartsWith("Too coarse to say: on level 2 both miss more than "
                                              "half of the velocity."));
}

TEST(Verdict, DoesNotJudgeOneLevelWithoutAnExactSolution) {
  StudyReport study = without_errors(sample_study());
  study.runs = {study.runs[0], study.runs[1]};
  EXPECT_THAT(
      verdict_text(study),
      AllOf(
          StartsWith("At the end the two methods are 2.00 % of the largest displacement apart. On "
                     "the same nodes SPH takes 1.60 times the seconds of finite volume"),
          HasSubstr("One level without an exact solution does not say which of them errs less"),
          Not(HasSubstr("errs less:"))));
}

TEST(Verdict, ComparesErrorBarsWhereThereIsNoExactSolution) {
  StudyReport study = without_errors(test::full_study());
  EXPECT_THAT(verdict_text(study),
              AllOf(StartsWith("Neither method is nearer to convergence: on level 2 each"),
                    HasSubstr("On strain energy they agree within their error bars.")));
  auto& series = study.quantities.begin()->second;
  series[0].points.back() = {2, 0.0625, 1.2, 0.04};
  EXPECT_THAT(
      verdict_text(study),
      AllOf(StartsWith(
                "Finite volume is nearer to convergence: on level 2 it has the narrower error bar "
                "on 1 of 1 quantities"),
            HasSubstr("They agree within their error bars on 0 of 1 quantities, but not on "
                      "strain energy.")));
}

TEST(Verdict, GivesOneReasonOfManyQuantitiesOnce) {
  StudyReport study = without_errors(test::full_study());
  const auto resolved = study.quantities.begin()->second;
  for (GridSeries& series : study.quantities.begin()->second)
    series.estimate.reset();
  const auto unresolved = study.quantities.begin()->second;
  study.quantities[{"tip", "m"}] = unresolved;
  EXPECT_THAT(verdict_text(study), StartsWith("All 2 quantities are unresolved: each method has "
                                              "fewer than three levels."));
  study.quantities[{"width", "m"}] = resolved;
  EXPECT_THAT(verdict_text(study),
              HasSubstr("2 of 3 quantities are unresolved: strain energy and tip (each method has "
                        "fewer than three levels)."));
}

TEST(Verdict, IsGivenOfWhatBothMethodsResolveOnly) {
  StudyReport study = without_errors(test::full_study());
  // the scale is that of the values, 1.17
  auto& series = study.quantities.begin()->second;
  const GridConvergence good = *series[0].estimate;
  const auto verdict_with = [&](const std::optional<GridConvergence>& estimate) {
    series[0].estimate = estimate;
    return verdict_text(study);
  };
  EXPECT_THAT(verdict_with(good), HasSubstr("On strain energy they agree within"));
  for (const auto& [estimate, why] :
       std::vector<std::pair<std::optional<GridConvergence>, std::string>>{
           {std::nullopt, "SPH has fewer than three levels"},
           {GridConvergence{Convergence::oscillating, NAN, NAN, 0.01, 0.01, 0.1}, "SPH oscillates"},
           {GridConvergence{Convergence::monotone, 1.4, 1, 0.01, 0.01, 0.1},
            "SPH shows order 1.4 (its own is 2)"},
           {GridConvergence{Convergence::monotone, 2.6, 1, 0.01, 0.01, 0.1}, "SPH shows order 2.6"},
           {GridConvergence{Convergence::monotone, 2, 1, 0.07, 0.07, 0.1},
            "SPH has an error bar of 6 %"}}) {
    EXPECT_THAT(verdict_with(estimate),
                AllOf(StartsWith("1 of 1 quantities is unresolved: strain energy (" + why),
                      Not(HasSubstr("agree within"))));
  }
  EXPECT_THAT(verdict_with(GridConvergence{Convergence::oscillating, NAN, NAN, 0.01, 0.01, 0.01}),
              AllOf(HasSubstr("is unresolved: strain energy (SPH oscillates). Of these the methods "
                              "are no further apart than three times"),
                    HasSubstr("is little, on strain energy.")));
  series[0].points.back().value += 0.1;
  EXPECT_THAT(
      verdict_with(GridConvergence{Convergence::oscillating, NAN, NAN, 0.01, 0.01, 0.01}),
      HasSubstr("They are further apart than that, although the levels change by little, on "
                "strain energy."));
  series[0].points.back().value -= 0.1;
  series[0].formal_order = {3, 3};  // of a method that sums by parts
  EXPECT_THAT(verdict_with(GridConvergence{Convergence::monotone, 2.6, 1, 0.01, 0.01}),
              HasSubstr("agree within"));
}

TEST(Verdict, NamesWhatBrokeDownFirst) {
  StudyReport study = sample_study();
  study.breakdowns = {{"fvm", 2, 0.0125, 250, 17, "J = -0.1 <= 0\nF = ...", {{0, 0.5, 1}}}};
  study.runs.erase(study.runs.begin() + 4);  // nothing of it is kept
  ASSERT_EQ(study.runs.back().method, "sph");
  EXPECT_THAT(verdict_text(study),
              StartsWith("Finite volume broke down on level 2 at t = 0.0125 s, in step 250 at node "
                         "17, (0, 0.5, 1) m: J = -0.1 &lt;= 0. SPH errs less: on level 1 "));
  study.runs = {sample_run("sph", 0)};
  study.breakdowns = {{"fvm", 2, 0.0125, 250, -1, "the time step collapsed"}};
  EXPECT_THAT(
      verdict_text(study),
      AllOf(StartsWith("Finite volume broke down on level 2 at t = 0.0125 s, in step 250: "
                       "the time step collapsed."),
            HasSubstr("SPH on level 0: the error of its velocity is 1.60 %, for 0.0800 s")));
}

TEST(Verdict, SaysOfOneMethodWhatItsErrorIsAndHowItFalls) {
  StudyReport study = sample_study();
  study.runs = {sample_run("sph", 0), sample_run("sph", 1)};
  study.runs[1].inverted_from = 0.25;
  EXPECT_THAT(verdict_text(study),
              AllOf(StartsWith("Cells of SPH lie inside out from t = 0.250 s on"),
                    HasSubstr("SPH on level 1: the error of its velocity is 0.400 % and falls with "
                              "order 2.0, for 1.28 s in the time loop.")));
}

TEST(Verdict, AlwaysSaysSomething) {
  EXPECT_THAT(verdict_text({}), HasSubstr("nothing to say"));
  StudyReport study;
  study.runs = {sample_run("fvm", 0)};
  study.runs[0].errors.clear();
  study.runs[0].status = "interrupted";
  EXPECT_THAT(verdict_text(study),
              HasSubstr("Finite volume did not come to its end on level 0: interrupted."));
}

TEST(Price, IsReadOffTheLinesBetweenTheRunsInLogLog) {
  const StudyReport study = sample_study();
  const auto price =
      price_of_error(runs_of(study.runs, "sph"), runs_of(study.runs, "fvm"), "velocity");
  ASSERT_TRUE(price.has_value());
  EXPECT_DOUBLE_EQ(price->error, 0.008);
  // half way in log between 1.6 % and 0.4 %: sqrt(0.08 * 1.28)
  EXPECT_NEAR(price->first, 0.32, 1e-12);
  EXPECT_NEAR(price->second, 12.8, 1e-12);
  EXPECT_FALSE(price_of_error({sample_run("sph", 0)}, {sample_run("fvm", 0)}, "velocity"));
}

}  // namespace
}  // namespace diptych::report
