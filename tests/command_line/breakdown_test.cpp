/// A method that breaks down does not take the other one with it: who, when, where and why stand
/// in the table, in the report and in the summary, and the program ends with code 3.

#include "common/io/field_writer.hpp"
#include "common/io/run_record.hpp"
#include "tests/command_line/program.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <regex>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Each;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

/// A cube that is thrown at itself, `a` times its length a second, too fast for the budgets of so
/// few steps; the exact velocity is there so that errors have something to be measured against. No
/// step is tried again.
std::string crushed(const std::string& a) {
  return "[mesh]\nelement = \"hexahedron\"\ncells = [4, 4, 4]\n"
         "[material]\nmodel = \"neo-hookean\"\ndensity = 1100\nyoungs_modulus = 17e6\n"
         "poissons_ratio = 0.3\n[time]\nend = 4e-3\nmax_retries = 0\n[guards]\nenergy_residual = "
         "0.1\n"
         "involution = 1\n[sph]\ngradient = \"corrected\"\n[fvm]\nstencil = "
         "\"edge\"\n[exact]\nvelocity = [\"-1\", \"0\", "
         "\"0\"]\n"
         "[initial]\nvelocity = [\"-" +
         a + "*x\", \"0\", \"0\"]\n";
}

io::RunSummary summary_in(const fs::path& directory) {
  return io::summary_from_json(text_of(directory / "summary.json"), "summary.json");
}

TEST(Breakdown, OfBothMethodsIsToldOfBoth) {
  for (const char* verb : {"run", "compare"}) {
    const Folder folder;
    folder.write("case.toml", crushed("3e4"));
    const auto outcome =
        diptych(folder, std::string(verb) + " case.toml --quiet --threads 1 --out out");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
    for (const char* method : {"sph", "fvm"}) {
      const std::string directory = "out/" + std::string(method);
      const auto summary = summary_in(folder.path() / directory);
      EXPECT_EQ(summary.status, "breakdown");
      ASSERT_TRUE(summary.failure.has_value());
      EXPECT_TRUE(summary.failure->node && summary.failure->step && summary.failure->place);
      EXPECT_THAT(
          outcome.text,
          HasSubstr("diptych: " + std::string(method) + " level 0 broke down: " +
                    summary.failure->message.substr(0, summary.failure->message.find('\n'))));
    }
    EXPECT_TRUE(std::regex_search(
        outcome.text, std::regex("broke down +level +time \\[s\\] +step +node +place \\[m\\]")));
    if (verb == std::string("compare")) {
      const std::string page = text_of(folder.path() / "out" / "report.html");
      EXPECT_THAT(page, AllOf(HasSubstr("broke down on level 0"), HasSubstr("J &lt;= 0")));
      // what both had until then
      EXPECT_THAT(page, AllOf(HasSubstr("this run ended as: breakdown"),
                              HasSubstr("<section id=\"shapes\">"), Not(HasSubstr("has no run"))));
    }
  }
}

/// With supports that hold too few particles at corners.
TEST(Refusal, OfOneMethodLeavesTheOtherToRun) {
  const std::string narrow = " --set sph.kappa=0.6";
  for (const char* verb : {"run", "compare"}) {
    const Folder folder;
    folder.write("case.toml", crushed("1"));
    const std::string command =
        std::string(verb) + " case.toml --quiet --threads 1 --set time.max_steps=2 --out out";
    const auto one = diptych(folder, command + narrow);
    EXPECT_EQ(one.exit_code, 2) << one.text;
    EXPECT_THAT(one.text, AllOf(HasSubstr("diptych: sph level 0 was refused: particle 0 at"),
                                HasSubstr("raise sph.kappa")));
    EXPECT_EQ(summary_in(folder.path() / "out" / "fvm").steps, 2);
    EXPECT_FALSE(fs::exists(folder.path() / "out" / "sph"));
    const auto both =
        diptych(folder, command + "2 --set initial.displacement=[\\\"-2*x\\\",0,0]" + narrow);
    EXPECT_EQ(both.exit_code, 2) << both.text;
    EXPECT_THAT(both.text, AllOf(HasSubstr("no method takes the case"), HasSubstr("gives J = -1")));
    EXPECT_FALSE(fs::exists(folder.path() / "out2"));
  }
}

