/// Commands of several runs say which one is under way and how long all will take.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <regex>

namespace diptych {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::Folder;

// a run of an hour, of which the log shows the line after two seconds; nothing is known of FVM
TEST(ProgressOfACommand, SaysWhichRunIsUnderWayWithTheTimeOfTheScene) {
  const Folder folder;
  const auto outcome = tests::diptych(
      folder,
      "list > /dev/null; timeout --preserve-status -s TERM 4 " + tests::build_folder() +
          "/diptych compare swinging-cube-ve2-hex --level 2 --threads 1 --set time.end=100 --out "
          "out");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.text;
  const std::regex line(
      "sph level 2, run 1 of 2 +0 %  step \\d+  dt \\S+ s  t \\S+ of 100 s  .* left  ");
  EXPECT_TRUE(std::regex_search(outcome.text, line)) << outcome.text;
  EXPECT_THAT(outcome.text, Not(HasSubstr("all runs")));
}

TEST(ProgressOfACommand, CountsTheRunsOfAllTablesOfVerify) {
  const Folder folder;
  const auto outcome = tests::diptych(folder, "verify affine-space --threads 1 --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(std::regex_search(outcome.text, std::regex("; 1 of 6\n"))) << outcome.text;
  EXPECT_TRUE(std::regex_search(outcome.text, std::regex("; 5 of 6, about \\d+ s left\n")));
}

TEST(ProgressOfACommand, TellsTheTimeThatCasesToComeWillTake) {
  const Folder folder;
  const auto outcome = tests::diptych(folder, "regress pull cable-smooth --threads 1 --out out");
  EXPECT_TRUE(
      std::regex_search(outcome.text, std::regex("1 of 2: pull, \\S+ s; about \\d+ s left\n")))
      << outcome.text;
  EXPECT_TRUE(std::regex_search(outcome.text, std::regex("2 of 2: cable-smooth, \\S+ s\n")));
}

}  // namespace
}  // namespace diptych
