/// What a regression says to other programs is read by parsers, whatever cases and messages hold.

#include "benchmarks/regression/report.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>

namespace diptych::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A case with a check of every verdict, and one that cannot be read.
RegressReport sample() {
  const RegressCheck met = checked("canary", "F norm", 1e-16, 1e-13, "1, was 1");
  const RegressCheck beyond = checked("errors", "velocity L2", 0.25, 1e-8, "2 < 3 & \"4\"");
  RegressCheck known = checked("agreement", "least J", 3, 1);
  known.verdict = Verdict::known;
  const RegressCheck skipped{"agreement", "", Verdict::skipped, 0, 0, "one level only: <dear>"};
  const RegressCheck broken =
      failure("run", "breakdown", "J <= 0\nat node 3", base::ExitCode::breakdown);
  RegressReport report;
  report.state = RegressState::done;
  report.n_wanted = 2;
  report.seconds = 3.5;
  report.cases_folder = "my cases";
  report.provenance.version = "0.1.0";
  report.provenance.date = "2026-01-02T03:04:05Z";
  report.cases = {{"bar",
                   "my cases/bar/case.toml",
                   "b/bar.json",
                   3,
                   {{"bar", "sph", {met, beyond}, 2}, {"bar", "both", {known, skipped}, 0}}},
                  {"plate", "", "", 0.5, {{"plate", "fvm", {broken}, 0.5}}}};
  return report;
}

pugi::xml_document parsed(const RegressReport& report) {
  pugi::xml_document document;
  const auto result = document.load_string(junit_xml(report).c_str(), pugi::parse_full);
  EXPECT_TRUE(result) << result.description();
  return document;
}

std::vector<std::string> attributes(const pugi::xml_node& node) {
  std::vector<std::string> names;
  for (const auto& attribute : node.attributes())
    names.emplace_back(attribute.name());
  return names;
}

/// The counts that a suite states are those of its test cases.
void expect_counts(const pugi::xml_node& suite) {
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  for (const auto& test : suite.children("testcase")) {
    ++tests;
    failures += test.child("failure") ? 1 : 0;
    errors += test.child("error") ? 1 : 0;
    skipped += test.child("skipped") ? 1 : 0;
  }
  EXPECT_EQ(suite.attribute("tests").as_int(-1), tests);
  EXPECT_EQ(suite.attribute("failures").as_int(-1), failures);
  EXPECT_EQ(suite.attribute("errors").as_int(-1), errors);
  EXPECT_EQ(suite.attribute("skipped").as_int(-1), skipped);
}

