/// What a branch dissipates over a step, for dt/tau from 1e-8 to 1e8, against quadrature of the
/// power along the exact relaxation: sign, both limits of tau, order, and a strained virgin branch,
/// for which the power at an instant times dt is off by orders.

#include "common/physics/step_dissipation.hpp"

#include "common/physics/maxwell_branch.hpp"
#include "common/physics/viscous_evolution.hpp"
#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace diptych::tests {
namespace {

using algebra::Mat3;
using algebra::SymmetricTensor;
using physics::excess_weights;

/// Nodes and weights of Gauss and Legendre's rule of eight points on [-1, 1], by Newton's method.
struct Legendre {
  std::vector<double> x, w;
  Legendre() {
    constexpr int n = 8;
    for (int i = 0; i < n; ++i) {
      double z = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 0;
      for (int pass = 0; pass < 50; ++pass) {
        double p = 1, before = 0;
        for (int k = 1; k <= n; ++k) {
          const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
          before = p;
          p = next;
        }
        slope = n * (z * p - before) / (z * z - 1);
        z -= p / slope;
      }
      x.push_back(z);
      w.push_back(2 / ((1 - z * z) * slope * slope));
    }
  }
};

/// int f over [begin, end], panels that double in length from the first.
template <class Value, class Function>
Value graded(double begin, double end, double first, const Value& zero, const Function& f) {
  static const Legendre rule;
  Value sum = zero;
  double length = first, a = begin;
  while (a < end) {
    const double b = a + length >= end || end - a - length < 1e-3 * length ? end : a + length;
    for (size_t i = 0; i < rule.x.size(); ++i) {
      const double t = 0.5 * (a + b) + 0.5 * (b - a) * rule.x[i];
      sum = sum + 0.5 * (b - a) * rule.w[i] * f(t);
    }
    a = b;
    length = std::min(2 * length, 0.05);
  }
  return sum;
}

/// A smooth motion F(t) and its rate.
Mat3 motion(double t) {
  Mat3 F;
  F << 1.1 + 0.3 * std::sin(1.3 * t), 0.2 * t, 0.1 * std::cos(t), 0.15 * std::sin(2 * t),
      0.9 + 0.1 * t * t, 0.2 * std::sin(t), -0.1 * t, 0.05 * std::cos(2 * t),
      1.2 - 0.2 * std::sin(t);
  return F;
}
Mat3 rate(double t) {
  Mat3 L;
  L << 0.39 * std::cos(1.3 * t), 0.2, -0.1 * std::sin(t), 0.3 * std::cos(2 * t), 0.2 * t,
      0.2 * std::cos(t), -0.1, -0.1 * std::sin(2 * t), -0.2 * std::cos(t);
  return L;
}

/// C = F^T F (or G = cof C) of the motion that runs at `speed` from t = 0.4, over s = 0 to 1.
struct Path {
  double speed;
  bool areas;
  Mat3 F(double s) const { return motion(0.4 + speed * s); }
  Mat3 L(double s) const { return speed * rate(0.4 + speed * s); }
  Mat3 C(double s) const {
    const Mat3 C = F(s).transpose() * F(s);
    return areas ? Mat3(C.determinant() * C.inverse()) : C;
  }
  Mat3 B(double s) const { return C(s).inverse(); }
  Mat3 B_rate(double s) const {
    const Mat3 D = F(s).transpose() * L(s) + L(s).transpose() * F(s);
    const Mat3 c = F(s).transpose() * F(s);
    if (!areas) return -c.inverse() * D * c.inverse();
    return D / c.determinant() - (c.inverse() * D).trace() / c.determinant() * c;
  }
  /// A - B at s of the exact relaxation from A_0.
  Mat3 excess(double s, double z, const Mat3& A_0) const {
    const double span = std::min(s, 60 / z);  // e^-60 is below rounding
    const Mat3 zero = Mat3::Zero();
    const Mat3 lag = graded(0.0, span, std::min(0.5 / z, 0.05), zero,
                            [&](double v) -> Mat3 { return std::exp(-z * v) * B_rate(s - v); });
    return std::exp(-z * s) * (A_0 - B(0)) - lag;
  }
  /// int z (C - A^-1) : (A - B) ds
  double dissipation(double z, const Mat3& A_0) const {
    return graded(0.0, 1.0, std::min(0.25 / z, 0.05), 0.0, [&](double s) {
      const Mat3 M = excess(s, z, A_0), A = B(s) + M;
      return z * (M * A.inverse() * M * C(s)).trace();
    });
  }
  /// By the formula of a step, with the exact A at its end.
  double released(double z, const Mat3& A_0, bool with_rates = true) const {
    using physics::right_tensors;
    const auto F_0 = algebra::to_tensor(F(0)), F_1 = algebra::to_tensor(F(1));
    const auto paths =
        physics::step_paths<true>(right_tensors(F_0), right_tensors(F_1), with_rates, F_0,
                                  algebra::to_tensor(L(0)), F_1, algebra::to_tensor(L(1)));
    return physics::released(excess_weights(z), areas ? paths.G : paths.C,
                             algebra::to_symmetric(A_0),
                             algebra::to_symmetric(B(1) + excess(1, z, A_0)));
  }
};

std::vector<double> ratios() {
  std::vector<double> z;
  for (double exponent = -8; exponent <= 8; exponent += 0.5)
    z.push_back(std::pow(10, exponent));
  return z;
}

/// A of a branch that has followed the path for long: A - B of the size that it has in a body.
Mat3 lagging(const Path& path, double z) {
  return path.B(0) - path.B_rate(0) / std::max(z, 1.0);
}

TEST(StepDissipation, OfAStrainedVirginBranchIsWhatItHeld) {
  // tau << dt: all of psi = C:I - 3 - ln det C goes, where the power at the start times dt is z of
  // it
  const Path path{0.05, false};
  const Mat3 I = Mat3::Identity(), C = path.C(0);
  const double held = C.trace() - 3 - std::log(C.determinant());
  for (const double z : {1e4, 1e6, 1e8}) {
    EXPECT_NEAR(path.released(z, I), path.dissipation(z, I), 1e-6 * held) << z;
    EXPECT_NEAR(path.released(z, I) / held, 1, 0.2 / std::sqrt(z)) << z;
  }
}

TEST(StepDissipation, IsThatOfTheExactRelaxationForEveryRatio) {
  for (const bool areas : {false, true}) {
    for (const double z : ratios()) {
      double error[2];
      for (const int k : {0, 1}) {
        const Path path{0.1 / (1 + k), areas};
        const Mat3 A_0 = lagging(path, z);
        const double exact = path.dissipation(z, A_0), step = path.released(z, A_0);
        error[k] = std::abs(step - exact) / exact;
        EXPECT_GT(step, 0) << z;
        EXPECT_LE(error[k], k == 0 ? 2e-3 : 3e-4) << z << " areas " << areas;
      }
    }
  }
}

TEST(StepDissipation, IsTheEnergyReleasedWhereNothingMoves) {
  Mat3 virgin = Mat3::Identity();
  for (const bool areas : {false, true}) {
    const Path path{0, areas};
    for (const double z : ratios()) {
      const double exact = path.dissipation(z, virgin);
      // one rounding of psi against what goes of it
      EXPECT_NEAR(path.released(z, virgin) / exact, 1, 1e-11 + 5e-16 / z) << z;
    }
  }
}

TEST(StepDissipation, WithoutRatesIsOfSecondOrder) {
  double largest[2] = {0, 0};
  for (const double z : ratios()) {
    for (const int k : {0, 1}) {
      const Path path{0.1 / (1 + k), false};
      const Mat3 A_0 = lagging(path, z);
      largest[k] =
          std::max(largest[k], std::abs(path.released(z, A_0, false) - path.dissipation(z, A_0)));
    }
  }
  EXPECT_LE(largest[1], largest[0] / 6.5);  // a step errs in the third order
}

}  // namespace
}  // namespace diptych::tests
