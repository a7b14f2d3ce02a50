/// Runs of cases with an exact solution record it; differences and errors are on one scale.

#include "benchmarks/run/run_case.hpp"
#include "benchmarks/study/study.hpp"
#include "common/cases/reader.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace diptych::harness {
namespace {

/// A bar that swings along x in its first mode between a clamp and a free end, as in the case
/// vibrating-bar: u = U sin(omega t) sin(k x), omega = 1 / s, at small strain.
const std::string swinging = R"toml([parameters]
U = 1e-3
k = "pi/2"
rho = 3
[mesh]
element = "quadrilateral"
upper = [1, 0.5]
cells = [8, 4]
[material]
model = "neo-hookean"
density = "rho"
shear_modulus = "rho/k^2/4"
lame = "rho/k^2/2"
[initial]
velocity = ["U*sin(k*x)", 0]
[[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = ["y_min", "y_max"]
type = "symmetry"
[time]
end = "END"
[output]
frames = 4
[exact]
displacement = ["U*sin(t)*sin(k*x)", 0]
velocity = ["U*cos(t)*sin(k*x)", 0]
[[probe]]
name = "tip"
unit = "m"
at = [1, 0]
quantity = "ux"
[[probe]]
name = "work"
unit = "J"
kind = "mean"
quantity = "vx*uy"
[[probe]]
name = "hold"
unit = "N/m"
kind = "reaction"
group = "x_min"
direction = [1, 0]
)toml";

cases::Case case_until(const std::string& end) {
  std::string text = swinging;
  text.replace(text.find("END"), 3, end);
  return cases::case_from_text(text, "scene");
}

const io::HistoryColumn* find(const std::vector<io::HistoryColumn>& columns, const char* name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const auto& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

TEST(ExactRecord, SaysWhereItBeginsWithAnotherMotion) {
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  const auto told =
      testing::Contains(testing::HasSubstr("velocity of the exact solution is not that"));
  EXPECT_THAT(run_case(case_until("0.1"), options).summary.notices, testing::Not(told));
  std::string text = swinging;
  text.replace(text.find("END"), 3, "0.1");
  text.replace(text.find("U*cos(t)"), 8, "U*sin(t)");
  EXPECT_THAT(run_case(cases::case_from_text(text, "scene"), options).summary.notices, told);
}

TEST(Notices, TellOfEnergiesThatAreRounding) {
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  std::string text = swinging.substr(0, swinging.find("[exact]"));
  text.replace(text.find("END"), 3, "0.1");
  text.replace(text.find("U = 1e-3"), 8, "U = 1e-9");
  EXPECT_THAT(run_case(cases::case_from_text(text, "scene"), options).summary.notices,
              testing::Contains(testing::HasSubstr("strain energy is what rounding leaves of it")));
}

TEST(ExactRecord, HoldsProbesKineticEnergyAndMomentaThatAreNotZero) {
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  const RunResult result = run_case(case_until("1"), options);
  ASSERT_EQ(result.exact.front().name, "time");
  ASSERT_EQ(result.exact.front().values.size(), 5u);
  const auto* tip = find(result.exact, "tip");
  ASSERT_NE(tip, nullptr);
  EXPECT_EQ(tip->unit, "m");
  const auto* kinetic = find(result.exact, "kinetic energy");
  const auto* momentum = find(result.exact, "linear momentum x");
  ASSERT_TRUE(kinetic != nullptr && momentum != nullptr);
  for (size_t i = 0; i < 5; ++i) {
    const double t = result.exact.front().values[i];
    EXPECT_DOUBLE_EQ(t, result.history[i].time);
    EXPECT_DOUBLE_EQ(tip->values[i], 1e-3 * std::sin(t));
    // rho/2 int v^2 dV = rho/2 * U^2 cos^2(t) / 4; the trapezoidal sum of sin^2 is exact
    EXPECT_NEAR(kinetic->values[i], 3 * 0.5e-6 * std::pow(std::cos(t), 2) / 4, 1e-18);
    // int sin(k x) dx = 1/k, by trapezoids of 1/8 to (k h)^2/12
    EXPECT_NEAR(momentum->values[i], 3e-3 * 0.5 * std::cos(t) * 2 / std::numbers::pi, 1e-5);
  }
  EXPECT_EQ(find(result.exact, "linear momentum y"), nullptr) << "it is zero throughout";
  EXPECT_EQ(find(result.exact, "hold"), nullptr) << "no field tells the force of a support";
  EXPECT_NE(find(result.exact, "work"), nullptr);
}

// At t = pi the exact displacement is zero: relative to that, a difference would be enormous.
TEST(Differences, AreRelativeToTheLargestNormOverTime) {
  StudyOptions options;
  options.threads = 1;
  options.quiet = true;
  const Study study = run_study(case_until("pi"), options);
  ASSERT_EQ(study.runs.size(), 2u);
  const double between = study.differences.at("displacement");
  const double a = study.runs[0].errors.at("displacement").l2;
  const double b = study.runs[1].errors.at("displacement").l2;
  EXPECT_GT(between, 0);
  // on one scale the triangle inequality holds, in both directions
  EXPECT_LE(between, 1.000001 * (a + b));
  EXPECT_GE(between, 0.999999 * std::abs(a - b));
}

/// No ratio to zero, nor to what rounding leaves of it, nor a figure in m/s among relative ones.
TEST(ExactRecord, OfFieldsAtRestIsRelativeToTheirNaturalSizes) {
  const std::string rest = R"toml([mesh]
element = "quadrilateral"
upper = [4, 1]
cells = [8, 2]
[material]
model = "neo-hookean"
density = 3
shear_modulus = 4
lame = 4
[initial]
velocity = [1e-3, 0]
[time]
end = 1
[exact]
displacement = ["1e-3*t", 0]
velocity = [0, "1e-17*sin(x)"]
stress = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]
)toml";
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  const auto summary = run_case(cases::case_from_text(rest, "scene"), options).summary;
  EXPECT_NEAR(summary.errors.at("velocity").l2, 1e-3 / 2, 1e-9) << "c_p is 2 m/s";
  EXPECT_NEAR(summary.errors.at("velocity").linf, 1e-3 / 2, 1e-9);
  EXPECT_LT(summary.errors.at("displacement").l2, 1e-12);
  EXPECT_LT(summary.errors.at("stress").l2, 1e-12) << "of rho c_p^2 = 12 Pa";
  EXPECT_THAT(summary.notices, testing::Contains(testing::HasSubstr(
                                   "the exact stress, velocity are zero at all output times")));
}

}  // namespace
}  // namespace diptych::harness
