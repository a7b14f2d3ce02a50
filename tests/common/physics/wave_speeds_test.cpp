/// Acoustic tensor, wave speeds, their bounds over all directions, and the impedance.

#include "common/physics/wave_speeds.hpp"

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::tests {
namespace {

using algebra::to_eigen;
using physics::acoustic_tensor;
using physics::deformation_of;
using physics::wave_speeds;

constexpr double rho = 1100;
// Relative to the largest eigenvalue: a few dozen roundings of ours and of Eigen's iteration.
constexpr double rounding = 1e-12;

template <class Material>
class WaveSpeeds : public testing::Test {};
using Materials = testing::Types<physics::MooneyRivlin,
                                 physics::NeoHookean,
                                 physics::IsochoricNeoHookean,
                                 physics::IsochoricNeoHookeanJ2>;
TYPED_TEST_SUITE(WaveSpeeds, Materials);

TYPED_TEST(WaveSpeeds, AcousticTensorIsTheDerivativeOfThePiolaStress) {
  RandomStates random(61);
  for (int n = 0; n < 100; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, 3);
    const auto F = random.deformation_gradient(1.7);
    const auto X = deformation_of(F);
    const auto N = random.direction();
    const Mat3 Q = to_eigen(acoustic_tensor(body.response(X), X, N));
    for (int k = 0; k < 9; ++k) {
      const int i = k / 3, j = k % 3;
      const auto traction = [&](double s) {  // component i of P N for F + s e_j (x) N
        auto G = F;
        for (int I = 0; I < 3; ++I)
          G(j, I) += s * N[I];
        return algebra::product(body.piola(G), N)[i];
      };
      // J is linear in s, 1/J and J^(-5/3) smooth: see conjugate_stress_test
      EXPECT_NEAR(Q(i, j), difference(traction, 5e-4), 1e-9 * Q.norm());
    }
  }
}

TYPED_TEST(WaveSpeeds, AreTheRootsOfTheEigenvaluesOfTheAcousticTensor) {
  RandomStates random(62);
  for (int n = 0; n < 5000; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, 5);
    const auto X = deformation_of(random.deformation_gradient(n % 2 == 0 ? 1.5 : 4));
    const auto N = random.direction();
    const auto r = body.response(X);
    const Vec3 q = eigenvalues(acoustic_tensor(r, X, N));
    const auto c = wave_speeds(r, X, rho, N);
    ASSERT_NEAR(rho * c.c_p * c.c_p / q[2], 1, rounding);
    ASSERT_NEAR(rho * c.c_s1 * c.c_s1, q[1], rounding * q[2]);
    ASSERT_NEAR(rho * c.c_s2 * c.c_s2, q[0], rounding * q[2]);
  }
}

TYPED_TEST(WaveSpeeds, AreRealAndPositiveAtEveryStrain) {
  // a consequence of polyconvexity, for the isochoric materials too
  RandomStates random(63);
  for (int n = 0; n < 5000; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, 10);
    const auto X = deformation_of(random.deformation_gradient(10));
    const auto c = wave_speeds(body.response(X), X, rho, random.direction());
    ASSERT_GT(c.c_s2, 0);
    ASSERT_GE(c.c_s1, c.c_s2);
    ASSERT_GE(c.c_p, c.c_s1);
    ASSERT_TRUE(std::isfinite(c.c_p));
  }
}

TEST(MooneyRivlinSpeeds, KeepFullAccuracyWhereTheShearWavesCoincide) {
  // two equal stretches, N along the third, no branch: m1 = m2, where the root of
  // tr_M^2/4 - m1 m2 would leave 1e-8
  RandomStates random(64);
  for (int n = 0; n < 500; ++n) {
    const auto body = random_body<physics::MooneyRivlin>(random, 0, 1);
    const Mat3 R = random.rotation();
    const double axial = random.factor(2), lateral = random.factor(2);
    const Vec3 stretches(axial, lateral, lateral * (1 + (n % 2) * 1e-9 * random.factor(1e3)));
    const Mat3 F = random.rotation() * stretches.asDiagonal() * R;
    const auto X = deformation_of(algebra::to_tensor(F));
    const auto N = algebra::to_vector(R.row(0));
    const auto r = body.response(X);
    const Vec3 q = eigenvalues(acoustic_tensor(r, X, N));
    const auto c = wave_speeds(r, X, rho, N);
    EXPECT_NEAR(rho * c.c_s1 * c.c_s1, q[1], rounding * q[2]);
    EXPECT_NEAR(rho * c.c_s2 * c.c_s2, q[0], rounding * q[2]);
  }
}

TEST(MooneyRivlinSpeeds, PressureWaveIsPolarisedAlongTheSpatialNormal) {
  RandomStates random(65);
  for (int n = 0; n < 200; ++n) {
    const auto body = random_body<physics::MooneyRivlin>(random, n % 3, 5);
    const auto X = deformation_of(random.deformation_gradient(3));
    const auto N = random.direction();
    const auto r = body.response(X);
    const Mat3 Q = to_eigen(acoustic_tensor(r, X, N));
    const Vec3 spatial_normal = (to_eigen(X.H) * to_eigen(N)).normalized();
    const double c_p = wave_speeds(r, X, rho, N).c_p;
    EXPECT_LT((Q * spatial_normal - rho * c_p * c_p * spatial_normal).norm(), rounding * Q.norm());
  }
}

