/// Prescribed homogeneous motions against independently computed histories
/// (tests/reference/ref1_*): internal variables by (GEXP), then stress, energy and dissipation.
/// Material: nu = 0.3, xi = zeta, beta_C = beta_G = 1, tau_C = tau_G = 0.1 s.

#include "tests/common/physics/reference_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace diptych::tests {
namespace {

using algebra::to_eigen;
using algebra::to_tensor;
using physics::deformation_of;

/// F and its rate at a time.
struct Instant {
  Mat3 F, rate;
};
using Motion = std::function<Instant(double)>;

const Mat3 I = Mat3::Identity();

Instant held(double) {
  return {(Mat3() << 1.5, 0.3, 0, 0.1, 0.9, 0.2, 0, -0.1, 0.8).finished(), Mat3::Zero()};
}
/// Stretch 1 + 10 t up to 2 at t = 0.1, then held.
Instant ramp(double t) {
  Instant now = {I, Mat3::Zero()};
  now.F(0, 0) = 1 + 10 * std::min(t, 0.1);
  now.rate(0, 0) = t < 0.1 ? 10 : 0;
  return now;
}
Instant oscillating_shear(double t) {
  Instant now = {I, Mat3::Zero()};
  now.F(0, 1) = std::sin(20 * t);
  now.rate(0, 1) = 20 * std::cos(20 * t);
  return now;
}
/// R(50 t) (I + sin(11 t) K): a pulsating stretch under a fast rotation.
Instant rotating(double t) {
  const Mat3 K = (Mat3() << 0.15, 0.25, 0, 0.25, -0.1, 0.05, 0, 0.05, 0.2).finished();
  const double c = std::cos(50 * t), s = std::sin(50 * t);
  const Mat3 R = (Mat3() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
  const Mat3 spin = (Mat3() << 0, -50, 0, 50, 0, 0, 0, 0, 0).finished();
  const Mat3 U = I + std::sin(11 * t) * K;
  return {R * U, spin * R * U + R * (11 * std::cos(11 * t) * K)};
}
/// F = exp(L t) by its series; |L t| < 8, so rounding grows to e^8 eps = 7e-13 at most.
Instant exponential(double t) {
  const Mat3 L = (Mat3() << 3, 5, 0, -4, -2, 1, 0.5, 0, -0.7).finished();
  Mat3 term = I, F = I;
  for (int k = 1; k < 60; ++k) {
    term = term * L * t / k;
    F += term;
  }
  return {F, L * F};
}

Body<physics::MooneyRivlin> material() {
  const auto p = physics::mooney_rivlin_parameters(physics::lame_from_young(17e6, 0.3), 0.5);
  return {{p.xi, p.zeta, p.lambda_hat}, {{p.xi, 0.1, p.zeta, 0.1}}, {virgin()}};
}

/// Advances the branch from t0 to t1 by (GEXP) in steps of at most 0.25 ms.
void advance(Body<physics::MooneyRivlin>& body, const Motion& motion, double t0, double t1) {
  const int n = static_cast<int>(std::ceil((t1 - t0) / 2.5e-4));
  const double dt = (t1 - t0) / n;
  const auto rule = physics::gauss_relaxation(dt / body.branches[0].tau_C);
  auto& state = body.states[0];
  for (int k = 0; k < n; ++k) {
    Instant begin = motion(t0 + k * dt), end = motion(t0 + (k + 1) * dt);
    // the ramp has a kink, where a step ends: rates from just inside the step
    begin.rate = motion(t0 + k * dt + 1e-12).rate;
    end.rate = motion(t0 + (k + 1) * dt - 1e-12).rate;
    Deformation<double> X[2];
    for (int i = 0; i < 2; ++i)
      X[i] = deformation_of(physics::hermite(rule.theta[i], dt, to_tensor(begin.F),
                                             to_tensor(begin.rate), to_tensor(end.F),
                                             to_tensor(end.rate)));
    state.A = physics::relaxed(rule, state.A, physics::inverse_C(X[0]), physics::inverse_C(X[1]));
    state.S = physics::relaxed(rule, state.S, physics::inverse_G(X[0]), physics::inverse_G(X[1]));
  }
}

/// Compares every row of the table. Tolerance: (50 dt)^4/384 = 6e-11 of the fastest motion's
/// Hermite interpolation, and the accuracy of the tables themselves.
void expect_history(const std::string& file, const Motion& motion) {
  constexpr double tolerance = 1e-9;
  auto body = material();
  double t_last = 0;
  const auto table = reference_table(file);
  ASSERT_EQ(table.at("result").size(), 7U);
  for (const auto& row : table.at("result")) {
    const double t = row.at("t"), W = row.at("W"), D = row.at("D");
    if (t_last < 0.1 && t > 0.1) {
      advance(body, motion, t_last, 0.1);
      t_last = 0.1;
    }
    if (t > t_last) advance(body, motion, t_last, t);
    t_last = t;
    const auto X = deformation_of(to_tensor(motion(t).F));
    ASSERT_LT(distance(to_eigen(X.F), matrix(row.at("F"))), 1e-12) << "another motion, t = " << t;
    EXPECT_LT(distance(to_eigen(body.states[0].A), matrix(row.at("Cv_inv").at(0))), tolerance) << t;
    EXPECT_LT(distance(to_eigen(body.states[0].S), matrix(row.at("Gv_inv").at(0))), tolerance) << t;
    const double modulus = body.material.lambda_hat;  // Pa; stresses start from zero
    EXPECT_LT(distance(to_eigen(body.piola(X)), matrix(row.at("P"))), 10 * tolerance * modulus)
        << t;
    EXPECT_NEAR(body.energy(X), W, 10 * tolerance * modulus) << t;
    const double dissipation = physics::branch_dissipation<true>(body.branches[0], body.states[0],
                                                                 physics::right_tensors(X.F));
    EXPECT_NEAR(dissipation, D, 10 * tolerance * modulus / 0.1) << t;
  }
}

TEST(ReferenceMotions, StepRelaxation) {
  expect_history("ref1_step.json", held);
}
TEST(ReferenceMotions, RampAndHold) {
  expect_history("ref1_ramp.json", ramp);
}
TEST(ReferenceMotions, OscillatingSimpleShear) {
  expect_history("ref1_shear.json", oscillating_shear);
}
TEST(ReferenceMotions, PulsatingStretchUnderFastRotation) {
  expect_history("ref1_rotating.json", rotating);
}
TEST(ReferenceMotions, ConstantVelocityGradient) {
  expect_history("ref1_expA.json", exponential);
}

}  // namespace
}  // namespace diptych::tests
