/// Shock capturing on the exact finite-strain impact (notes 7, case `impact`): star state,
/// place of the front, overshoot, order in L1. All runs are deterministic.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"
#include "common/exact/uniaxial_wave.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::harness {
namespace {

/// What a run made of the exact solution.
struct Shock {
  double star_P = 0, star_f = 0;  ///< relative errors behind the front, away from front and wall
  double place = 0;               ///< of the front, in spacings, from the length ahead of it
  double overshoot = 0;           ///< of the velocity over both ends of its jump, relative
  double l1 = 0;                  ///< relative error of the velocity
};

class Impact : public testing::TestWithParam<const char*> {
 protected:
  /// @param v  speed of the bar [m/s], positive: pulled off the wall
  Shock run(double v, int level, std::vector<std::string> overrides = {}) const {
    RunOptions options;
    options.method = GetParam();
    options.level = level;
    options.threads = 1;
    options.quiet = true;
    overrides.push_back("parameters.v0=" + std::to_string(v));
    overrides.push_back("output.frames=1");
    const RunResult result = run_case(cases::read_case(find_case("impact"), overrides), options);
    const exact::UniaxialWave exact("w", {1100, 17e6 / 2.6, 17e6 * 0.3 / (1.3 * 0.4), 0.5, v});
    return compared(result, exact, v, 40 << level);
  }

 private:
  static Shock compared(const RunResult& result,
                        const exact::UniaxialWave& exact,
                        double v,
                        int n) {
    const double t = result.summary.end_time, front = exact.front_speed() * t;
    Shock shock;
    double P = 0, f = 0, volume = 0, ahead = 0;
    for (size_t a = 0; a < result.graph.X.size(); ++a) {
      const double X = result.graph.X[a][0], Omega = result.graph.Omega[a];
      const double state = result.final_state.v[a][0] / v;  // 0 behind, 1 ahead
      ahead += Omega * state / 0.1;
      // the first nodes at the wall keep the error of the start, as in every shock code
      if (X > 0.15) shock.overshoot = std::max({shock.overshoot, state - 1, -state});
      if (X < 0.2 || X > 0.7 * front) continue;
      P += Omega * result.final_state.P[a](0, 0);
      f += Omega * result.final_state.F[a](0, 0);
      volume += Omega;
    }
    const double star = exact.wall_stretch();
    shock.star_f = std::abs(f / volume - star) / std::abs(star - 1);
    shock.star_P = std::abs(P / volume / exact.stress(star) - 1);
    shock.place = std::abs(1 - ahead - front) * n;
    shock.l1 = result.summary.errors.at("velocity").l1;
    return shock;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Impact, testing::Values("sph", "fvm"));

TEST_P(Impact, StarStateFrontAndOvershootAreThoseOfTheExactShock) {
  for (const int level : {0, 1}) {
    const Shock shock = run(-10, level);
    EXPECT_LE(shock.star_f, 0.005) << level;
    EXPECT_LE(shock.star_P, 0.005) << level;
    EXPECT_LE(shock.place, 1) << level;
    EXPECT_LE(shock.overshoot, 0.01) << level;
  }
}

TEST_P(Impact, StrongShockToTwoThirdsOfTheLengthStaysInBounds) {
  const Shock shock = run(-50, 1);
  EXPECT_LE(shock.star_f, 0.005);
  EXPECT_LE(shock.star_P, 0.005);
  EXPECT_LE(shock.place, 1);
  EXPECT_LE(shock.overshoot, 0.01);  // 1.3 % with the wide rows of kappa 1.0
}

TEST_P(Impact, ConvergesInL1) {
  // The front of a weak shock first widens as a linear wave (0.7 from 40 to 80 cells), then its
  // own steepening holds it: 0.85 measured from 80 to 160.
  EXPECT_GE(std::log2(run(-10, 1).l1 / run(-10, 2).l1), 0.8);
}

/// Overshoots are dispersion: no limiter removes those of operators of second order.
TEST_P(Impact, OvershootIsKeptDownByTheLimiterAndOperatorsThatSumByParts) {
  EXPECT_GE(run(-10, 1, {"scheme.limiter=none"}).overshoot, 0.05);
  EXPECT_GE(run(-10, 1, {"sph.gradient=corrected", "sph.kappa=0.75", "fvm.stencil=edge"}).overshoot,
            0.05);
  EXPECT_LE(run(-10, 1, {"scheme.limiter=barth-jespersen"}).overshoot, 0.1);
}

}  // namespace
}  // namespace diptych::harness
