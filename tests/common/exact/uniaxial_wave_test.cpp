/// Impact and pull against the tabulated states and the conservation laws.

#include "common/exact/uniaxial_wave.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::exact {
namespace {

UniaxialWaveParameters rubber(double velocity) {
  return {1100, 17e6 / 2.6, 17e6 * 0.3 / (1.3 * 0.4), 0.5, velocity};
}

TEST(UniaxialWave, GivesTheTabulatedStates) {
  // E = 17 MPa, nu = 0.3, rho = 1100; P has the same b + lambda_hat but not the same b for another
  // zeta_ratio, so the table belongs to this one
  const UniaxialWave impact("w", rubber(-10)), pull("w", rubber(10));
  EXPECT_NEAR(impact.wall_stretch(), 0.93173301, 5e-9);
  EXPECT_NEAR(impact.front_speed(), 146.483675, 5e-7);
  EXPECT_NEAR(impact.stress(impact.wall_stretch()), -1.611320e6, 0.5);
  EXPECT_NEAR(pull.wall_stretch(), 1.07033015, 5e-9);
  EXPECT_NEAR(pull.stress(pull.wall_stretch()), 1.564154e6, 0.5);
}

TEST(UniaxialWave, ConservesMomentumAndIsContinuous) {
  for (const double velocity : {-60.0, -10.0, 10.0, 60.0}) {
    const UniaxialWave wave("w", rubber(velocity));
    const double t = 2e-3, L = 2 * wave.front_speed() * t;
    const int n = 200000;
    double momentum = 0, length = 0, largest_gap = 0;
    double before = wave.values_at({0, 0, 0}, t)[0];
    EXPECT_NEAR(before, 0, 1e-12);
    for (int i = 0; i < n; ++i) {
      const double h = L / n;
      const auto w = wave.values_at({(i + 0.5) * h, 0, 0}, t);
      momentum += 1100 * w[1] * h;
      length += (w[2] - 1) * h;
      const double after = wave.values_at({(i + 1) * h, 0, 0}, t)[0];
      largest_gap = std::max(largest_gap, std::abs(after - before - (w[2] - 1) * h));
      before = after;
    }
    // the wall takes the momentum P t, the far end has moved by v t
    const double impulse = -wave.stress(wave.wall_stretch()) * t;
    EXPECT_NEAR(momentum, 1100 * velocity * L + impulse, 1e-4 * std::abs(impulse)) << velocity;
    EXPECT_NEAR(length, velocity * t, 1e-4 * std::abs(velocity) * t);
    EXPECT_LE(largest_gap, L / n);
  }
}

TEST(UniaxialWave, RefusesWhatHasNoWave) {
  EXPECT_THROW(UniaxialWave("w", rubber(0)), base::InputError);
  UniaxialWaveParameters p = rubber(-10);
  p.zeta_ratio = 0.9;
  EXPECT_THROW(UniaxialWave("w", p), base::InputError);
}

}  // namespace
}  // namespace diptych::exact
