/// Energy (6), dissipation (12) with (13) corrected, and equilibrium of a Maxwell branch.

#include "common/physics/maxwell_branch.hpp"

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

namespace diptych::tests {
namespace {

using algebra::contract;
using algebra::SymmetricTensor;
using physics::branch_dissipation;
using physics::branch_energy;
using physics::deformation_of;

constexpr double spread = 5, stretch = 2;

MaxwellBranch random_branch(RandomStates& random) {
  return {random.uniform(0.1, 2), random.factor(10), random.uniform(0.1, 2), random.factor(10)};
}
BranchState<double> random_state(RandomStates& random) {
  return {random.positive_definite(spread), random.positive_definite(spread)};
}
BranchState<double> equilibrium(const Deformation<double>& X) {
  return {physics::inverse_C(X), physics::inverse_G(X)};
}
SymmetricTensor<double> minus(const SymmetricTensor<double>& A, const SymmetricTensor<double>& B) {
  return A + (-1.0) * B;
}
/// Eigenvalues of C A, those of the symmetric F A F^T.
Vec3 relative_eigenvalues(const Tensor<double>& F, const SymmetricTensor<double>& A) {
  const Mat3 f = algebra::to_eigen(F);
  return eigenvalues(Mat3(f * algebra::to_eigen(A) * f.transpose()));
}

TEST(Deformation, InverseCAndGAreThoseOfFtFAndHtH) {
  RandomStates random(51);
  for (int n = 0; n < 100; ++n) {
    const auto X = deformation_of(random.deformation_gradient(3));
    const Mat3 F = algebra::to_eigen(X.F), H = algebra::to_eigen(X.H);
    // condition number of C up to 3^4, of G up to 3^8
    EXPECT_LT(
        distance(algebra::to_eigen(physics::inverse_C(X)) * (F.transpose() * F), Mat3::Identity()),
        1e-12);
    EXPECT_LT(
        distance(algebra::to_eigen(physics::inverse_G(X)) * (H.transpose() * H), Mat3::Identity()),
        1e-11);
  }
}

TEST(Deformation, RightTensorsAreThoseOfFtF) {
  RandomStates random(53);
  for (int n = 0; n < 100; ++n) {
    const auto X = deformation_of(random.deformation_gradient(3));
    const auto right = physics::right_tensors(X.F);
    const Mat3 F = algebra::to_eigen(X.F), C = F.transpose() * F;
    const Mat3 G = C.determinant() * C.inverse().transpose();
    EXPECT_LT(distance(algebra::to_eigen(right.C), C), 1e-13 * C.norm());
    EXPECT_LT(distance(algebra::to_eigen(right.G), G), 1e-11 * G.norm());
    // condition number of C up to 3^4, of G up to 3^8
    EXPECT_LT(distance(algebra::to_eigen(right.inverse_C) * C, Mat3::Identity()), 1e-12);
    EXPECT_LT(distance(algebra::to_eigen(right.inverse_G) * G, Mat3::Identity()), 1e-11);
  }
}

TEST(MaxwellBranch, EnergyIsASumOverEigenvaluesAndNeverNegative) {
  RandomStates random(52);
  const auto sum = [](const Vec3& x) { return (x.array() - 1 - x.array().log()).sum(); };
  for (int n = 0; n < 2000; ++n) {
    const auto branch = random_branch(random);
    const auto state = random_state(random);
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const double C_part = branch.xi * sum(relative_eigenvalues(X.F, state.A));
    const double G_part = branch.zeta * sum(relative_eigenvalues(X.H, state.S));
    const double W = branch_energy<true>(branch, state, X);
    ASSERT_NEAR(W, C_part + G_part, 1e-12 * (1 + W));
    ASSERT_NEAR(branch_energy<false>(branch, state, X), C_part, 1e-12 * (1 + W));
    ASSERT_GE(W, 0);
  }
}

TEST(MaxwellBranch, IsFreeOfEnergyStressAndDissipationAtEquilibrium) {
  RandomStates random(53);
  for (int n = 0; n < 100; ++n) {
    const auto branch = random_branch(random);
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const auto state = equilibrium(X);
    EXPECT_NEAR(branch_energy<true>(branch, state, X), 0, 1e-12);
    EXPECT_NEAR(branch_dissipation<true>(branch, state, physics::right_tensors(X.F)), 0,
                1e-10);  // 1/tau up to 10
    Response<double> r{};
    physics::add_branch_response<true>(branch, state, X, r);
    const auto P = physics::piola_stress<true>(r, X);
    EXPECT_LT(algebra::to_eigen(P).norm(), 1e-12 * (1 + std::abs(r.Sigma_J)) * X.J * stretch);
  }
}

TEST(MaxwellBranch, DissipationIsSigmaTimesRateWithCvInTheConjugateStress) {
  RandomStates random(54);
  for (int n = 0; n < 5000; ++n) {
    const auto branch = random_branch(random);
    const auto state = random_state(random);
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const auto C = algebra::transpose_times_self(X.F), G = algebra::transpose_times_self(X.H);
    const auto rate_A = (1 / branch.tau_C) * minus(physics::inverse_C(X), state.A);  // (14a)
    const auto rate_S = (1 / branch.tau_G) * minus(physics::inverse_G(X), state.S);  // (14b)
    // (13) corrected: C_v and G_v, not their inverses
    const auto Sigma_A = branch.xi * minus(C, algebra::inverse(state.A));
    const auto Sigma_S = branch.zeta * minus(G, algebra::inverse(state.S));
    const double expected = -contract(Sigma_A, rate_A) - contract(Sigma_S, rate_S);
    const double D = branch_dissipation<true>(branch, state, physics::right_tensors(X.F));
    ASSERT_NEAR(D, expected, 1e-11 * (1 + D));
    ASSERT_GE(D, 0);
  }
}

TEST(MaxwellBranch, DissipationIsTheRateAtWhichRelaxationLowersTheEnergy) {
  RandomStates random(55);
  for (int n = 0; n < 500; ++n) {
    const auto branch = random_branch(random);
    const auto state = random_state(random);
    const auto X = deformation_of(random.deformation_gradient(1.5));
    const auto relaxed_energy = [&](double t) {
      const auto rest = equilibrium(X);
      const BranchState<double> later = {state.A + (t / branch.tau_C) * minus(rest.A, state.A),
                                         state.S + (t / branch.tau_G) * minus(rest.S, state.S)};
      return branch_energy<true>(branch, later, X);
    };
    // step 1e-4 tau: rounding eps/1e-4 of the energy, relative changes of A and S below 1e-2
    const double dt = 1e-4 * std::min(branch.tau_C, branch.tau_G);
    const double D = branch_dissipation<true>(branch, state, physics::right_tensors(X.F));
    EXPECT_NEAR(-difference(relaxed_energy, dt), D, 1e-7 * D);
  }
}

TEST(MaxwellBranch, DissipationKeepsItsDigitsAtSmallStrains) {
  // sum (lambda - 1)^2 / lambda over the eigenvalues of C A; tr(CA) + tr((CA)^-1) - 6 has none left
  const auto at_rest = deformation_of(algebra::identity<double>());
  const double strain[3] = {1e-7, -2e-7, 3e-7};
  auto A = algebra::symmetric_identity<double>();
  double D = 0;
  for (int i = 0; i < 3; ++i) {
    A(i, i) += strain[i];
    D += strain[i] * strain[i] / (1 + strain[i]);
  }
  const auto I = algebra::symmetric_identity<double>();
  // rounding eps of 1 + strain: 1e-9 of the strain
  EXPECT_NEAR(branch_dissipation<true>({1, 1, 0, 1}, {A, I}, physics::right_tensors(at_rest.F)), D,
              5e-9 * D);
  EXPECT_NEAR(branch_dissipation<true>({0, 1, 1, 1}, {I, A}, physics::right_tensors(at_rest.F)), D,
              5e-9 * D);
}

TEST(MaxwellBranch, Equation13AsPrintedWouldCreateEnergy) {
  // C = I, C_v^-1 = 2 I: the printed Sigma = xi (C - C_v^-1) gives D = -3 xi/tau, the corrected
  // one 1.5 xi/tau
  const MaxwellBranch branch = {1, 1, 0, 1};
  const auto I = algebra::symmetric_identity<double>();
  const auto at_rest = deformation_of(algebra::identity<double>());
  EXPECT_DOUBLE_EQ(
      branch_dissipation<true>(branch, {2.0 * I, I}, physics::right_tensors(at_rest.F)), 1.5);
  EXPECT_DOUBLE_EQ(-contract(minus(I, 2.0 * I), minus(I, 2.0 * I)), -3);
  // and it is negative for most random pairs, where the library's is never negative
  RandomStates random(56);
  const int n_pairs = 4000;
  int n_negative = 0;
  for (int n = 0; n < n_pairs; ++n) {
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const BranchState<double> state = {random.positive_definite(spread), I};
    const auto C = algebra::transpose_times_self(X.F);
    const auto rate = minus(physics::inverse_C(X), state.A);
    if (-contract(minus(C, state.A), rate) < 0) ++n_negative;
    ASSERT_GE(branch_dissipation<true>(branch, state, physics::right_tensors(X.F)), 0);
  }
  EXPECT_GT(n_negative, n_pairs / 2);
}

TEST(MaxwellBranch, AnyStepTowardsEquilibriumLowersTheEnergy) {
  RandomStates random(57);
  for (int n = 0; n < 2000; ++n) {
    const auto branch = random_branch(random);
    const auto state = random_state(random);
    const auto X = deformation_of(random.deformation_gradient(stretch));
    const auto rest = equilibrium(X);
    const double theta = random.uniform(0, 1);
    const BranchState<double> later = {(1 - theta) * state.A + theta * rest.A,
                                       (1 - theta) * state.S + theta * rest.S};
    const double before = branch_energy<true>(branch, state, X);
    ASSERT_LE(branch_energy<true>(branch, later, X), before + 1e-13 * (1 + before));
  }
}

TEST(MaxwellBranch, WithoutHTheGPartIsLeftOut) {
  RandomStates random(58);
  auto branch = random_branch(random);
  const auto state = random_state(random);
  const auto X = deformation_of(random.deformation_gradient(stretch));
  Response<double> with{}, without{};
  physics::add_branch_response<false>(branch, state, X, without);
  const double D = branch_dissipation<false>(branch, state, physics::right_tensors(X.F));
  branch.zeta = 0;
  physics::add_branch_response<true>(branch, state, X, with);
  EXPECT_LT(distance(with.Sigma_F, without.Sigma_F), 1e-15);
  EXPECT_DOUBLE_EQ(with.Sigma_J, without.Sigma_J);
  EXPECT_DOUBLE_EQ(with.W_JJ, without.W_JJ);
  EXPECT_EQ(algebra::to_eigen(without.Sigma_H).norm(), 0);
  EXPECT_EQ(algebra::to_eigen(without.S_tot).norm(), 0);
  EXPECT_DOUBLE_EQ(D, branch_dissipation<true>(branch, state, physics::right_tensors(X.F)));
}

}  // namespace
}  // namespace diptych::tests
