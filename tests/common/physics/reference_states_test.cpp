/// Energy, stress, dissipation, wave speeds and relaxation at the twenty tabulated states
/// (tests/reference/states_public.json, computed to 40 digits by an independent program).

#include "tests/common/physics/reference_tables.hpp"

#include <gtest/gtest.h>

namespace diptych::tests {
namespace {

using algebra::to_eigen;

/// Mooney-Rivlin body of one table row; its branches are [beta_C, beta_G, tau_C, tau_G].
Body<physics::MooneyRivlin> body_of(const nlohmann::json& row) {
  Body<physics::MooneyRivlin> body;
  body.material = {row.at("xi"), row.at("zeta"), row.at("lhat")};
  const auto& branches = row.at("branches");
  for (size_t k = 0; k < branches.size(); ++k) {
    const double beta_C = branches[k].at(0), beta_G = branches[k].at(1);
    body.branches.push_back({beta_C * body.material.xi, branches[k].at(2),
                             beta_G * body.material.zeta, branches[k].at(3)});
    body.states.push_back({symmetric(row.at("Cv").at(k)), symmetric(row.at("Gv").at(k))});
  }
  return body;
}

class ReferenceStates : public testing::Test {
 protected:
  const nlohmann::json table_ = reference_table("states_public.json");
  void SetUp() override { ASSERT_EQ(table_.size(), 20U); }
};

TEST_F(ReferenceStates, EnergyStressAndDissipationAgree) {
  for (const auto& row : table_) {
    const auto body = body_of(row);
    const auto X = physics::deformation_of(algebra::to_tensor(matrix(row.at("F"))));
    const double J = row.at("J"), W = row.at("W"), D = row.at("D");
    // J of nearly singular rows cancels: eps |F|^3/J
    const double amplified = 1e-14 * std::pow(to_eigen(X.F).norm(), 3) / J;
    EXPECT_NEAR(X.J / J, 1, amplified);
    EXPECT_NEAR(body.energy(X) / W, 1, 1e-13 + amplified);
    const Mat3 P = matrix(row.at("P"));
    EXPECT_LT(distance(to_eigen(body.piola(X)), P), (1e-13 + 10 * amplified) * P.norm());
    double dissipation = 0;
    for (size_t k = 0; k < body.branches.size(); ++k)
      dissipation += physics::branch_dissipation<true>(body.branches[k], body.states[k],
                                                       physics::right_tensors(X.F));
    // near equilibrium D is a difference: rounding of the traces over tau
    double traces = 0;
    for (size_t k = 0; k < body.branches.size(); ++k)
      traces += 6 * body.branches[k].xi / body.branches[k].tau_C +
                6 * body.branches[k].zeta / body.branches[k].tau_G;
    EXPECT_NEAR(dissipation, D, (1e-13 + 10 * amplified) * (D + traces));
  }
}

TEST_F(ReferenceStates, NeoHookeanRowsAgreeWithoutTheWorkOfH) {
  int n_rows = 0;
  for (const auto& row : table_) {
    if (row.at("zeta").get<double>() != 0) continue;
    ++n_rows;
    const auto full = body_of(row);
    const Body<physics::NeoHookean> body = {
        {full.material.xi, 0, full.material.lambda_hat}, full.branches, full.states};
    const auto X = physics::deformation_of(algebra::to_tensor(matrix(row.at("F"))));
    const Mat3 P = matrix(row.at("P"));
    EXPECT_LT(distance(to_eigen(body.piola(X)), P), 1e-11 * P.norm());
  }
  EXPECT_EQ(n_rows, 5);
}

TEST_F(ReferenceStates, WaveSpeedsAgree) {
  for (const auto& row : table_) {
    const auto body = body_of(row);
    const auto X = physics::deformation_of(algebra::to_tensor(matrix(row.at("F"))));
    const auto& n = row.at("N");
    const Vector<double> N = {{n.at(0), n.at(1), n.at(2)}};
    const auto c = physics::wave_speeds(body.response(X), X, 1, N);
    const double amplified = 1e-13 + 1e-13 * std::pow(to_eigen(X.F).norm(), 3) / X.J;
    EXPECT_NEAR(c.c_s2 * c.c_s2 / row.at("rho_c2").at(0).get<double>(), 1, amplified);
    EXPECT_NEAR(c.c_s1 * c.c_s1 / row.at("rho_c2").at(1).get<double>(), 1, amplified);
    EXPECT_NEAR(c.c_p * c.c_p / row.at("rho_c2").at(2).get<double>(), 1, amplified);
  }
}

TEST_F(ReferenceStates, RelaxationAtFixedDeformationAgrees) {
  // dt/tau from 1e-6 to 1e4: both rules are exact for a constant F
  for (const auto& row : table_) {
    const auto body = body_of(row);
    const auto X = physics::deformation_of(algebra::to_tensor(matrix(row.at("F"))));
    const double dt = row.at("dt");
    const auto expect_held = [&](double tau, const SymmetricTensor<double>& A,
                                 const SymmetricTensor<double>& B, const Mat3& expected) {
      const auto linear = physics::relaxed(physics::linear_relaxation(dt / tau), A, B, B);
      const auto gauss = physics::relaxed(physics::gauss_relaxation(dt / tau), A, B, B);
      // inverse of C: its condition number, up to 1e4 in this table, times a few roundings
      EXPECT_LT(distance(to_eigen(linear), expected), 1e-12 * expected.norm()) << tau;
      EXPECT_LT(distance(to_eigen(gauss), expected), 1e-12 * expected.norm()) << tau;
    };
    for (size_t k = 0; k < body.branches.size(); ++k) {
      expect_held(body.branches[k].tau_C, body.states[k].A, physics::inverse_C(X),
                  matrix(row.at("Cv_hold_dt").at(k)));
      expect_held(body.branches[k].tau_G, body.states[k].S, physics::inverse_G(X),
                  matrix(row.at("Gv_hold_dt").at(k)));
    }
  }
}

}  // namespace
}  // namespace diptych::tests
