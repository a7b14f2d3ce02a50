/// `diptych regress` on other people's cases: sizes, files for CI, cases that break.

#include "tests/command_line/small_case.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::small_case;
using tests::text_of;
using tests::write_case;

class RegressCases : public testing::Test {
 protected:
  RegressCases() { write_case(folder_, "mine", "strip", small_case("A strip")); }
  tests::Outcome regress(const std::string& arguments) const {
    return diptych(folder_, "regress --threads 1 --quiet --cases mine --baselines b " + arguments);
  }
  tests::Outcome checked() const { return regress("--junit out/r.xml --json r.json"); }
  nlohmann::json json() const { return nlohmann::json::parse(text_of(folder_.path() / "r.json")); }
  nlohmann::json baseline(const std::string& name) const {
    return nlohmann::json::parse(text_of(folder_.path() / "b" / (name + ".json")));
  }
  /// The suite of a case in the JUnit file.
  pugi::xml_node suite(const std::string& name) {
    const auto result = document_.load_file((folder_.path() / "out" / "r.xml").c_str());
    EXPECT_TRUE(result) << result.description();
    return document_.child("testsuites").find_child_by_attribute("testsuite", "name", name.c_str());
  }
  Folder folder_;
  pugi::xml_document document_;
};

TEST_F(RegressCases, ArePassedByWhatWasRecordedAndFailedByAnotherModulus) {
  const auto first = regress("--bless strip --why first");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("size: the case as it stands, levels 0 and 1"));
  const auto passing = checked();
  EXPECT_EQ(passing.exit_code, 0) << passing.text;
  EXPECT_EQ(json()["verdict"], "met");
  EXPECT_GT(suite("strip").attribute("tests").as_int(), 50);
  EXPECT_EQ(suite("strip").attribute("failures").as_int(-1), 0);
  EXPECT_EQ(suite("strip").attribute("errors").as_int(-1), 0);
  std::set<std::string> names;
  for (const auto& test : suite("strip").children("testcase")) {
    const std::string name =
        test.attribute("classname").value() + std::string("/") + test.attribute("name").value();
    EXPECT_TRUE(names.insert(name).second) << name << " stands twice: readers drop the second";
  }

  std::string text = small_case("A strip");
  text.replace(text.find("E = 2e6"), 7, "E = 2.1e6");
  write_case(folder_, "mine", "strip", text);
  const auto failing = checked();
  EXPECT_EQ(failing.exit_code, 5) << failing.text;
  EXPECT_EQ(json()["verdict"], "failed");
  EXPECT_EQ(json()["exit_code"], 5);
  EXPECT_GT(suite("strip").attribute("failures").as_int(), 5);
  const auto test = suite("strip").find_child_by_attribute("name", "quantities: strain energy");
  EXPECT_THAT(test.child("failure").attribute("message").value(),
              AllOf(HasSubstr("measured 0.0"), HasSubstr("bound 1.49e-08")));
}

TEST_F(RegressCases, AreRecordedAtTheSizeThatIsAsked) {
  const auto short_of_five = regress("--bless strip --why small --set time.end=5e-5");
  EXPECT_EQ(short_of_five.exit_code, 2);
  EXPECT_THAT(short_of_five.text, HasSubstr("the canary makes five"));
  const auto asked = regress(
      "--bless strip --why small --set time.end=2e-4 --set output.frames=1 --levels 1 "
      "--one-level-because 'a test'");
  ASSERT_EQ(asked.exit_code, 0) << asked.text;
  EXPECT_THAT(asked.text, HasSubstr("--set time.end=2e-4"));
  EXPECT_EQ(baseline("strip")["set"], nlohmann::json::array({"time.end=2e-4", "output.frames=1"}));
  EXPECT_EQ(baseline("strip")["levels"], 1);
  EXPECT_EQ(baseline("strip")["one_level_because"], "a test");
  EXPECT_EQ(baseline("strip")["methods"]["fvm"]["quantities"]["end time"]["value"], 2e-4);
  EXPECT_EQ(checked().exit_code, 0);

  ASSERT_EQ(regress("--bless strip --why 'kept size'").exit_code, 0);
  EXPECT_EQ(baseline("strip")["set"].size(), 2u);
  EXPECT_EQ(baseline("strip")["levels"], 1);
  ASSERT_EQ(regress("--bless strip --why 'new size' --set time.end=3e-4 --levels 2").exit_code, 0);
  EXPECT_EQ(baseline("strip")["set"], nlohmann::json::array({"time.end=3e-4"}));
  EXPECT_EQ(baseline("strip")["one_level_because"], "");
}

