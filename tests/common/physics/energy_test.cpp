/// Energy and stress of every material with branches: sign, convexity, objectivity, isotropy, and
/// the Kirchhoff stress in its compact form (notes 1.2).

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::tests {
namespace {

using algebra::to_eigen;
using algebra::to_tensor;
using physics::deformation_of;

constexpr double stretch = 3, spread = 5;
constexpr double rounding = 1e-12;  // relative to a stress that sums terms up to 1/J^2 ~ 700

template <class Material>
class Energy : public testing::Test {};
using Materials = testing::Types<physics::MooneyRivlin,
                                 physics::NeoHookean,
                                 physics::IsochoricNeoHookean,
                                 physics::IsochoricNeoHookeanJ2>;
TYPED_TEST_SUITE(Energy, Materials);

TYPED_TEST(Energy, IsNonNegative) {
  RandomStates random(41);
  for (int n = 0; n < 5000; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    // from almost rigid (where the energy is almost zero) to large strain
    const auto F = random.deformation_gradient(n % 2 == 0 ? 1.001 : stretch);
    const double W = body.energy(deformation_of(F));
    ASSERT_GE(W, -rounding);
  }
}

TYPED_TEST(Energy, HasTheLameConstantsThatTheMaterialWasMadeOf) {
  RandomStates random(44);
  constexpr double h = 1e-3;  // terms of fourth order: 1e-6 of the energy
  for (int n = 0; n < 20; ++n) {
    const double mu = random.factor(spread);
    const physics::LameConstants lame{mu, 3 * mu * random.factor(stretch)};  // polyconvex
    const auto material = TypeParam::from(lame, 0.3);
    const Mat3 E = h * (to_eigen(random.deformation_gradient(stretch)) - Mat3::Identity());
    const Mat3 strain = 0.5 * (E + E.transpose());
    const double both = material.energy(deformation_of(to_tensor(Mat3::Identity() + strain))) +
                        material.energy(deformation_of(to_tensor(Mat3::Identity() - strain)));
    const double wanted =
        lame.mu * strain.squaredNorm() + 0.5 * lame.lambda * std::pow(strain.trace(), 2);
    EXPECT_NEAR(0.5 * both / wanted, 1, 1e-4);
  }
}

// The part that volumes may carry: its stress is its derivative, with no stress at rest, and its
// stiffness at rest; large and small J, where a part of it goes on along a tangent.
TYPED_TEST(Energy, OfBulkPressureHasItsStressAsItsDerivative) {
  const auto material = TypeParam::from({1, 9}, 0.3);
  EXPECT_EQ(material.volumetric_energy(1.0), 0);
  EXPECT_EQ(material.volumetric_stress(1.0), 0);
  for (const double J : {0.004, 0.03, 0.0499, 0.0501, 0.3, 1.0, 1.7, 6.0}) {
    const double h = 1e-5 * J;
    const double slope =
        (material.volumetric_energy(J + h) - material.volumetric_energy(J - h)) / (2 * h);
    EXPECT_NEAR(slope, material.volumetric_stress(J), 1e-7 * (1 + std::abs(slope))) << J;
  }
  const double h = 1e-5;
  const double stiffness =
      (material.volumetric_stress(1 + h) - material.volumetric_stress(1 - h)) / (2 * h);
  EXPECT_NEAR(stiffness, material.volumetric_modulus(), 1e-7 * stiffness);
}

TYPED_TEST(Energy, IsObjective) {
  RandomStates random(42);
  for (int n = 0; n < 200; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    const auto F = random.deformation_gradient(stretch);
    const Mat3 R = random.rotation();
    const auto RF = to_tensor(R * to_eigen(F));
    const double W = body.energy(deformation_of(F));
    EXPECT_NEAR(body.energy(deformation_of(RF)), W, rounding * (1 + W));
    const Mat3 P = to_eigen(body.piola(F));
    EXPECT_LT(distance(to_eigen(body.piola(RF)), R * P), rounding * (1 + P.norm()));
  }
}

TYPED_TEST(Energy, IsIsotropicWhenTheInternalVariablesTurnWithTheMaterial) {
  RandomStates random(43);
  for (int n = 0; n < 200; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    const auto F = random.deformation_gradient(stretch);
    const Mat3 R = random.rotation();
    auto turned = body;
    for (auto& state : turned.states) {
      state.A = algebra::to_symmetric(R * to_eigen(state.A) * R.transpose());
      state.S = algebra::to_symmetric(R * to_eigen(state.S) * R.transpose());
    }
    const auto FR = to_tensor(to_eigen(F) * R.transpose());
    const Mat3 P = to_eigen(body.piola(F));
    EXPECT_LT(distance(to_eigen(turned.piola(FR)), P * R.transpose()), rounding * (1 + P.norm()));
  }
}

TYPED_TEST(Energy, KirchhoffStressIsSymmetric) {
  RandomStates random(44);
  for (int n = 0; n < 200; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    const auto F = random.deformation_gradient(stretch);
    const Mat3 P = to_eigen(body.piola(F)), tau = P * to_eigen(F).transpose();
    EXPECT_LT(distance(tau, tau.transpose()), rounding * P.norm() * to_eigen(F).norm());
  }
}

/// Convexity at frozen internal variables, F, H and J independent. For the isochoric materials:
/// J^(-2/3) F:F is jointly convex in (F, J).
TYPED_TEST(Energy, IsPolyconvexWithBranches) {
  RandomStates random(45);
  const auto random_triplet = [&random] {
    const Deformation<double> X = {2.0 * random.tensor(), 2.0 * random.tensor(), random.factor(5)};
    return X;
  };
  for (int n = 0; n < 5000; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    const auto X = random_triplet(), Y = random_triplet();
    const Deformation<double> middle = {0.5 * (X.F + Y.F), 0.5 * (X.H + Y.H), 0.5 * (X.J + Y.J)};
    const double mean = 0.5 * (body.energy(X) + body.energy(Y));
    ASSERT_LE(body.energy(middle), mean + rounding * std::abs(mean));
  }
}

TEST(MooneyRivlinEnergy, NeoHookeanIsItsLimitWithoutZeta) {
  RandomStates random(46);
  const physics::MooneyRivlin full = {0.7, 0, 1.9};
  const physics::NeoHookean reduced = {0.7, 0, 1.9};
  for (int n = 0; n < 50; ++n) {
    const auto X = deformation_of(random.deformation_gradient(stretch));
    EXPECT_DOUBLE_EQ(full.energy(X), reduced.energy(X));
    const auto P = physics::piola_stress<true>(full.response(X), X);
    const auto Q = physics::piola_stress<false>(reduced.response(X), X);
    EXPECT_LT(distance(P, Q), 1e-14 * to_eigen(P).norm());
  }
}

TEST(MooneyRivlinEnergy, KirchhoffStressHasItsCompactForm) {
  RandomStates random(47);
  for (int n = 0; n < 200; ++n) {
    const auto body = random_body<physics::MooneyRivlin>(random, n % 3, spread);
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const Mat3 F = to_eigen(X.F), H = to_eigen(X.H), I = Mat3::Identity();
    const auto& m = body.material;
    const Mat3 b = F * F.transpose(), g = H * H.transpose();
    const double J_f = -2 * (m.xi + 2 * m.zeta) + m.lambda_hat * X.J * (X.J - 1);  // J f'(J)
    Mat3 tau = 2 * m.xi * b + 2 * m.zeta * (g.trace() * I - g) + J_f * I;
    for (size_t k = 0; k < body.branches.size(); ++k) {
      const Mat3 c = F * to_eigen(body.states[k].A) * F.transpose();
      const Mat3 d = H * to_eigen(body.states[k].S) * H.transpose();
      tau += 2 * body.branches[k].xi * (c - I);
      tau += 2 * body.branches[k].zeta * (d.trace() * I - d - 2 * I);
    }
    const Mat3 P = to_eigen(body.piola(X));
    EXPECT_LT(distance(P * F.transpose(), tau), rounding * (1 + P.norm() * F.norm()));
  }
}

TEST(IsochoricEnergy, KirchhoffStressIsDeviatorOfTheIsochoricStretchPlusPressure) {
  RandomStates random(48);
  for (int n = 0; n < 200; ++n) {
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const double mu = random.uniform(0.5, 2), kappa = random.uniform(0.5, 5), J = X.J;
    const Mat3 F = to_eigen(X.F), I = Mat3::Identity();
    const Mat3 b = std::pow(J, -2.0 / 3) * F * F.transpose();
    const Mat3 deviator = mu * (b - b.trace() / 3 * I);
    physics::IsochoricNeoHookean linear;
    linear.mu = mu, linear.kappa = kappa;
    physics::IsochoricNeoHookeanJ2 squared;
    squared.mu = mu, squared.kappa = kappa;
    const Mat3 P1 = to_eigen(physics::piola_stress<false>(linear.response(X), X));
    const Mat3 P2 = to_eigen(physics::piola_stress<false>(squared.response(X), X));
    const double scale = rounding * (1 + P1.norm() * F.norm() + P2.norm() * F.norm());
    EXPECT_LT(distance(P1 * F.transpose(), deviator + kappa * J * (J - 1) * I), scale);
    EXPECT_LT(distance(P2 * F.transpose(), deviator + kappa / 2 * (J * J - 1) * I), scale);
  }
}

}  // namespace
}  // namespace diptych::tests
