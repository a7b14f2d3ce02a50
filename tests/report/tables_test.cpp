/// Tables for the terminal: aligned, at most 100 columns, with the orders of the sample.

#include "benchmarks/terminal/tables.hpp"

#include "benchmarks/run/history_differences.hpp"
#include "benchmarks/terminal/reference_table.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <limits>
#include <sstream>

namespace diptych::harness {
namespace {

using test::sample_run;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    result.push_back(line);
  return result;
}

void expect_fits_a_terminal(const std::string& text) {
  for (const std::string& line : lines(text)) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    EXPECT_FALSE(line.ends_with(' ')) << "'" << line << "'";
  }
  EXPECT_TRUE(text.ends_with('\n'));
}

TEST(ComparisonTable, TellsHowFarHistoriesAreApart) {
  std::vector<io::HistoryRow> one(4), other(4);
  for (size_t i = 0; i < 4; ++i) {
    one[i].probes = {static_cast<double>(i), 0};
    other[i].probes = {static_cast<double>(i) + (i == 3 ? 1 : 0), 0};
  }
  const auto apart = history_differences({"tip", "zero"}, one, other);
  EXPECT_DOUBLE_EQ(apart.at("tip"), 0.5 / 4);  // sqrt(1/4) of the largest, 4
  EXPECT_EQ(apart.at("zero"), 0);
  io::RunSummary sph = sample_run("sph", 1), fvm = sample_run("fvm", 1);
  sph.quantities.resize(1);
  sph.quantities[0].name = "tip";
  sph.quantities[0].unit = "m";
  fvm.quantities = sph.quantities;
  const std::string text = comparison_table(sph, fvm, {}, apart);
  expect_fits_a_terminal(text);
  EXPECT_THAT(text, ContainsRegex("tip \\[m\\], final +0 +0 .*1.25e-01\n"));
}

TEST(ComparisonTable, SetsTheMethodsBesideEachOther) {
  const std::string text =
      comparison_table(sample_run("sph", 1), sample_run("fvm", 1), {{"velocity", 6.1e-4}});
  expect_fits_a_terminal(text);
  EXPECT_THAT(text, HasSubstr("swinging-cube, level 1"));
  EXPECT_THAT(text, ContainsRegex("nodes +1000 +1000 +1.00"));
  EXPECT_THAT(text, ContainsRegex("time loop \\[s\\] +1.28 +0.8000 +1.60"));
  EXPECT_THAT(text, ContainsRegex("per node and stage \\[ns\\] +452 +252"));
  EXPECT_THAT(text, ContainsRegex("velocity v +4.00e-03 +1.60e-02 +0.2500 +6.10e-04"));
  EXPECT_THAT(text, ContainsRegex("stress P +1.35e-02 +5.40e-02 +0.2500 +-\n"));
  EXPECT_THAT(text, ContainsRegex("energy residual +3.00e-06 +3.00e-06\n"));
}

TEST(ComparisonTable, ShowsWhatIsMissingAsADash) {
  io::RunSummary sph = sample_run("sph", 0), fvm = sample_run("fvm", 0);
  sph.errors.clear();
  fvm.errors.clear();
  fvm.loop_seconds = 0;
  sph.energy.relative_residual = std::numeric_limits<double>::quiet_NaN();
  const std::string text = comparison_table(sph, fvm, {{"displacement", 1e-3}});
  expect_fits_a_terminal(text);
  EXPECT_THAT(text, ContainsRegex("displacement u +- +- +- +1.00e-03"));
  EXPECT_THAT(text, ContainsRegex("time loop \\[s\\] +0.0800 +0 +-\n"));
  EXPECT_THAT(text, ContainsRegex("energy residual +- +3.00e-06\n"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(ConvergenceTable, ShowsTheOrdersOfTheSample) {
  const std::string sph =
      convergence_table({sample_run("sph", 2), sample_run("sph", 0), sample_run("sph", 1)});
  expect_fits_a_terminal(sph);
  EXPECT_THAT(sph, ContainsRegex("\n +0 +0.2500 +125 +0.0800 +1.60e-02 +- "));
  EXPECT_THAT(sph, ContainsRegex("\n +1 +0.1250 +1000 +1.28 +4.00e-03 +2.00 "));
  EXPECT_THAT(sph, ContainsRegex("\n +2 +0.0625 +8000 +20.5 +1.00e-03 +2.00 "));
  EXPECT_THAT(convergence_table({sample_run("fvm", 0), sample_run("fvm", 1)}),
              ContainsRegex("1.60e-02 +1.00 "));
}

TEST(ConvergenceTable, KeepsItsWidthWithManyFieldsAndLargeRuns) {
  io::RunSummary run = sample_run("sph", 0);
  run.nodes = 1'000'000'000, run.loop_seconds = 1.2e6, run.spacing = 1e-5;
  for (const char* name : {"a_rather_long_name_of_a_field", "b", "c", "d", "e"}) {
    run.errors[name] = {1, 1e-100, 1};
  }
  const std::string text = convergence_table({run, sample_run("fvm", 0)});
  expect_fits_a_terminal(text);
  const auto all = lines(text);
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [](const auto& line) { return line.find("spacing [m]") != line.npos; }),
            6)
      << "two methods, nine fields by four";
}

TEST(ConvergenceTable, ListsRunsWithoutErrors) {
  io::RunSummary run = sample_run("sph", 0);
  run.errors.clear();
  EXPECT_THAT(convergence_table({run}), ContainsRegex("\n +0 +0.2500 +125 +0.0800\n"));
}

TEST(ReferenceTable, SaysOfEachRunWhetherItIsWithinTheUncertainty) {
  io::RunSummary sph = sample_run("sph", 0), fvm = sample_run("fvm", 0);
  EXPECT_EQ(reference_table({sph, fvm}), "");
  io::ReferenceSummary one;
  one.name = one.probe = "tip";
  one.source = "Doe 1999";
  one.greatest = 0.5;
  one.greatest_at = 0.25;
  one.until = 2;
  one.uncertainty = 0.01;
  sph.references = {one};
  one.greatest = 0.01;
  fvm.references = {one};
  fvm.variant = "sbp";
  const std::string text = reference_table({sph, fvm});
  EXPECT_THAT(text, HasSubstr("tip, +-0.01: Doe 1999\n"));
  EXPECT_THAT(text, ContainsRegex("  sph +0 +0.5 +0.25 +0 +0 +2  NOT met, 50 times\n"));
  EXPECT_THAT(text, ContainsRegex("  fvm-sbp +0 +0.01 .* met\n"));
  expect_fits_a_terminal(text);
  const ReferenceTimes times{{"tip", {0.5, 1, 2, 3}}};
  fvm.end_time = 0.7;
  EXPECT_THAT(reference_table({sph, fvm}, times),
              ContainsRegex("  fvm-sbp +0 +0.01 .* met at 1 of 4 times\n"));
  EXPECT_EQ(uncertainty_verdict(one, 3, times), "met");
  one.uncertainty.reset();
  EXPECT_EQ(uncertainty_verdict(one), "none stated");
}

}  // namespace
}  // namespace diptych::harness
