/// The pair sweeps on random states: exact identities of notes 3.2 with the dissipation in
/// place, and agreement of the compiled forms.

#include "tests/common/scheme/random_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::tests {
namespace {

class Sweeps
    : public testing::TestWithParam<std::tuple<std::string, DissipationKind, Arrangement>> {};

TEST_P(Sweeps, InternalForcesSumToZero) {
  RandomBody body(std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam()));
  body.evaluate();
  Vec3 sum = Vec3::Zero();
  double scale = 0;
  for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
    sum += body.vector(body.state.T, a);
    scale += body.vector(body.state.T, a).norm();
  }
  EXPECT_GT(scale, 0);
  EXPECT_LE(sum.norm(), rounding * scale);
}

TEST_P(Sweeps, PowerOfForcesIsStressPowerPlusDissipation) {
  RandomBody body(std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam()));
  body.evaluate();
  double power = 0;
  for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
    power += body.vector(body.state.v, a).dot(body.vector(body.state.T, a));
  }
  const double stress_power = body.stress_power(), numerical = body.numerical_power();
  EXPECT_NE(numerical, 0);
  EXPECT_NEAR(power, -stress_power - numerical,
              rounding * (std::abs(stress_power) + std::abs(numerical)) * 10);
}

INSTANTIATE_TEST_SUITE_P(Both,
                         Sweeps,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values(isotropic,
                                                          exact,
                                                          limited,
                                                          barth_jespersen,
                                                          venkatakrishnan,
                                                          plain,
                                                          objective,
                                                          limited_objective,
                                                          symmetric,
                                                          symmetric_exact),
                                          testing::Values(Arrangement::rows, Arrangement::runs)));

class Methods : public testing::TestWithParam<const char*> {};

TEST_P(Methods, ArrangementsAgree) {
  for (const DissipationKind& kind :
       {isotropic, exact, venkatakrishnan, plain, objective, symmetric}) {
    RandomBody rows(GetParam(), kind, Arrangement::rows), runs(GetParam(), kind, Arrangement::runs);
    rows.evaluate();
    runs.evaluate();
    const auto one = results(rows), other = results(runs);
    for (size_t k = 0; k < one.size(); ++k)
      ASSERT_NEAR(one[k], other[k], 1e-9 * largest(one));
    // rows keep S_ab, which directs the dissipation, in single precision
    EXPECT_NEAR(rows.numerical_power(), runs.numerical_power(),
                1e-9 * std::abs(rows.numerical_power()));
    EXPECT_NEAR(rows.rate[0], runs.rate[0], 1e-7 * rows.rate[0]);
    // and so which pairs are just limited
    EXPECT_NEAR(rows.limited_pairs(), runs.limited_pairs(), 1e-3 * runs.limited_pairs());
    EXPECT_EQ(runs.limited_pairs() > 0, kind.limiter != scheme::PairLimiter::none);
  }
}

/// A body of many segments: each writes to itself and to the next, whoever works it. The symmetric
/// reconstruction has two sweeps of that kind.
TEST_P(Methods, SegmentsDoNotDependOnThreads) {
  const std::array<int, 3> cells{14, 14, 14};
  RandomBody rows(GetParam(), symmetric, Arrangement::rows, false, cells);
  rows.evaluate();
  const auto one = results(rows);
  for (const auto precision : {scheme::Precision::full, scheme::Precision::single}) {
    const bool full = precision == scheme::Precision::full;
    std::vector<double> first;
    for (const int threads : {1, 2}) {
      parallel::set_threads(threads);
      RandomBody runs(GetParam(), symmetric, Arrangement::runs, false, cells, precision);
      ASSERT_GE(runs.state.n_blocks / runs.state.graph.mutual.order.segment, 4);
      runs.evaluate();
      const auto other = results(runs);
      const auto rate = *std::max_element(runs.rate.begin(), runs.rate.end());
      EXPECT_NEAR(rate, *std::max_element(rows.rate.begin(), rows.rate.end()),
                  (full ? 1e-7 : 1e-6) * rate);
      if (threads == 1) first = other;
      EXPECT_EQ(other, first) << threads << " threads";
      for (size_t k = 0; k < one.size(); ++k)
        ASSERT_NEAR(one[k], other[k], (full ? 1e-9 : 3e-6) * largest(one));
      EXPECT_NEAR(rows.numerical_power(), runs.numerical_power(),
                  (full ? 1e-8 : 1e-6) * rows.numerical_power());
    }
  }
  parallel::set_threads(1);
}