TEST(JUnit, HasTheElementsAndAttributesOfItsSchema) {
  const auto document = parsed(sample());
  EXPECT_THAT(junit_xml(sample()), StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
  const auto suites = document.child("testsuites");
  ASSERT_TRUE(suites);
  EXPECT_THAT(attributes(suites), ElementsAre("name", "tests", "failures", "errors", "time"));
  EXPECT_EQ(suites.attribute("tests").as_int(), 5);
  EXPECT_EQ(suites.attribute("failures").as_int(), 1);
  EXPECT_EQ(suites.attribute("errors").as_int(), 1);
  std::vector<std::string> names;
  for (const auto& suite : suites.children()) {
    ASSERT_STREQ(suite.name(), "testsuite");
    EXPECT_THAT(attributes(suite),
                ElementsAre("name", "tests", "failures", "errors", "skipped", "time", "timestamp"));
    EXPECT_STREQ(suite.attribute("timestamp").value(), "2026-01-02T03:04:05");
    EXPECT_STREQ(suite.first_child().name(), "properties");
    names.emplace_back(suite.attribute("name").value());
    expect_counts(suite);
    for (const auto& test : suite.children("testcase")) {
      EXPECT_THAT(attributes(test), ElementsAre("classname", "name", "time"));
      EXPECT_LE(std::distance(test.begin(), test.end()), 1);
    }
  }
  EXPECT_THAT(names, ElementsAre("bar", "plate"));
}

TEST(JUnit, TellsWhatFailedByHowMuchAndWhatWasSkippedWhy) {
  const auto document = parsed(sample());
  const auto bar = document.child("testsuites").child("testsuite");
  const auto failed = bar.find_child_by_attribute("testcase", "name", "errors: velocity L2");
  EXPECT_STREQ(failed.attribute("classname").value(), "bar.sph");
  EXPECT_STREQ(failed.attribute("time").value(), "1.000");  // two checks share 2 s
  EXPECT_STREQ(failed.child("failure").attribute("message").value(),
               "velocity L2: measured 0.25, bound 1e-08");
  EXPECT_STREQ(failed.child("failure").attribute("type").value(), "bound");
  EXPECT_THAT(failed.child("failure").text().get(), HasSubstr("2 < 3 & \"4\""));
  const auto known = bar.find_child_by_attribute("testcase", "name", "agreement: least J");
  EXPECT_THAT(known.child("system-out").text().get(), HasSubstr("known"));
  const auto skipped = bar.find_child_by_attribute("testcase", "name", "agreement");
  EXPECT_STREQ(skipped.child("skipped").attribute("message").value(), "one level only: <dear>");
  const auto error = bar.next_sibling().child("testcase").child("error");
  EXPECT_STREQ(error.attribute("type").value(), "breakdown");
  EXPECT_STREQ(error.attribute("message").value(), "breakdown: J <= 0");
  EXPECT_THAT(error.text().get(), HasSubstr("J <= 0\nat node 3"));
}

TEST(JUnit, HoldsAnyBytes) {
  RegressReport report = sample();
  std::string bytes;
  for (int byte = 1; byte < 256; ++byte)
    bytes += static_cast<char>(byte);
  const std::string sound = "Zug \xC3\xA9 \xE2\x82\xAC \xF0\x9D\x84\x9E ]]>";
  const std::string broken = "\xED\xA0\x80 \xC0\xAF \xEF\xBF\xBE \xF4\x90\x80\x80 \xE2\x82";
  report.cases[0].name = bytes;
  report.cases[0].rows[0].checks[1].note = sound + broken;
  const std::string text = junit_xml(report);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    EXPECT_TRUE(byte >= 0x20 || c == '\n' || c == '\t' || c == '\r') << static_cast<int>(byte);
  }
  EXPECT_EQ(text.find("&#01;"), std::string::npos);
  const auto document = parsed(report);
  const auto suite = document.child("testsuites").child("testsuite");
  EXPECT_THAT(suite.attribute("name").value(), HasSubstr("<=>?@ABC"));
  const std::string details =
      suite.find_child_by_attribute("testcase", "name", "errors: velocity L2")
          .child("failure")
          .text()
          .get();
  EXPECT_THAT(details, HasSubstr(sound + "\xEF\xBF\xBD"));
  EXPECT_EQ(details.find("\xED\xA0\x80"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::accept(regress_json(report)));
}

TEST(JUnit, OfARegressionThatHasNotEndedHasAnError) {
  for (const RegressState state : {RegressState::running, RegressState::interrupted}) {
    RegressReport report = sample();
    report.state = state;
    report.cases.pop_back();
    const auto document = parsed(report);
    const auto last = document.child("testsuites").last_child();
    expect_counts(last);
    EXPECT_STREQ(last.child("testcase").child("error").attribute("type").value(), "interrupted");
    EXPECT_THAT(last.child("testcase").child("error").attribute("message").value(),
                HasSubstr("1 of 2 cases are checked"));
  }
}

TEST(RegressJson, HasItsDocumentedKeys) {
  const auto json = nlohmann::json::parse(regress_json(sample()));
  const auto keys = [](const nlohmann::json& object) {
    std::set<std::string> names;
    for (const auto& item : object.items())
      names.insert(item.key());
    return names;
  };
  EXPECT_EQ(keys(json), (std::set<std::string>{"format", "format_version", "verdict", "exit_code",
                                               "seconds", "cases_folder", "baselines_folder",
                                               "totals", "provenance", "cases", "checks"}));
  EXPECT_EQ(json["verdict"], "failed");
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_EQ(json["totals"], nlohmann::json::parse(R"({"cases": 2, "cases_wanted": 2, "checks": 5,
      "met": 1, "known": 1, "failed": 2, "skipped": 1})"));
  EXPECT_EQ(json["cases"][1]["verdict"], "failed");
  EXPECT_EQ(json["checks"][1], nlohmann::json::parse(R"({"case": "bar", "method": "sph",
      "check": "errors", "figure": "velocity L2", "verdict": "failed", "kind": "bound",
      "measured": 0.25, "at_least": false, "bound": 1e-8, "note": "2 < 3 & \"4\""})"));
  EXPECT_EQ(json["checks"][0]["kind"], nullptr);
  EXPECT_EQ(json["checks"][3]["measured"], nullptr);
  EXPECT_EQ(json["checks"][4]["kind"], "breakdown");
  EXPECT_EQ(json["checks"][4]["bound"], nullptr);
}

TEST(RegressJson, SaysWhetherItHasEnded) {
  RegressReport report = sample();
  report.state = RegressState::running;
  EXPECT_EQ(nlohmann::json::parse(regress_json(report))["verdict"], "running");
  EXPECT_EQ(nlohmann::json::parse(regress_json(report))["exit_code"], nullptr);
  report.state = RegressState::interrupted;
  EXPECT_EQ(nlohmann::json::parse(regress_json(report))["exit_code"], 130);
}

TEST(RegressExitCode, IsOfTheKindThatSaysMostAboutTheRest) {
  using base::ExitCode;
  const auto code = [](std::vector<ExitCode> codes) {
    std::vector<RegressRow> rows;
    for (const ExitCode c : codes)
      rows.push_back({"c", "sph", {failure("run", "x", "y", c)}});
    return exit_code_of(rows);
  };
  EXPECT_EQ(code({}), ExitCode::done);
  EXPECT_EQ(code({ExitCode::bound_not_met}), ExitCode::bound_not_met);
  EXPECT_EQ(code({ExitCode::bound_not_met, ExitCode::breakdown}), ExitCode::breakdown);
  EXPECT_EQ(code({ExitCode::breakdown, ExitCode::wrong_input}), ExitCode::wrong_input);
  EXPECT_EQ(code({ExitCode::environment, ExitCode::wrong_input}), ExitCode::environment);
}

}  // namespace
}  // namespace diptych::harness
