/// Runs that time.max_steps ends before the end of their case: every command says which, and none
/// sets what they came to beside values of another time.

#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

class StepLimit : public testing::Test {
 protected:
  StepLimit() { tests::write_case(folder, "cases", "strip", tests::small_case("A strip")); }
  tests::Outcome made(const std::string& command) const {
    return diptych(folder, command + " --threads 1 --quiet");
  }
  /// Of a run of the finite volumes on a level, to its end.
  int steps(int level) const {
    const std::string out = "whole" + std::to_string(level);
    made("run cases/strip --method fvm --no-fields --out " + out + " --level " +
         std::to_string(level));
    return static_cast<int>(tests::summary_in(folder.path() / out / "fvm").steps);
  }
  Folder folder;
};

TEST_F(StepLimit, IsToldByARun) {
  const auto run = made("run cases/strip --method fvm --out out --set time.max_steps=2");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("fvm level 0 ended at its step limit (time.max_steps): step 2, "
                                  "t = "));
}

TEST_F(StepLimit, LeavesNothingToCompare) {
  const auto both = made("compare cases/strip --out out --set time.max_steps=2");
  EXPECT_EQ(both.exit_code, 2) << both.text;
  EXPECT_THAT(both.text, AllOf(HasSubstr("diptych: sph level 0 ended at its step limit"),
                               HasSubstr("diptych: fvm level 0 ended at its step limit"),
                               Not(HasSubstr("apart"))));
  EXPECT_THAT(text_of(folder.path() / "out" / "report.html"),
              HasSubstr("this run ended as: step limit"));
}

TEST_F(StepLimit, LeavesLevelsOutOfAConvergenceTableAndSaysSo) {
  const std::string limit = std::to_string(steps(0));  // level 1 takes twice as many
  const auto some = made(
      "converge cases/strip --method fvm --levels 2 --out out "
      "--set time.max_steps=" +
      limit);
  EXPECT_EQ(some.exit_code, 2) << some.text;
  EXPECT_THAT(
      some.text,
      AllOf(HasSubstr("values at the end"),
            HasSubstr("fvm level 1 ended at its step limit (time.max_steps): step " + limit),
            Not(HasSubstr("level 0 ended"))));
  EXPECT_THAT(text_of(folder.path() / "out" / "convergence.csv"), Not(HasSubstr("J,1,")));
}

TEST_F(StepLimit, LeavesRunsOutOfAStudy) {
  const auto some = made(
      "study cases/strip --method fvm --levels 1 --vary "
      "time.max_steps=0,2 --out out");
  EXPECT_EQ(some.exit_code, 2) << some.text;
  EXPECT_THAT(some.text, HasSubstr("fvm-max_steps=2 level 0 ended at its step limit"));
  EXPECT_THAT(text_of(folder.path() / "out" / "quantities.csv"), Not(HasSubstr("max_steps=2")));
}

TEST_F(StepLimit, IsNoBaseline) {
  const std::string regress = "regress --cases cases --baselines b --out out ";
  const auto refused = made(regress + "--bless strip --set time.max_steps=6 --why w");
  EXPECT_EQ(refused.exit_code, 2) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("fvm level 0 ended at its step limit"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b" / "strip.json"));
}

TEST_F(StepLimit, IsUnfinishedInAnAtlas) {
  folder.write("limits.toml",
               "title = \"Limits\"\ncase = \"cases/strip\"\nmethods = [\"fvm\"]\n[[axis]]\nname = "
               "\"limit\"\nkey = \"time.max_steps\"\nvalues = [0, 2]\n");
  const auto map = made("study limits.toml --atlas --out out");
  EXPECT_EQ(map.exit_code, 0) << map.text;
  EXPECT_THAT(map.text,
              AllOf(HasSubstr("Of 2 points 1 are stable"), HasSubstr("1 ended at their step limit"),
                    HasSubstr("1 unfinished: step limit")));
  EXPECT_THAT(text_of(folder.path() / "out" / "atlas.csv"), HasSubstr(",unfinished,"));
  folder.write("two.toml",
               "title = \"Two\"\ncase = \"cases/strip\"\nmethods = [\"fvm\"]\n[[axis]]\nname = "
               "\"limit\"\nkey = \"time.max_steps\"\nvalues = [1, 2]\n");
  const auto none = made("study two.toml --atlas --out out2");
  EXPECT_EQ(none.exit_code, 2) << none.text;
  EXPECT_THAT(none.text, HasSubstr("no point came to its end"));
}

}  // namespace
}  // namespace diptych