/// Forces that follow the records of their chunks at a distance are those of two passes to the last
/// bit: few and many segments, layers that are worked in tiles; and the power of the forces before
/// is taken before their sums are begun anew.
TEST_P(Methods, OnePassHasTheBitsOfTwo) {
  constexpr double dt = 1e-5;
  for (const std::array<int, 3> cells : {std::array{5, 4, 3}, {14, 14, 14}, {63, 33, 9}}) {
    for (const DissipationKind& kind : {isotropic, exact, venkatakrishnan}) {
      if (cells[0] == 63 && kind.limiter != scheme::PairLimiter::none) continue;  // takes long
      for (const auto precision : {scheme::Precision::full, scheme::Precision::single}) {
        // the exact impedance is of doubles
        if (precision == scheme::Precision::single && kind.impedance == exact.impedance) continue;
        for (const int threads : {1, 2}) {
          parallel::set_threads(threads);
          RandomBody two(GetParam(), kind, Arrangement::runs, false, cells, precision),
              one(GetParam(), kind, Arrangement::runs, false, cells, precision);
          ASSERT_EQ(one.state.graph.mutual.order.has_large_layers(), cells[0] == 63);
          for (RandomBody* body : {&two, &one}) {
            for (std::int64_t a = 0; a < one.graph().n_nodes(); ++a) {
              for (int i = 0; i < 4; ++i)
                body->state.T.set(a, i, 1e3 + static_cast<double>(a % 100));
            }
          }
          two.evaluate_drifting(dt, false);
          one.evaluate_drifting(dt, true);
          ASSERT_EQ(results(one), results(two)) << cells[0] << ", " << threads << " threads";
          EXPECT_EQ(one.numerical, two.numerical);
          EXPECT_EQ(one.rate, two.rate);
          EXPECT_EQ(one.limited, two.limited);
          EXPECT_EQ(one.least_J, two.least_J);
          EXPECT_EQ(one.old_power, two.old_power);
          EXPECT_NE(parallel::sum_in_order(one.old_power), 0);
        }
      }
    }
  }
  parallel::set_threads(1);
}

