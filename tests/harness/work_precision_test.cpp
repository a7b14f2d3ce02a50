/// Interpolation of error against cost on curves of known powers.

#include "benchmarks/study/work_precision.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

/// error = c h^order, seconds = s h^-4 with h = 2^-level; the slowest repetition 10 % above.
WorkCurve curve(const std::string& method, double c, double order, double s) {
  WorkCurve curve{"", method, {}};
  for (int level = 0; level < 4; ++level) {
    WorkPoint point;
    point.run.method = method;
    point.run.level = level;
    point.run.nodes = 100 << (3 * level);
    point.run.pairs = 10 * point.run.nodes;
    point.run.stages = 10 << level;
    const double h = std::pow(0.5, level);
    point.run.errors["velocity"] = {0, c * std::pow(h, order), 0};
    point.least = s * std::pow(h, -4);
    point.most = 1.1 * point.least;
    curve.points.push_back(point);
  }
  return curve;
}

// Powers are straight in log-log: interpolation is exact up to rounding.
TEST(WorkPrecision, CostAtEqualErrorFollowsThePower) {
  const WorkCurve c = curve("sph", 1, 2, 0.1);
  const Range cost = cost_at_error(c, "velocity", 0.03);  // h = 0.03^(1/2)
  EXPECT_NEAR(cost.least, 0.1 / (0.03 * 0.03), 1e-9);
  EXPECT_NEAR(cost.most / cost.least, 1.1, 1e-12);
}

TEST(WorkPrecision, ErrorAtEqualCostFollowsThePower) {
  const Range error = error_at_cost(curve("sph", 1, 2, 0.1), "velocity", 5);
  EXPECT_NEAR(error.least, std::sqrt(0.1 / 5), 1e-12);
  EXPECT_NEAR(error.most, std::sqrt(0.11 / 5), 1e-12);
}

TEST(WorkPrecision, DoesNotExtrapolate) {
  const WorkCurve c = curve("sph", 1, 2, 0.1);
  EXPECT_TRUE(std::isnan(cost_at_error(c, "velocity", 1.1).least));
  EXPECT_TRUE(std::isnan(cost_at_error(c, "velocity", 0.01).least));
  EXPECT_TRUE(std::isnan(cost_at_error(c, "stress", 0.1).least));
}

// h_a^2 = 4 h_b^3 at equal seconds (h_a = h_b 2^-1/2 from 0.1 h_a^-4 = 0.4 h_b^-4).
TEST(WorkPrecision, FindsWhereTwoCurvesCross) {
  const auto meet = crossover(curve("sph", 1, 2, 0.1), curve("fvm", 2, 3, 0.4), "velocity");
  ASSERT_TRUE(meet.has_value());
  const double h_b = 0.25;  // 0.5 h_b^2 = 2 h_b^3
  EXPECT_NEAR(meet->error, 2 * std::pow(h_b, 3), 1e-10);
  EXPECT_NEAR(meet->seconds, 0.4 * std::pow(h_b, -4), 1e-7);
}

TEST(WorkPrecision, SaysWhereThereIsNoCrossover) {
  const WorkCurve a = curve("sph", 1, 2, 0.3), b = curve("fvm", 1, 2, 0.1);
  EXPECT_FALSE(crossover(a, b, "velocity").has_value());
  probes::MachineProbes machine;
  machine.double_one = {1e10, 1e10};
  const std::string table = work_precision_table({a, b}, "velocity", machine);
  EXPECT_THAT(table, HasSubstr("no crossover; SPH / FVM cost 3 "));
  const std::string page = work_precision_html("title", {a, b}, "velocity", machine);
  EXPECT_THAT(page, HasSubstr("id=\"panel-2\""));
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_THAT(page, HasSubstr("<p class=\"verdict\">For the same error SPH takes 3.00 times the "
                              "seconds of finite volume, from 100 % down to 1.56 %.</p>"));
}

TEST(WorkPrecision, SaysInPlainWordsWhichMethodCostsLess) {
  const auto verdict = [](const std::vector<WorkCurve>& curves) {
    return work_precision_verdict(curves, "velocity");
  };
  // the costs of the last test but one
  EXPECT_THAT(verdict({curve("sph", 1, 2, 0.1), curve("fvm", 2, 3, 0.4)}),
              testing::MatchesRegex("Below an error of 3.1[23] % \\(102 s\\) finite volume costs "
                                    "less, above it SPH."));
  // 4 h^2 against h^2 at equal seconds: 16 times the seconds at every error
  EXPECT_EQ(
      verdict({curve("sph", 0.1, 2, 1), curve("fvm", 0.4, 2, 1)}),
      "For the same error finite volume takes 16.0 times the seconds of SPH, from 10.0 % down "
      "to 0.625 %.");
  EXPECT_EQ(verdict({curve("sph", 0.1, 2, 1), curve("fvm", 1e-4, 2, 1)}),
            "The two methods reach no error in common: add levels.");
  EXPECT_THAT(verdict({curve("sph", 600, 2, 1), curve("fvm", 900, 2, 1)}),
              HasSubstr("Too coarse to say: every run misses more than half of the velocity"));
  WorkCurve cheap = curve("sph", 0.1, 2, 0.5);
  cheap.variant = "cfl=1";
  EXPECT_THAT(verdict({curve("sph", 0.1, 2, 1), cheap, curve("sph", 0.1, 2, 2)}),
              HasSubstr("SPH cfl=1 is the cheapest"));
}

}  // namespace
}  // namespace diptych::harness