TEST_F(RegressCases, AreNotRecordedAsTheyStandWhereThatIsLong) {
  std::string text = small_case("Long");
  text.replace(text.find("end = 5e-4"), 10, "end = 1000");
  write_case(folder_, "mine", "long", text);
  const auto refused = regress("--bless long --why first");
  EXPECT_EQ(refused.exit_code, 2) << refused.text;
  EXPECT_THAT(refused.text, AllOf(HasSubstr("long: as it stands"), HasSubstr("--set time.end=")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b" / "long.json"));
}

TEST_F(RegressCases, AskForASizeOfOneCaseThatIsWhole) {
  for (const std::string wrong :
       {"--set time.end=1", "--levels 2", "--bless all --why a --set time.end=1",
        "--bless strip --why a --levels 3", "--bless strip --why a --levels 1",
        "--bless strip --why a --one-level-because b", "--bless strip --why a --json x",
        "--junit x --json x", "strip mine/strip"}) {
    const auto outcome = regress(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong << '\n' << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b"));
}

TEST_F(RegressCases, NeedBaselinesOfTheirOwn) {
  for (const std::string arguments : {"regress --cases mine", "regress mine/strip"}) {
    const auto outcome = diptych(folder_, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.text, HasSubstr("give --baselines DIR"));
  }
  const auto none = checked();
  EXPECT_EQ(none.exit_code, 5) << none.text;
  EXPECT_THAT(none.text, AllOf(HasSubstr("no baseline"), HasSubstr("--bless strip")));
  const auto test = suite("strip").find_child_by_attribute("name", "record: no baseline");
  EXPECT_THAT(test.child("failure").attribute("message").value(), HasSubstr("b/strip.json"));
}

TEST_F(RegressCases, GoOnWhereOneCannotBeReadAndOneBreaksDown) {
  ASSERT_EQ(regress("--bless strip --why first").exit_code, 0);
  write_case(folder_, "mine", "torn", small_case("Torn"));
  ASSERT_EQ(regress("--bless torn --why first").exit_code, 0);
  std::string text = small_case("Torn");
  text.replace(text.find("10*x"), 4, "-9e4*x");  // turned inside out at once
  write_case(folder_, "mine", "torn", text);
  const auto torn = checked();
  EXPECT_EQ(torn.exit_code, 3) << torn.text;
  EXPECT_GT(suite("torn").attribute("errors").as_int(), 0);
  const auto test = suite("torn").find_child_by_attribute("name", "run: breakdown");
  EXPECT_STREQ(test.child("error").attribute("type").value(), "breakdown");

  write_case(folder_, "mine", "broken", "title = 3\n");
  const auto broken = checked();
  EXPECT_EQ(broken.exit_code, 2) << broken.text;
  EXPECT_THAT(broken.text, HasSubstr("FAILED case: cannot be read: mine/broken/case.toml:1"));
  EXPECT_EQ(suite("broken").attribute("errors").as_int(), 1);
  EXPECT_GT(suite("strip").attribute("tests").as_int(), 50);
  EXPECT_EQ(json()["totals"]["cases"], 3);
  EXPECT_EQ(json()["exit_code"], 2);
}

TEST_F(RegressCases, MayAskForPassNumbersInPlaceOfABaseline) {
  write_case(folder_, "mine", "strip",
             small_case("A strip") + "[expect]\nholds = [\"kinetic growth <= 1\"]\n");
  const auto met = checked();
  EXPECT_EQ(met.exit_code, 0) << met.text;
  EXPECT_EQ(json()["totals"]["met"], 8);
  write_case(folder_, "mine", "strip",
             small_case("A strip") + "[expect]\nholds = [\"kinetic growth <= 0.5\"]\n");
  EXPECT_EQ(checked().exit_code, 5);
  write_case(folder_, "mine", "strip",
             small_case("A strip") + "[expect]\nholds = [\"kinetic grwth <= 1\"]\n");
  const auto misspelt = checked();
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.text, HasSubstr("did you mean 'kinetic growth'?"));
  EXPECT_EQ(regress("--bless all --why 'what is there'").exit_code, 2) << "asked all the same";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b" / "strip.json"));
}

TEST_F(RegressCases, NameBaselinesWithoutACase) {
  ASSERT_EQ(regress("--bless strip --why first").exit_code, 0);
  write_case(folder_, "mine", "kept", small_case("Kept"));
  ASSERT_EQ(regress("--bless kept --why first").exit_code, 0);
  std::filesystem::remove_all(folder_.path() / "mine" / "strip");
  const auto orphaned = checked();
  EXPECT_EQ(orphaned.exit_code, 5) << orphaned.text;
  EXPECT_THAT(orphaned.text, HasSubstr("strip.json: no case of this name in mine"));
  EXPECT_EQ(regress("kept").exit_code, 0) << "only what is named";
}

TEST_F(RegressCases, LeaveNoFileOfAnEarlierCheckBehind) {
  ASSERT_EQ(regress("--bless strip --why first").exit_code, 0);
  ASSERT_EQ(checked().exit_code, 0);
  // killed while it runs: a case of a thousand seconds, at the size of another
  std::string text = small_case("A strip");
  text.replace(text.find("end = 5e-4"), 10, "end = 1000");
  write_case(folder_, "mine", "strip", text);
  const auto killed = diptych(
      folder_,
      "list --cases mine >/dev/null; " + tests::build_folder() +
          "/diptych regress --quiet --cases mine --baselines b --junit out/r.xml --json r.json & "
          "pid=$!; for i in $(seq 200); do grep -q '\"running' r.json && break; sleep 0.05; done; "
          "kill -9 $pid; wait $pid");
  EXPECT_EQ(json()["verdict"], "running") << killed.text;
  EXPECT_EQ(suite("diptych regress").attribute("errors").as_int(), 1);
  EXPECT_FALSE(suite("strip"));
  const auto unwritable = regress("--junit /proc/r.xml");
  EXPECT_EQ(unwritable.exit_code, 4) << unwritable.text;
  EXPECT_THAT(unwritable.text, Not(HasSubstr("met")));
}

}  // namespace
}  // namespace diptych