TEST(Refusal, OfAVariantLeavesTheOtherColumnsToRun) {
  for (const char* verb : {"compare", "converge"}) {
    const Folder folder;
    folder.write("case.toml", crushed("1"));
    const auto outcome =
        diptych(folder, std::string(verb) +
                            " case.toml --quiet --threads 1 --set time.max_steps=2 "
                            "--out out --with \"small: sph.kappa=0.5\"" +
                            (verb == std::string("converge") ? " --levels 2" : ""));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("diptych: sph-small level 0 was refused: particle"),
                                    HasSubstr("raise sph.kappa")));
    const fs::path first =
        folder.path() / "out" / (verb == std::string("converge") ? "level_0" : "");
    for (const char* method : {"sph", "fvm"})
      EXPECT_EQ(summary_in(first / method).steps, 2);
    EXPECT_FALSE(fs::exists(first / "sph-small"));
    if (verb == std::string("compare")) {
      EXPECT_TRUE(fs::exists(folder.path() / "out" / "report.html"));
    }
  }
}

/// What is left of a step that has failed for good is the state before it, to be looked at.
TEST(Breakdown, LeavesTheLastGoodState) {
  const Folder folder;
  folder.write("case.toml", crushed("3e4"));
  const auto outcome = diptych(
      folder, "run case.toml --quiet --threads 1 --method fvm --out out --set time.max_retries=5");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  const fs::path run = folder.path() / "out" / "fvm";
  const auto summary = summary_in(run);
  EXPECT_GT(summary.rejected_steps, 0);
  ASSERT_TRUE(summary.failure && summary.failure->step && summary.failure->node);
  EXPECT_EQ(*summary.failure->step, summary.steps + 1);
  const auto frames = io::read_series((run / "run.hdf.series").string());
  ASSERT_EQ(frames.size(), 2u) << "that of t = 0 and that of the last good state";
  EXPECT_EQ(frames.back().time, summary.end_time);
  EXPECT_GT(summary.end_time, 0);
  EXPECT_THAT(summary.failure->message, HasSubstr("is in out/fvm/frame_0001.hdf"));
  EXPECT_THAT(io::read_field(frames.back().path, "jacobian [-]").values, Each(Gt(0)));
  const auto rows = io::history_from_csv(text_of(run / "history.csv"), "history.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.back().time, summary.end_time);
}

/// Nothing of the step that fails is kept: the latest checkpoint is of the state before it, whole,
/// and goes on to the same end.
TEST(Breakdown, LeavesTheLastCheckpoint) {
  const Folder folder;
  folder.write("case.toml", crushed("3e4"));
  const std::string line =
      "run case.toml --quiet --threads 1 --method fvm --out out --set time.max_retries=5 "
      "--set time.checkpoint_every=1";
  EXPECT_EQ(diptych(folder, line).exit_code, 3);
  const fs::path run = folder.path() / "out" / "fvm";
  const auto summary = summary_in(run);
  ASSERT_TRUE(summary.failure && summary.failure->step);
  ASSERT_GT(summary.steps, 1);
  const auto checkpoint = [&](std::int64_t step) {
    return run / fmt::format("checkpoint_{:08}.hdf", step);
  };
  EXPECT_TRUE(fs::exists(checkpoint(*summary.failure->step - 1)));
  EXPECT_FALSE(fs::exists(checkpoint(*summary.failure->step)));
  EXPECT_EQ(diptych(folder, "check out").exit_code, 0);
  const auto again = diptych(folder, line + " --restart latest");
  EXPECT_EQ(again.exit_code, 3) << again.text;
  const auto same = summary_in(run);
  ASSERT_TRUE(same.failure.has_value());
  EXPECT_EQ(same.restarts, 1);
  EXPECT_EQ(same.failure->step, summary.failure->step);
  EXPECT_EQ(same.failure->node, summary.failure->node);
  EXPECT_EQ(same.state_hash, summary.state_hash);
}

/// At this speed SPH breaks down on level 0 and on no other; the finite volumes never do.
class OneOfTwo : public testing::Test {
 protected:
  OneOfTwo() {
    std::string text = crushed("750");  // which turns cells and turns them back on level 1
    text.insert(text.find("energy_residual"), "inverted_cells = \"warn\"\n");
    folder.write("case.toml", text);
  }
  tests::Outcome with(const std::string& verb, const std::string& options = "") const {
    return diptych(folder, verb + " case.toml --quiet --threads 1 --out out " + options);
  }
  fs::path out(const std::string& name) const { return folder.path() / "out" / name; }
  Folder folder;
};

TEST_F(OneOfTwo, GoesOnInRun) {
  const auto outcome = with("run");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_EQ(summary_in(out("sph")).status, "breakdown");
  EXPECT_EQ(summary_in(out("fvm")).status, "done");
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("fvm level 0: 125 nodes"), HasSubstr("status done"),
                                  Not(HasSubstr("sph level 0: 125 nodes"))));
}

