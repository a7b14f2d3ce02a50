/// Conjugate stresses (7), (11), Piola stress (9) and second derivatives of every material with
/// branches against differences of the energy, at random states with J > 0.

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

namespace diptych::tests {
namespace {

// Fourth-order differences with h = 5e-4 of functions whose fifth derivative is of order 10 times
// their own size (1/J down to J = 0.2): truncation below 1e-10, rounding eps/h = 4e-13 of the
// energy.
constexpr double h = 5e-4;
constexpr double tolerance = 1e-9;
constexpr double stretch = 1.7, spread = 3;
constexpr int n_states = 40;

template <class Material>
class ConjugateStress : public testing::Test {
 protected:
  /// Runs `check(body, X)` over random bodies with 0, 1 and 2 branches. F, H and J are independent
  /// arguments of the energy, so X is not on the manifold H = cof F.
  template <class Check>
  void over_random_states(Check check) {
    RandomStates random(31);
    for (int n = 0; n < n_states; ++n) {
      const auto body = random_body<Material>(random, n % 3, spread);
      Deformation<double> X = physics::deformation_of(random.deformation_gradient(stretch));
      X.H = random.deformation_gradient(stretch);
      X.J = random.factor(stretch);
      check(body, X);
    }
  }
};
using Materials = testing::Types<physics::MooneyRivlin,
                                 physics::NeoHookean,
                                 physics::IsochoricNeoHookean,
                                 physics::IsochoricNeoHookeanJ2>;
TYPED_TEST_SUITE(ConjugateStress, Materials);

TYPED_TEST(ConjugateStress, IsTheDerivativeOfTheEnergyInFHJ) {
  this->over_random_states([](const auto& body, const Deformation<double>& X) {
    const auto r = body.response(X);
    const double scale = 1 + algebra::to_eigen(r.Sigma_F).norm() + std::abs(body.energy(X));
    for (int k = 0; k < 9; ++k) {
      const int i = k / 3, I = k % 3;
      const auto along_F = [&, i, I](double s) {
        auto Y = X;
        Y.F(i, I) += s;
        return body.energy(Y);
      };
      const auto along_H = [&, i, I](double s) {
        auto Y = X;
        Y.H(i, I) += s;
        return body.energy(Y);
      };
      EXPECT_NEAR(r.Sigma_F(i, I), difference(along_F, h), tolerance * scale);
      EXPECT_NEAR(r.Sigma_H(i, I), difference(along_H, h), tolerance * scale);
    }
    const auto along_J = [&](double s) {
      auto Y = X;
      Y.J += s;
      return body.energy(Y);
    };
    EXPECT_NEAR(r.Sigma_J, difference(along_J, h), tolerance * (scale + std::abs(r.Sigma_J)));
  });
}

TYPED_TEST(ConjugateStress, SecondDerivativesAreATotSTotWJJAndWFJ) {
  this->over_random_states([](const auto& body, const Deformation<double>& X) {
    const auto r = body.response(X);
    const double scale = 1 + algebra::to_eigen(r.Sigma_F).norm() + std::abs(r.Sigma_J) + r.W_JJ;
    for (int n = 0; n < 81; ++n) {
      const int i = n % 3, I = n / 3 % 3, j = n / 9 % 3, J = n / 27;
      const auto Sigma_F = [&, i, I, j, J](double s) {
        auto Y = X;
        Y.F(j, J) += s;
        return body.response(Y).Sigma_F(i, I);
      };
      const auto Sigma_H = [&, i, I, j, J](double s) {
        auto Y = X;
        Y.H(j, J) += s;
        return body.response(Y).Sigma_H(i, I);
      };
      EXPECT_NEAR(i == j ? r.A_tot(I, J) : 0, difference(Sigma_F, h), tolerance * scale);
      EXPECT_NEAR(i == j ? r.S_tot(I, J) : 0, difference(Sigma_H, h), tolerance * scale);
    }
    for (int k = 0; k < 9; ++k) {
      const auto Sigma_F = [&, k](double s) {
        auto Y = X;
        Y.J += s;
        return body.response(Y).Sigma_F(k / 3, k % 3);
      };
      EXPECT_NEAR(r.W_FJ * X.F(k / 3, k % 3), difference(Sigma_F, h), tolerance * scale);
    }
    const auto Sigma_J = [&](double s) {
      auto Y = X;
      Y.J += s;
      return body.response(Y).Sigma_J;
    };
    EXPECT_NEAR(r.W_JJ, difference(Sigma_J, h), tolerance * scale);
  });
}

TYPED_TEST(ConjugateStress, PiolaStressIsTheDerivativeOfTheEnergyInF) {
  RandomStates random(32);
  for (int n = 0; n < n_states; ++n) {
    const auto body = random_body<TypeParam>(random, n % 3, spread);
    const auto F = random.deformation_gradient(stretch);
    const auto P = body.piola(F);
    for (int k = 0; k < 9; ++k) {
      const auto W = [&](double s) {
        auto G = F;
        G(k / 3, k % 3) += s;
        return body.energy(physics::deformation_of(G));
      };
      EXPECT_NEAR(P(k / 3, k % 3), difference(W, h),
                  tolerance * (10 + algebra::to_eigen(P).norm()));
    }
  }
}

TYPED_TEST(ConjugateStress, VanishesInTheReferenceStateWithVirginBranches) {
  RandomStates random(33);
  auto body = random_body<TypeParam>(random, 2, spread);
  body.states = {virgin(), virgin()};
  const auto P = body.piola(algebra::identity<double>());
  const auto X = physics::deformation_of(algebra::identity<double>());
  EXPECT_LT(algebra::to_eigen(P).norm(), 1e-14);  // sums of moduli of order one
  EXPECT_NEAR(body.energy(X), 0, 1e-14);
}

}  // namespace
}  // namespace diptych::tests
