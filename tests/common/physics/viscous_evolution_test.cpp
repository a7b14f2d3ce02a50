/// Relaxation updates (LIN) and (GEXP): weights against independent moments in long double, convex
/// combination for every dt/tau, order on a prescribed deformation, and the stiff limit.

#include "common/physics/viscous_evolution.hpp"

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace diptych::tests {
namespace {

using physics::gauss_relaxation;
using physics::linear_relaxation;

/// dt/tau from 1e-8 to 1e8, dense, with both sides of every switch of formula.
std::vector<double> ratios() {
  std::vector<double> z = {1e-3, std::nextafter(1e-3, 0),  2, std::nextafter(2.0, 0),
                           50,   std::nextafter(50.0, 100)};
  for (double exponent = -8; exponent <= 8; exponent += 0.05)
    z.push_back(std::pow(10, exponent));
  return z;
}

/// c_k = int_0^1 z e^(-z u) u^k du: sums of positive terms only, or k!/z^k where e^-z < 1e-43.
long double moment(long double z, int k) {
  if (z > 100) return std::tgamma(k + 1.0L) / std::pow(z, static_cast<long double>(k));
  long double term = z * std::exp(-z) / (k + 1), sum = 0;
  for (int j = 1; j < 600; ++j) {
    sum += term;
    term *= z / (k + 1 + j);
  }
  return sum;
}

TEST(LinearRelaxation, WeightsAreTheMomentsOfTheExponential) {
  for (const double z : ratios()) {
    const auto w = linear_relaxation(z);
    // B linear in time: weights c_1 (begin, u = 1) and c_0 - c_1 (end, u = 0)
    const double begin = static_cast<double>(moment(z, 1));
    const double end = static_cast<double>(moment(z, 0) - moment(z, 1));
    // the closed form subtracts numbers of order one at z = 1e-3: eps/z = 2e-13 relative
    EXPECT_NEAR(w.begin / begin, 1, 1e-12) << z;
    EXPECT_NEAR(w.end / end, 1, 1e-12) << z;
    EXPECT_NEAR(w.old, std::exp(-z), 1e-16) << z;
  }
}

TEST(LinearRelaxation, IsAConvexCombinationForEveryRatio) {
  for (const double z : ratios()) {
    const auto w = linear_relaxation(z);
    EXPECT_GE(w.old, 0);
    EXPECT_GT(w.begin, 0) << z;
    EXPECT_GT(w.end, 0) << z;
    EXPECT_NEAR(w.old + w.begin + w.end, 1, 4e-16) << z;
  }
}

TEST(LinearRelaxation, HasItsLimits) {
  EXPECT_EQ(linear_relaxation(0).old, 1);
  EXPECT_EQ(linear_relaxation(0).begin, 0);
  EXPECT_EQ(linear_relaxation(0).end, 0);
  EXPECT_NEAR(linear_relaxation(1e-8).begin / 0.5e-8, 1, 1e-7);
  EXPECT_NEAR(linear_relaxation(1e-8).end / 0.5e-8, 1, 1e-7);
  // stiff: A -> B_end + (B_begin - B_end)/z, which keeps the lag tau B'
  for (const double z : {1e3, 1e6, 1e8}) {
    EXPECT_NEAR(linear_relaxation(z).begin * z, 1, 1e-12);
    EXPECT_NEAR((1 - linear_relaxation(z).end) * z, 1, 1e-7);  // 1 - end loses log10(z) digits
  }
  const auto infinite = linear_relaxation(INFINITY);
  EXPECT_EQ(infinite.old, 0);
  EXPECT_EQ(infinite.begin, 0);
  EXPECT_EQ(infinite.end, 1);
}

TEST(GaussRelaxation, IntegratesCubicsWithTheExponentialWeight) {
  for (const double z : ratios()) {
    const auto rule = gauss_relaxation(z);
    for (int k = 0; k < 4; ++k) {
      const double mean = static_cast<double>(moment(z, 1) / moment(z, 0));
      double sum = 0;
      for (int i = 0; i < 2; ++i)
        sum += rule.weight[i] * std::pow((1 - rule.theta[i]) / mean, k);
      const double expected = static_cast<double>(moment(z, k)) / std::pow(mean, k);
      // theta rounds at 1: u = 1 - theta has eps z relative to its size 1/z
      EXPECT_NEAR(sum / expected, 1, 1e-12 + 1e-15 * z) << "z " << z << " moment " << k;
    }
  }
}

TEST(GaussRelaxation, IsAConvexCombinationForEveryRatio) {
  auto all = ratios();
  all.insert(all.end(), {1e-300, 1e-100, 1e100, 1e200, 1e300, INFINITY});
  for (const double z : all) {
    const auto rule = gauss_relaxation(z);
    EXPECT_GE(rule.old, 0);
    for (int i = 0; i < 2; ++i) {
      EXPECT_GT(rule.weight[i], 0) << z;
      EXPECT_GT(rule.theta[i], 0) << z;
      EXPECT_LE(rule.theta[i], 1) << z;  // 1 - u rounds to 1 for z beyond 1e16
    }
    EXPECT_NEAR(rule.old + rule.weight[0] + rule.weight[1], 1, 4e-15) << z;
  }
}

TEST(GaussRelaxation, HasItsLimits) {
  const auto nothing = gauss_relaxation(0);
  EXPECT_EQ(nothing.old, 1);
  EXPECT_EQ(nothing.weight[0] + nothing.weight[1], 0);
  // z -> 0: the two-point Gauss-Legendre rule, each with weight z/2
  const auto slow = gauss_relaxation(1e-8);
  const double first = std::min(slow.theta[0], slow.theta[1]);
  EXPECT_NEAR(first, 0.5 - 0.5 / std::sqrt(3), 1e-8);
  EXPECT_NEAR(slow.theta[0] + slow.theta[1], 1, 1e-8);
  EXPECT_NEAR(slow.weight[0] / 0.5e-8, 1, 1e-7);
  EXPECT_NEAR(slow.weight[1] / 0.5e-8, 1, 1e-7);
  // z -> infinity: the two-point Gauss-Laguerre rule at u = (2 -+ sqrt 2)/z
  const double z = 1e6;
  const auto stiff = gauss_relaxation(z);
  EXPECT_NEAR((1 - stiff.theta[0]) * z, 2 - std::sqrt(2), 1e-9);
  EXPECT_NEAR((1 - stiff.theta[1]) * z, 2 + std::sqrt(2), 1e-9);
  EXPECT_NEAR(stiff.weight[0], (2 + std::sqrt(2)) / 4, 1e-12);
  EXPECT_NEAR(stiff.weight[1], (2 - std::sqrt(2)) / 4, 1e-12);
}

TEST(GaussRelaxation, IsContinuousWhereTheFormulaSwitches) {
  for (const double z : {2.0, 50.0}) {
    const auto a = gauss_relaxation(std::nextafter(z, 0)), b = gauss_relaxation(z),
               c = gauss_relaxation(std::nextafter(z, 1e9));
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(a.theta[i], b.theta[i], 1e-14) << z;
      EXPECT_NEAR(b.theta[i], c.theta[i], 1e-14) << z;
      EXPECT_NEAR(a.weight[i], b.weight[i], 1e-14) << z;
      EXPECT_NEAR(b.weight[i], c.weight[i], 1e-14) << z;
    }
  }
}

TEST(Relaxation, KeepsTensorsPositiveDefiniteForEveryRatio) {
  RandomStates random(71);
  for (const double z : ratios()) {
    for (int n = 0; n < 5; ++n) {
      const auto A = random.positive_definite(1e3), B1 = random.positive_definite(1e3),
                 B2 = random.positive_definite(1e3);
      const double least = std::min({eigenvalues(A)[0], eigenvalues(B1)[0], eigenvalues(B2)[0]});
      // eigenvalues of a convex combination: between the least and the largest of the three;
      // 1e-12 is the rounding of eigenvalues beside others 1e6 times larger
      EXPECT_GT(eigenvalues(physics::relaxed(linear_relaxation(z), A, B1, B2))[0],
                least - 1e-12 * 1e3)
          << z;
      EXPECT_GT(eigenvalues(physics::relaxed(gauss_relaxation(z), A, B1, B2))[0],
                least - 1e-12 * 1e3)
          << z;
    }
  }
}

TEST(Relaxation, IsExactForAConstantDeformation) {
  RandomStates random(72);
  for (const double z : ratios()) {
    const auto A = random.positive_definite(5), B = random.positive_definite(5);
    const double E = std::exp(-z);
    const auto exact = E * A + (-std::expm1(-z)) * B;
    EXPECT_LT(distance(physics::relaxed(linear_relaxation(z), A, B, B), exact), 1e-14) << z;
    EXPECT_LT(distance(physics::relaxed(gauss_relaxation(z), A, B, B), exact), 2e-14) << z;
  }
}

TEST(Hermite, ReproducesCubicsAndTheirEnds) {
  RandomStates random(73);
  const auto a = random.tensor(), b = random.tensor(), c = random.tensor(), d = random.tensor();
  const double dt = 0.3;
  const auto F = [&](double t) { return a + t * b + (t * t) * c + (t * t * t) * d; };
  const auto rate = [&](double t) { return b + (2 * t) * c + (3 * t * t) * d; };
  for (const double theta : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const auto value = physics::hermite(theta, dt, F(0), rate(0), F(dt), rate(dt));
    EXPECT_LT(distance(value, F(theta * dt)), 1e-15) << theta;
  }
}

// ---- order on F(t) = I + sin^2(pi t/1.7)/2 (e1 e2 + 0.3 e1 e1 - 0.2 e3 e3), t in [0, 1]
Tensor<double> motion(double t, bool rate) {
  const double w = M_PI / 1.7;
  const double s = rate ? 0.5 * w * std::sin(2 * w * t) : 0.5 * std::pow(std::sin(w * t), 2);
  Tensor<double> F = rate ? Tensor<double>{} : algebra::identity<double>();
  F(0, 1) += s;
  F(0, 0) += 0.3 * s;
  F(2, 2) -= 0.2 * s;
  return F;
}
SymmetricTensor<double> rest(const Tensor<double>& F) {
  return physics::inverse_C(physics::deformation_of(F));
}

/// A(1) by variation of constants, A = e^(-1/tau) I + int e^(-(1-s)/tau) B(s) ds/tau, with
/// Gauss-Legendre rules of three points on panels that are short where the weight lives.
SymmetricTensor<double> exact_A(double tau) {
  const double node = std::sqrt(0.6);
  const int n_panels = 4000;
  const double window = std::min(1.0, 45 * tau);  // e^-45 is below rounding
  SymmetricTensor<double> A = std::exp(-1 / tau) * algebra::symmetric_identity<double>();
  for (int p = 0; p < n_panels; ++p) {
    const double width = window / n_panels, middle = 1 - window + (p + 0.5) * width;
    for (int i = -1; i <= 1; ++i) {
      const double s = middle + i * node * width / 2;
      const double weight = (i == 0 ? 8.0 : 5.0) / 18 * width / tau * std::exp((s - 1) / tau);
      A = A + weight * rest(motion(s, false));
    }
  }
  return A;
}

/// Error of A(1) after n steps of LIN or GEXP from A = I.
double error_of(bool fourth_order, double tau, int n, const SymmetricTensor<double>& exact) {
  const double dt = 1.0 / n;
  const auto linear = linear_relaxation(dt / tau);
  const auto gauss = gauss_relaxation(dt / tau);
  auto A = algebra::symmetric_identity<double>();
  for (int k = 0; k < n; ++k) {
    const auto F0 = motion(k * dt, false), F1 = motion((k + 1) * dt, false);
    if (fourth_order) {
      SymmetricTensor<double> B[2];
      for (int i = 0; i < 2; ++i)
        B[i] = rest(physics::hermite(gauss.theta[i], dt, F0, motion(k * dt, true), F1,
                                     motion((k + 1) * dt, true)));
      A = physics::relaxed(gauss, A, B[0], B[1]);
    } else {
      A = physics::relaxed(linear, A, rest(F0), rest(F1));
    }
  }
  return distance(A, exact);
}

TEST(Relaxation, LinearIsOfSecondAndGaussOfFourthOrder) {
  for (const double tau : {1.0, 0.1}) {
    const auto exact = exact_A(tau);
    const double order_2 =
        std::log2(error_of(false, tau, 64, exact) / error_of(false, tau, 128, exact));
    const double order_4 =
        std::log2(error_of(true, tau, 16, exact) / error_of(true, tau, 32, exact));
    EXPECT_NEAR(order_2, 2, 0.05) << tau;
    EXPECT_NEAR(order_4, 4, 0.15) << tau;
  }
}

TEST(Relaxation, ErrorsStaySmallFromSlowToStiffBranches) {
  // error caps: twice what was measured at the first writing, same size as in notes 5.3
  struct Cap {
    double tau, linear_8, gauss_8, linear_128;
  };
  for (const Cap cap : {Cap{1, 1.5e-3, 4.5e-6, 6e-6}, Cap{0.1, 6e-3, 2e-5, 2.5e-5},
                        Cap{0.01, 2.6e-3, 5e-6, 2.4e-5}, Cap{1e-4, 3e-5, 9e-10, 1.8e-6}}) {
    const auto exact = exact_A(cap.tau);
    const double linear_8 = error_of(false, cap.tau, 8, exact);
    const double linear_128 = error_of(false, cap.tau, 128, exact);
    const double gauss_8 = error_of(true, cap.tau, 8, exact);
    EXPECT_LT(linear_8, cap.linear_8) << cap.tau;
    EXPECT_LT(linear_128, cap.linear_128) << cap.tau;
    EXPECT_LT(gauss_8, cap.gauss_8) << cap.tau;
  }
}

TEST(Relaxation, StiffBranchesLagByTau) {
  // A = B - tau B' + O(tau^2), with steps a thousand times longer than tau
  const double tau = 1e-5, t = 1;
  const auto B = rest(motion(t, false));
  const double dt = 1e-4;
  const auto rate =
      (1 / dt) * (rest(motion(t + dt / 2, false)) + (-1.0) * rest(motion(t - dt / 2, false)));
  const auto lagging = B + (-tau) * rate;
  ASSERT_GT(distance(B, lagging), 1e-6);  // the lag is there to be seen
  for (const bool fourth_order : {false, true}) {
    // LIN takes the mean rate over the step for B': error tau dt B''/2
    EXPECT_LT(error_of(fourth_order, tau, 100, lagging), fourth_order ? 1e-9 : 1e-6);
  }
}

}  // namespace
}  // namespace diptych::tests
