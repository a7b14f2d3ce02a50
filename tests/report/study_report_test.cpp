/// The page: balanced, loads nothing, its numbers are the study's, nothing in it can break out.

#include "postprocess/report/study_report.hpp"

#include "common/base/error.hpp"
#include "postprocess/report/html.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

namespace diptych::report {
namespace {

using nlohmann::json;
using test::message_of;
using test::sample_study;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string chart_text = "/*! Chart.js v3.9.1 */ window.Chart = function () {};";

std::string page(const StudyReport& study) {
  return report_html(study, chart_text);
}

/// Walks the tags of a page; scripts and styles hold text up to their end tag. Returns what is
/// wrong.
std::string imbalance(const std::string& html) {
  const std::array<std::string, 4> void_elements{"meta", "link", "br", "input"};
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-zA-Z][a-zA-Z0-9]*)([^>]*)>");
  auto from = html.cbegin();
  for (std::smatch match; std::regex_search(from, html.cend(), match, tag);) {
    const std::string name = match[2];
    from = match[0].second;
    if (match[1] == "/") {
      if (open.empty() || open.back() != name) {
        return "</" + name + "> closes <" + (open.empty() ? "" : open.back()) + ">";
      }
      open.pop_back();
    } else if (std::find(void_elements.begin(), void_elements.end(), name) == void_elements.end()) {
      open.push_back(name);
      if (name == "script" || name == "style") {
        const size_t end = html.find("</" + name, static_cast<size_t>(from - html.cbegin()));
        if (end == std::string::npos) return name + " does not end";
        from = html.cbegin() + static_cast<std::ptrdiff_t>(end);
      }
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

json data_of(const std::string& html) {
  const std::string start = "<script type=\"application/json\" id=\"study\">";
  const size_t from = html.find(start) + start.size();
  return json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(StudyReport, HasBalancedTags) {
  EXPECT_EQ(imbalance(page(sample_study())), "");
  EXPECT_EQ(imbalance("<p><b></p>"), "</p> closes <b>") << "the check itself can fail";
}

TEST(StudyReport, LoadsNothingFromAnywhere) {
  std::string html = page(sample_study());
  const std::string name_of_svg = "http://www.w3.org/2000/svg";  // a name, which nothing loads
  for (size_t at = html.find(name_of_svg); at != std::string::npos; at = html.find(name_of_svg))
    html.erase(at, name_of_svg.size());
  EXPECT_FALSE(std::regex_search(html, std::regex("(https?:)?//[a-z0-9.-]+\\.[a-z]{2,}")));
  // url(#...) is a part of the same file
  EXPECT_FALSE(std::regex_search(html, std::regex("\\bsrc=|@import|url\\((?!#)|fetch\\(|XMLHttp")));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(StudyReport, CarriesTheNumbersOfTheStudy) {
  const json study = data_of(page(sample_study()));
  EXPECT_EQ(study["methods"][0]["name"], "sph");
  EXPECT_EQ(study["methods"][1]["title"], "Finite volume");
  const json& runs = study["methods"][0]["runs"];
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1]["errors"]["velocity"], 0.004);
  EXPECT_EQ(runs[1]["seconds"], 0.08 * 16);
  EXPECT_EQ(study["fields"]["deformation_gradient"], "deformation gradient");
  const json& history = study["methods"][1]["history"];
  EXPECT_EQ(history["viscous"], json({0.0, 0.25, 0.5, 0.75, 1.0}));
  // start 3 J and the work since
  EXPECT_EQ(history["supplied"], json({3.0, 3.125, 3.25, 3.375, 3.5}));
}

TEST(StudyReport, ShowsOrdersAndProvenance) {
  const std::string html = page(sample_study());
  EXPECT_THAT(html, HasSubstr("<td class=\"order\">2.00</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"order\">1.00</td>"));
  EXPECT_THAT(html, HasSubstr("4.00 × 10<sup>−3</sup>"));
  EXPECT_THAT(html, AllOf(HasSubstr("0.1.0 c0ffee"), HasSubstr("d00d"), HasSubstr("tau_C = 2 ms")));
}

TEST(StudyReport, CountsRejectedStepsWhereThereAreSuch) {
  StudyReport study = sample_study();
  EXPECT_THAT(page(study), Not(HasSubstr("rejected)")));
  study.runs.front().rejected_steps = 4;
  EXPECT_THAT(page(study), HasSubstr("<td>60 (4 rejected)</td>"));
}

TEST(StudyReport, BeginsWithAVerdictThatNamesABreakdownFirst) {
  StudyReport study = sample_study();
  std::string html = page(study);
  const size_t verdict = html.find("<section id=\"verdict\">");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, html.find("<section id=\"panels\">"));
  EXPECT_THAT(html, HasSubstr("<p class=\"verdict\">SPH errs less: on level 2"));
  study.breakdowns = {{"fvm", 2, 0.0125, 250, 17, "J < 0"}};
  html = page(study);
  EXPECT_EQ(imbalance(html), "");
  EXPECT_THAT(html,
              HasSubstr("<h2>Verdict</h2>\n<p class=\"verdict missed\">Finite volume broke down on "
                        "level 2 at t = 0.0125 s, in step 250 at node 17: J &lt; 0.</p>"));
}

TEST(StudyReport, ShowsMemoryAndStatusOfEveryRun) {
  StudyReport study = sample_study();
  for (io::RunSummary& run : study.runs)
    run.peak_rss_bytes = (run.method == "sph" ? 20'000'000LL : 30'000'000LL) << run.level;
  study.runs[0].status = "step limit";
  const std::string html = page(study);
  for (const char* memory : {"20.0", "40.0", "80.0", "30.0", "60.0", "120"})
    EXPECT_THAT(html, HasSubstr(std::string("<td>") + memory + "</td></tr>"));
  EXPECT_THAT(html, HasSubstr("<td>step limit</td></tr>"));
}

TEST(StudyReport, ShowsProbesShapesAndQuantitiesWhereTheStudyHasThem) {
  const std::string full = page(test::full_study()), plain = page(sample_study());
  EXPECT_EQ(imbalance(full), "");
  for (const char* id : {"\"shapes\"", "\"probes\"", "\"quantities\"", "\"probe-1\"",
                         "\"shape-sph\"", "\"shape-fvm\"", "\"shape-difference\""}) {
    EXPECT_THAT(full, HasSubstr(std::string("id=") + id));
    EXPECT_THAT(plain, Not(HasSubstr(std::string("id=") + id)));
  }
  EXPECT_THAT(full, HasSubstr("<h3>tip &lt;z&gt; [m]</h3>"));
  EXPECT_THAT(full, HasSubstr("<td>0.5</td><td>−1.25</td><td>2</td><td>0.25</td>"));
  EXPECT_THAT(full, HasSubstr("± 0.0125"));
  EXPECT_THAT(full, HasSubstr("<td>agree</td>"));
  const json study = data_of(full);
  EXPECT_EQ(study["probes"][0]["name"], "tip <z>");
  EXPECT_EQ(study["methods"][0]["history"]["probes"][1], json({0.0, 0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(study["quantities"][0]["series"][1]["points"][1]["bar"], 0.12);
  EXPECT_EQ(study["shapes"]["times"].size(), 3u);
}

TEST(StudyReport, SetsTheCurvesAgainstTheExactSolutionAndValuesFromElsewhere) {
  const std::string html = report_html(test::full_study(), "");
  EXPECT_THAT(html, HasSubstr("id=\"exact-0\""));
  EXPECT_THAT(html, HasSubstr("Reference: Doe &lt;i&gt;et al.&lt;/i&gt;, table 2."));
  EXPECT_THAT(html, HasSubstr("\"tip \\u003cz>\":[0.0,0.84,0.91,0.14,-0.76]"));
  EXPECT_THAT(
      html, HasSubstr("\"references\":[{\"probe\":\"tip \\u003cz>\",\"points\":[[0.0015,1.0]]}]"));
  // kinetic energy of the methods, for the same plot
  EXPECT_THAT(html, HasSubstr("\"others\":[[2.0,1.5,1.0,0.5,0.0]]"));
  EXPECT_THAT(report_html(test::sample_study(), ""), HasSubstr("\"exact\":null"));
}

TEST(StudyReport, HasNoSectionForWhatWasNotAsked) {
  StudyReport study = sample_study();
  EXPECT_THAT(page(study), HasSubstr("id=\"convergence\""));
  study.runs = {test::sample_run("sph", 1), test::sample_run("fvm", 1)};  // one level: no orders
  EXPECT_THAT(page(study), Not(HasSubstr("id=\"convergence\"")));
}

TEST(StudyReport, StaysBelowFiveMegabytesAtItsBounds) {
  StudyReport study = test::full_study();
  // 6 (n + 1)^2 points, and as many instants as such a surface may have
  study.shapes = test::sample_shapes(24, static_cast<int>(most_point_frames / 3750));
  for (auto& [method, rows] : study.histories) {
    io::HistoryRow row;
    row.time = 1 / 3.0;
    row.energy = {1 / 3.0, 1 / 7.0, 1 / 9.0, 0.1, 0.7, 1e-9};
    row.probes.assign(10, 1 / 3.0);
    rows.assign(100'000, row);
  }
  // Chart.js 3.9 has 200 kB
  EXPECT_LT(page(study).size() + 200'000, 5'000'000u);
}

TEST(StudyReport, LetsNothingBreakOut) {
  StudyReport study = sample_study();
  const std::string hostile = "</script><script>alert(1)</script><!--\"&'";
  study.title = study.description = hostile;
  study.material = {hostile};
  study.breakdowns = {{hostile, 0, 0, 0, 0, hostile}};
  study.differences[hostile] = 1;
  for (io::RunSummary& run : study.runs) {
    run.case_name = run.title = run.status = run.provenance.cpu = hostile;
    run.errors[hostile] = {1, 1, 1};
  }
  study.runs[0].method = hostile;
  study.shapes = test::sample_shapes(1, 2);
  study.shapes["sph"].fields[0] = {hostile, hostile};
  io::QuantitySummary quantity;
  quantity.name = quantity.unit = hostile;
  for (io::RunSummary& run : study.runs)
    run.quantities.push_back(quantity);
  study.quantities[{hostile, hostile}] = test::full_study().quantities.begin()->second;
  const std::string html = page(study);
  EXPECT_EQ(imbalance(html), "");
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(report_html(sample_study(), "x = '</SCRIPT><!--'; Chart.js v3."),
              HasSubstr("x = '<\\/SCRIPT><\\!--'"));
}

TEST(StudyReport, TakesStudiesWithAlmostNothingInThem) {
  EXPECT_EQ(imbalance(page({})), "");
  StudyReport study;
  study.runs = {test::sample_run("fvm", 0)};
  study.runs[0].errors.clear();
  study.runs[0].status = "broke down";
  study.runs[0].energy.relative_residual = std::numeric_limits<double>::quiet_NaN();
  const std::string html = page(study);
  EXPECT_EQ(imbalance(html), "");
  EXPECT_THAT(html, HasSubstr("no exact solution"));
  EXPECT_THAT(html, HasSubstr("this run ended as: broke down"));
  const size_t body = html.find("<body>");
  EXPECT_THAT(html.substr(body, html.find("<script", body) - body),
              Not(testing::ContainsRegex("[ >]-?nan[ <]")));
}

TEST(Numbers, ReadAsPeopleWriteThem) {
  EXPECT_EQ(number_html(0), "0");
  EXPECT_EQ(number_html(452.3), "452");
  EXPECT_EQ(number_html(-15.64), "−15.6");
  EXPECT_EQ(number_html(0.0625), "0.0625");
  EXPECT_EQ(number_html(0.00416), "0.00416");
  EXPECT_EQ(number_html(12500), "12\u202f500");
  EXPECT_EQ(number_html(-1.234e-5), "−1.23 × 10<sup>−5</sup>");
  EXPECT_EQ(number_html(3e7), "3.00 × 10<sup>7</sup>");
  EXPECT_EQ(number_html(std::numeric_limits<double>::infinity()), "n/a");
  EXPECT_EQ(count_html(-1234567), "−1\u202f234\u202f567");
  EXPECT_EQ(count_html(123), "123");
}

TEST(ChartScript, NamesThePackageWhereItIsMissingOrAnother) {
  const test::Scratch folder;
  EXPECT_THAT(message_of<base::EnvironmentError>([&] { chart_script(folder / "none.js"); }),
              AllOf(HasSubstr("none.js"), HasSubstr("apt-get install libjs-chart.js")));
  io::write_file_atomically(folder / "old.js", "/* Chart.js v2.9.4 */");
  EXPECT_THAT(message_of<base::EnvironmentError>([&] { chart_script(folder / "old.js"); }),
              HasSubstr("version 3 or 4"));
}

TEST(WriteReport, PutsTheInstalledChartJsIntoThePage) {
  if (!std::filesystem::exists(chart_script_path())) {
    GTEST_SKIP() << "no Chart.js here: apt-get install libjs-chart.js";
  }
  const test::Scratch folder;
  write_report(folder / "report.html", sample_study());
  const std::string html = io::read_file(folder / "report.html");
  EXPECT_GT(html.size(), 200'000u);
  EXPECT_EQ(imbalance(html), "");
  EXPECT_EQ(data_of(html)["methods"].size(), 2u);
}

}  // namespace
}  // namespace diptych::report