TEST_F(OneOfTwo, GoesOnInCompare) {
  const auto outcome = with("compare");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  const auto summary = summary_in(out("sph"));
  ASSERT_TRUE(summary.failure && summary.failure->node && summary.failure->time) << outcome.text;
  EXPECT_GT(*summary.failure->time, 0);
  EXPECT_LT(*summary.failure->time, 4e-3);
  EXPECT_GE(*summary.failure->step, summary.steps);
  EXPECT_EQ(summary_in(out("fvm")).status, "done");
  EXPECT_THAT(outcome.text, HasSubstr("report: out/report.html"));
  const std::string page = text_of(out("report.html"));
  EXPECT_THAT(page, HasSubstr("broke down on level 0"));
  EXPECT_THAT(page, HasSubstr("node " + std::to_string(*summary.failure->node)));
}

TEST_F(OneOfTwo, GoesOnInConverge) {
  const auto outcome = with("converge", "--levels 2");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_EQ(summary_in(out("level_0/sph")).status, "breakdown");
  for (const char* run : {"level_0/fvm", "level_1/sph", "level_1/fvm"})
    EXPECT_EQ(summary_in(out(run)).status, "done") << run;
  const std::string csv = text_of(out("convergence.csv"));
  EXPECT_THAT(
      csv, AllOf(HasSubstr("fvm,velocity error L2,-,0,"), HasSubstr("sph,velocity error L2,-,1,"),
                 Not(HasSubstr("sph,velocity error L2,-,0,"))));
  EXPECT_THAT(text_of(out("report.html")), HasSubstr("broke down on level 0"));
  const auto again = with("converge", "--levels 2");
  EXPECT_EQ(again.exit_code, 3) << "what broke down is tried again, and told again";
  EXPECT_THAT(again.text, AllOf(HasSubstr("taken over, not run again: out/level_1/sph"),
                                Not(HasSubstr("not run again: out/level_0/sph"))));
}

TEST_F(OneOfTwo, GoesOnInAStudy) {
  const auto outcome = with("study", "--levels 2 --repeats 2");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("broke down"));
  const std::string csv = text_of(out("work_precision.csv"));
  EXPECT_THAT(csv, AllOf(HasSubstr("fvm,0,"), HasSubstr("fvm,1,"), HasSubstr("sph,1,"),
                         Not(HasSubstr("sph,0,"))));
}

}  // namespace
}  // namespace diptych
