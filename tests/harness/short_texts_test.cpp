/// Numbers in messages and tables have a bounded width, whatever they are.

#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/run_table.hpp"
#include "benchmarks/terminal/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <sstream>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

TEST(ShortTexts, OfBytes) {
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(2.94e12), "2.94 TB");
  EXPECT_LT(bytes_text(1e300).size(), 12u);
}

TEST(ShortTexts, OfDurations) {
  EXPECT_EQ(duration_text(12.2), "12 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
  EXPECT_EQ(duration_text(1e6), "11 days 13 h");
  // once -153722867280912930 min
  EXPECT_EQ(duration_text(1e30), "more than 30 years");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "more than 30 years");
  EXPECT_EQ(duration_text(std::nan("")), "unknown time");
  EXPECT_EQ(duration_text(-3), "unknown time");
}

TEST(ShortTexts, OfRejectedSteps) {
  io::RunSummary summary;
  EXPECT_THAT(run_table(summary), testing::Not(HasSubstr("made again")));
  summary.rejected_steps = 1;
  EXPECT_THAT(run_table(summary), HasSubstr("1 attempt at a step was rejected and made again"));
  summary.rejected_steps = 12;
  EXPECT_THAT(run_table(summary), HasSubstr("12 attempts at steps were rejected and made again"));
}

TEST(ShortTexts, OfARunWithoutASingleStep) {
  io::RunSummary summary;
  summary.status = "interrupted";
  summary.min_jacobian = summary.least_cell_J = 1e300;  // of no values: once 302 digits
  EXPECT_THAT(run_table(summary), HasSubstr("least J not measured (cells not measured)"));
  summary.min_jacobian = 0.7346821;
  summary.dt_min = summary.dt_max = summary.loop_seconds = 1e300;
  summary.nanoseconds_per_node_stage = summary.mean_neighbours = 1e300;
  summary.energy.strain = -1e300;
  const std::string table = run_table(summary);
  EXPECT_THAT(table, HasSubstr("least J 0.734682 "));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LT(line.size(), 200u) << line;
}

}  // namespace
}  // namespace diptych::harness
