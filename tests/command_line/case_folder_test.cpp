/// Other people's cases: --cases and paths for every verb that takes a case, and folders without
/// one.

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
using tests::small_case;
using tests::write_case;

class CaseFolder : public testing::Test {
 protected:
  CaseFolder() {
    write_case(folder_, "mine", "strip", small_case("A strip"));
    write_case(folder_, "mine", "stripe", small_case("Another"));
    std::filesystem::create_directories(folder_.path() / "mine" / "notes");
  }
  ~CaseFolder() override {
    for (const char* name : {"DIPTYCH_CASES", "DIPTYCH_BASELINES"})
      unsetenv(name);
  }
  tests::Outcome program(const std::string& arguments) const { return diptych(folder_, arguments); }
  Folder folder_;
};

TEST_F(CaseFolder, IsListedInPlaceOfTheShippedCases) {
  const auto list = program("list --cases mine");
  EXPECT_EQ(list.exit_code, 0) << list.text;
  EXPECT_THAT(list.text, AllOf(HasSubstr("strip "), HasSubstr("A strip"), HasSubstr("Another"),
                               Not(HasSubstr("impact")), Not(HasSubstr("notes"))));
  const auto some = program("list mine/stripe impact");
  EXPECT_EQ(some.exit_code, 0) << some.text;
  EXPECT_THAT(some.text,
              AllOf(HasSubstr("Another"), HasSubstr("impact"), Not(HasSubstr("A strip"))));
}

TEST_F(CaseFolder, IsWhereEveryVerbLooksUpNames) {
  for (const std::string verb :
       {"run strip --quiet --no-fields --out o1", "compare strip --quiet --no-fields --out o2",
        "converge strip --levels 2 --quiet --out o3",
        "study strip --stability --method fvm --integrators leapfrog --steps 40 --quiet --out o4",
        "check strip",
        "material strip --path shear-ramp --rate 100 --end 1e-3 --steps 10 --out o5"}) {
    const auto outcome = program(verb + " --cases mine");
    EXPECT_EQ(outcome.exit_code, 0) << verb << '\n' << outcome.text;
    const auto misspelt = program("check sttrip --cases mine");
    EXPECT_EQ(misspelt.exit_code, 2);
    EXPECT_THAT(misspelt.text, HasSubstr("no case 'sttrip' in mine; did you mean 'strip'?"));
  }
  EXPECT_THAT(program("check impact --cases mine").text, HasSubstr("no case 'impact' in mine"));
  setenv("DIPTYCH_CASES", "mine", 1);
  EXPECT_EQ(program("check strip").exit_code, 0);
  EXPECT_EQ(program("check strip --cases elsewhere").exit_code, 2) << "the option comes first";
}

TEST_F(CaseFolder, TakesPathsToo) {
  for (const std::string path : {"mine/strip", "mine/strip/", "./mine/strip/case.toml"}) {
    EXPECT_EQ(program("check " + path).exit_code, 0) << path;
    EXPECT_EQ(program("check --cases mine " + path).exit_code, 0) << path;
  }
  const auto folder = program("check mine");
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_THAT(folder.text, HasSubstr("'mine' has no case.toml"));
  EXPECT_THAT(folder.text, HasSubstr("--cases mine"));
  EXPECT_THAT(program("check mine/strap/case.toml").text,
              HasSubstr("no case file 'mine/strap/case.toml'"));
}

TEST_F(CaseFolder, WithoutACaseIsAnError) {
  std::filesystem::create_directories(folder_.path() / "empty");
  for (const std::string verb : {"list", "regress --baselines b", "check strip"}) {
    const auto empty = program(verb + " --cases empty");
    EXPECT_EQ(empty.exit_code, 2) << empty.text;
    EXPECT_THAT(empty.text, HasSubstr("no case in 'empty': expected empty/NAME/case.toml"));
    const auto gone = program(verb + " --cases gone");
    EXPECT_EQ(gone.exit_code, 2) << gone.text;
    EXPECT_THAT(gone.text, HasSubstr("no case in 'gone', which is no folder"));
  }
  EXPECT_THAT(program("list --cases mine/strip").text,
              HasSubstr("'mine/strip' is a case, not a folder of cases"));
  setenv("DIPTYCH_CASES", "/moved/away", 1);
  for (const std::string verb : {"list", "regress", "check impact"}) {
    const auto moved = program(verb);
    EXPECT_EQ(moved.exit_code, 2) << moved.text;
    EXPECT_THAT(moved.text, AllOf(HasSubstr("no case in '/moved/away'"), Not(HasSubstr("met"))));
  }
}

TEST_F(CaseFolder, ShowsTheOthersWhereOneCannotBeRead) {
  write_case(folder_, "mine", "broken", "title = 3\n");
  const auto list = program("list --cases mine");
  EXPECT_EQ(list.exit_code, 2);
  EXPECT_THAT(list.text, AllOf(HasSubstr("A strip"), HasSubstr("mine/broken/case.toml:1"),
                               HasSubstr("1 of 3 cases cannot be read")));
}

}  // namespace
}  // namespace diptych