TYPED_TEST(WaveSpeeds, ImpedanceSquaredIsDensityTimesAcousticTensor) {
  RandomStates random(67);
  for (int n = 0; n < 2000; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, 5);
    const auto X = deformation_of(random.deformation_gradient(n % 2 == 0 ? 1.5 : 3));
    const auto N = random.direction();
    const auto r = body.response(X);
    const auto Q = acoustic_tensor(r, X, N);
    const Mat3 Z = to_eigen(physics::impedance<TypeParam::has_H>(r, X, rho, N));
    ASSERT_LT(distance(Z * Z, rho * to_eigen(Q)), rounding * rho * to_eigen(Q).norm());
    ASSERT_GT(eigenvalues(Z)[0], 0);  // the root that is positive definite
  }
}

TYPED_TEST(WaveSpeeds, BoundsHoldInEveryDirection) {
  RandomStates random(68);
  for (int n = 0; n < 300; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, n % 2 == 0 ? 2 : 30);
    const auto X = deformation_of(random.deformation_gradient(n % 4 < 2 ? 1.5 : 5));
    const auto r = body.response(X);
    const auto bound = physics::speed_bounds(r, X, rho, TypeParam::has_H, TypeParam::has_W_FJ);
    for (int k = 0; k < 100; ++k) {
      const Vec3 q = eigenvalues(acoustic_tensor(r, X, random.direction()));
      ASSERT_GE(bound.c_p, std::sqrt(q[2] / rho) * (1 - rounding));
      ASSERT_GE(bound.c_s * bound.c_s, 0.5 * (q[0] + q[1]) / rho * (1 - rounding));
    }
  }
}

/// Largest value of f over directions: a coarse sample, then ever smaller random steps.
template <class Function>
double maximum_over_directions(Function f, RandomStates& random) {
  Vec3 best = random.unit_vector();
  double largest = f(best);
  double step = 2;
  for (int k = 0; k < 1500; ++k) {
    if (k > 500) step *= 0.99;
    const Vec3 trial = (best + step * random.unit_vector()).normalized();
    const double value = f(trial);
    if (value > largest) {
      largest = value;
      best = trial;
    }
  }
  return largest;
}

TEST(MooneyRivlinSpeeds, BoundsAreTheMaximaOverAllDirections) {
  RandomStates random(69);
  for (int n = 0; n < 60; ++n) {
    const auto body = random_body<physics::MooneyRivlin>(random, n % 3, 5);
    const auto X = deformation_of(random.deformation_gradient(3));
    const auto r = body.response(X);
    const auto bound = physics::speed_bounds(r, X, rho, true, true);
    const auto q = [&](const Vec3& N) {
      return eigenvalues(acoustic_tensor(r, X, algebra::to_vector(N)));
    };
    const double c_p =
        maximum_over_directions([&](const Vec3& N) { return std::sqrt(q(N)[2] / rho); }, random);
    const double c_s = maximum_over_directions(
        [&](const Vec3& N) { return std::sqrt(0.5 * (q(N)[0] + q(N)[1]) / rho); }, random);
    // the search ends within about 1e-4 of the maximum, from below
    EXPECT_NEAR(bound.c_p / c_p, 1, 1e-3);
    EXPECT_NEAR(bound.c_s / c_s, 1, 1e-3);
    EXPECT_GE(bound.c_p, c_p * (1 - rounding));
    EXPECT_GE(bound.c_s, c_s * (1 - rounding));
  }
}

TEST(IsochoricSpeeds, BoundHoldsWhereABranchPicksTheDirection) {
  // Soft in bulk, one branch that is stiff along m only: the fastest direction is m, where the part
  // with W_JJ and W_FJ may even be negative. A fifth instead of half the root in the bound would
  // fail here by almost 1 %.
  for (const double xi : {0.1, 1.0, 10.0}) {
    for (const double stretch : {1.2, 1.45, 2.0}) {
      for (int degrees = 0; degrees <= 90; degrees += 5) {
        const double angle = degrees * M_PI / 180;
        const Vec3 m(std::cos(angle), 0, std::sin(angle));
        const Mat3 A = 100 * m * m.transpose() + 0.01 * Mat3::Identity();
        Body<physics::IsochoricNeoHookean> body;
        body.material.mu = 1;
        body.material.kappa = 0.05;
        body.branches = {{xi, 1, 0, 1}};
        body.states = {{algebra::to_symmetric(A), {}}};
        const Mat3 F = Vec3(stretch, 0.7, 1 / stretch).asDiagonal();
        const auto X = deformation_of(algebra::to_tensor(F));
        const auto r = body.response(X);
        const double bound = physics::speed_bounds(r, X, rho, false, true).c_p;
        const Vec3 q = eigenvalues(acoustic_tensor(r, X, algebra::to_vector(m)));
        EXPECT_GE(rho * bound * bound, q[2]) << xi << " " << stretch << " " << degrees;
      }
    }
  }
}

TYPED_TEST(WaveSpeeds, BoundsAreTheExactSpeedsInTheReferenceState) {
  RandomStates random(70);
  auto body = random_body<TypeParam>(random, 2, 1);
  body.states = {virgin(), virgin()};
  const auto X = deformation_of(algebra::identity<double>());
  const auto r = body.response(X);
  const auto bound = physics::speed_bounds(r, X, rho, TypeParam::has_H, TypeParam::has_W_FJ);
  for (int k = 0; k < 20; ++k) {
    const auto c = wave_speeds(r, X, rho, random.direction());
    EXPECT_NEAR(c.c_p / bound.c_p, 1, rounding);
    EXPECT_NEAR(c.c_s1 / bound.c_s, 1, rounding);
    EXPECT_NEAR(c.c_s2 / bound.c_s, 1, rounding);
  }
}

}  // namespace
}  // namespace diptych::tests
