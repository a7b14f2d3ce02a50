/// Cases of the literature whose answer is known from other codes or from a law of conservation.
/// Bounds are measured errors with a margin; runs are deterministic.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/run_case.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::harness {
namespace {

class Literature : public testing::TestWithParam<const char*> {
 protected:
  RunResult run(const std::string& name,
                int level,
                const std::vector<std::string>& overrides = {}) const {
    RunOptions options;
    options.method = GetParam();
    options.level = level;
    options.threads = 1;
    options.quiet = true;
    return run_case(cases::read_case(find_case(name), overrides), options);
  }
  static bool is_sph() { return std::string(GetParam()) == "sph"; }
};
INSTANTIATE_TEST_SUITE_P(Both, Literature, testing::Values("sph", "fvm"));

const io::QuantitySummary& quantity(const RunResult& result, const std::string& name) {
  for (const io::QuantitySummary& q : result.summary.quantities) {
    if (q.name == name) return q;
  }
  throw std::logic_error("no quantity " + name);
}

TEST_P(Literature, CooksMembraneRelaxesToTheStaticSolution) {
  constexpr double reference = 14.731;  // mm, 16 x 16 quadratic elements
  const auto error = [&](int level) {
    const RunResult result = run("cooks-membrane", level, {"time.end=0.08"});
    EXPECT_NEAR(quantity(result, "reaction").final_value, -1000, 2) << "it still moves";
    return quantity(result, "tip deflection").final_value / reference - 1;
  };
  try {
    const double coarse = error(0), fine = error(1);
    EXPECT_LE(std::abs(fine), is_sph() ? 0.027 : 0.009);  // 0.0244, -0.0075
    EXPECT_LE(std::abs(fine), 0.5 * std::abs(coarse));
    EXPECT_GT(coarse * fine, 0) << "the methods come from above (SPH) and below (FVM)";
  } catch (const base::EnvironmentError& missing) {
    GTEST_SKIP() << missing.what();  // no gmsh program
  }
}

TEST_P(Literature, CantileverSwingsAboutAsFarAndFastAsInOtherCodes) {
  // reference 2.8 m and 0.65 s; 2.71 m and 0.623 s (FVM) with 4 x 4 x 40 cells
  const RunResult result = run("cantilever-vibration", 1, {"probe.0.every_step=true"});
  const io::QuantitySummary tip = quantity(result, "tip displacement");
  EXPECT_NEAR(tip.greatest, 2.8, 0.05 * 2.8);
  EXPECT_NEAR(tip.period, 0.65, 0.05 * 0.65);
  // it swings back to "about 0": 0.20 (SPH), 0.049 m (FVM) at its second turning point
  double back = tip.greatest;
  for (const io::StepRow& row : result.steps) {
    if (row.time > 0.6 * tip.period && row.time < 1.4 * tip.period)
      back = std::min(back, row.probes.at(0));
  }
  EXPECT_LE(back, is_sph() ? 0.25 : 0.06);
}

TEST_P(Literature, BarReboundsAsTheImpulseOfTheWallSays) {
  const RunResult result = run("bar-rebound", 0);
  EXPECT_LE(result.summary.linear_momentum_drift, 1e-12);
  EXPECT_LE(result.summary.energy.external_work, 0) << "the wall gave energy";
  // 85.7 (SPH) and 85.6 m/s (FVM); both 86.7 with an eighth of the spacing
  EXPECT_NEAR(quantity(result, "mean velocity").final_value, 86.7, 1.3);
  EXPECT_GE(quantity(result, "wall force").least, 0);
}

TEST_P(Literature, PunchKeepsTheVolume) {
  const RunResult result = run("punch", 0);
  EXPECT_GE(quantity(result, "lowest J").least, 0.9);
  EXPECT_LE(quantity(result, "greatest J").greatest, 1.08);
  EXPECT_LE(quantity(result, "corner under the punch").least, -0.2) << "it was not punched";
}

TEST_P(Literature, TwistingColumnStandsFourHundredRadiansPerSecond) {
  const RunResult result = run("twisting-column-400", 0);
  EXPECT_EQ(result.summary.status, "done");
  EXPECT_GT(quantity(result, "lowest J").least, 0.4);  // of cells where these carry the pressure
}

}  // namespace
}  // namespace diptych::harness