/// A body bent, twisted and stretched beyond any affine map, with F the gradient of its positions,
/// that spins rigidly and flies: v = omega x x + v_0. Its velocities are not linear in X.
TEST_P(Methods, RigidSpinOfADeformedBodyDissipatesNothingWhereItIsObjective) {
  const Vec3 omega(30, -20, 50), flight(7, 5, -3);
  std::vector<double> power;
  for (const DissipationKind& kind : {isotropic, objective, limited_objective}) {
    for (const Arrangement arrangement : {Arrangement::rows, Arrangement::runs}) {
      RandomBody body(GetParam(), kind, arrangement);
      const auto u = [&](std::int64_t a) {
        const Vec3& X = body.graph().X[static_cast<size_t>(a)];
        return Vec3(0.3 * X[2] * X[2] + 0.1 * std::sin(3 * X[1]), 0.2 * X[0] * X[2],
                    -0.2 * X[0] * X[0] + 0.1 * X[1] * X[2]);
      };
      const auto set_velocities = [&](const auto& velocity) {
        for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
          const Vec3 v = velocity(a);
          for (int i = 0; i < 3; ++i)
            body.state.v.set(a, i, v[i]);
        }
      };
      set_velocities(u);
      for (std::int64_t a = 0; a < body.state.n_blocks * algebra::n_lanes; ++a) {
        for (int k = 0; k < 9; ++k)
          body.state.F.set(a, k, 0);
      }
      body.evaluate();  // L is the gradient of u
      for (std::int64_t a = 0; a < body.graph().n_nodes(); ++a) {
        for (int k = 0; k < 9; ++k)
          body.state.F.set(a, k, body.state.records.at(a, scheme::NodeRecord<3>::L + k));
        for (int i = 0; i < 3; ++i)
          body.state.u.set(a, i, u(a)[i]);
      }
      set_velocities([&](std::int64_t a) -> Vec3 {
        return omega.cross(body.graph().X[static_cast<size_t>(a)] + u(a)) + flight;
      });
      body.evaluate();
      power.push_back(std::abs(body.numerical_power()));
    }
  }
  EXPECT_GT(power[0], 1);  // W
  EXPECT_NEAR(power[0], power[1], 1e-6 * power[0]);
  for (size_t k = 2; k < 6; ++k)
    EXPECT_LT(power[k], 1e-12 * power[0]) << k;
}

TEST_P(Methods, AffineVelocityDissipatesNothing) {
  for (const DissipationKind& kind :
       {isotropic, exact, limited, barth_jespersen, venkatakrishnan, symmetric}) {
    RandomBody affine(GetParam(), kind, Arrangement::runs, true),
        rough(GetParam(), plain, Arrangement::runs, true);
    affine.evaluate();
    rough.evaluate();
    EXPECT_GT(rough.numerical_power(), 0);
    EXPECT_LE(std::abs(affine.numerical_power()), 1e-13 * rough.numerical_power());
    EXPECT_EQ(affine.limited_pairs(), 0);
  }
}

TEST_P(Methods, DissipationOfPlainLimitedOrSymmetricJumpsIsPositiveForEveryNode) {
  for (const DissipationKind& kind :
       {plain, limited, limited_exact, barth_jespersen, venkatakrishnan, limited_objective,
        symmetric, symmetric_exact}) {
    RandomBody body(GetParam(), kind);
    body.evaluate();
    for (const double power : body.numerical)
      EXPECT_GE(power, 0);
  }
}

TEST_P(Methods, DissipationIsProportionalToItsFactor) {
  RandomBody body(GetParam(), isotropic);
  body.evaluate(1);
  const double once = body.numerical_power();
  body.evaluate(0.25);
  EXPECT_NEAR(body.numerical_power(), 0.25 * once, rounding * std::abs(once));
}

TEST_P(Methods, CompiledFormsAgree) {
#if defined(DIPTYCH_MULTIVERSION)
  using Momentum = scheme::MomentumVersions<3, isotropic, true>;
  for (const Arrangement arrangement : {Arrangement::rows, Arrangement::runs}) {
    RandomBody body(GetParam(), isotropic, arrangement);
    body.evaluate(StrainRates::baseline, Momentum::baseline);
    const auto baseline = results(body);
    const auto here = algebra::instruction_set();
    if (here == algebra::InstructionSet::baseline) return;  // one form only on this processor
    body.evaluate(StrainRates::avx2, Momentum::avx2);
    const auto avx2 = results(body);
    for (size_t k = 0; k < avx2.size(); ++k) {
      ASSERT_NEAR(avx2[k], baseline[k], rounding * largest(baseline));
    }
    if (here != algebra::InstructionSet::avx512) continue;
    body.evaluate(StrainRates::avx512, Momentum::avx512);
    EXPECT_EQ(results(body), avx2) << "AVX2 and AVX-512 promise the same bits";
  }
#endif
}

INSTANTIATE_TEST_SUITE_P(Both, Methods, testing::Values("sph", "fvm"));

}  // namespace
}  // namespace diptych::tests
