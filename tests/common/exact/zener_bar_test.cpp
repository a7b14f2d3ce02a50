/// The bar against d'Alembert, against the sum of its modes, against itself at two precisions, and
/// against the table of the plane wave in the standard linear solid (VE1).

#include "common/exact/zener_bar.hpp"

#include "common/functions/time_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::exact {
namespace {

const double pi = std::acos(-1.0);

/// E = 17 MPa, nu = 0.3, rho = 1100, zeta = 0, beta_C = 1: M_C = 4 xi^a, tau = 2 ms.
ZenerBarParameters ve1() {
  ZenerBarParameters p;
  p.density = 1100;
  p.modulus = 17e6 * 0.7 / (1.3 * 0.4);
  p.branch_moduli = {4 * 17e6 / 2.6 / 2};
  p.branch_times = {2e-3};
  return p;
}

TEST(ZenerBar, WithoutBranchesIsDAlembert) {
  ZenerBarParameters p;  // c = 1, L = 1
  p.amplitude = 2;
  const ZenerBar bar("w", p);
  EXPECT_EQ(bar.values_at({0.5, 0, 0}, 0.4)[0], 0) << "the front has not come yet";
  // one passage: stress 2; after the fixed end 4; after the free end, unloaded back to 2
  const auto at = [&](double t) { return bar.values_at({0.5, 0, 0}, t); };
  EXPECT_NEAR(at(1.0)[3], 2, 1e-9);
  EXPECT_NEAR(at(1.0)[0], 2 * 0.5, 1e-9);
  EXPECT_NEAR(at(1.0)[1], 2, 1e-9);
  EXPECT_NEAR(at(2.0)[3], 4, 1e-9);
  EXPECT_NEAR(at(2.0)[1], 0, 1e-9);
  EXPECT_NEAR(at(3.0)[3], 2, 1e-9);
  EXPECT_NEAR(at(3.0)[1], -2, 1e-9);
  EXPECT_NEAR(at(4.0)[0], 0, 1e-8) << "period 4 L/c";
}

TEST(ZenerBar, GivesTheTabulatedPlaneWave) {
  ZenerBarParameters p = ve1();
  p.is_slab = false;
  p.signal = Signal::sine;
  p.amplitude = 1;
  p.angular_frequency = 200;
  p.ramp_rate = 100;
  const ZenerBar bar("w", p);
  EXPECT_NEAR(bar.phase_speed(), 151.665442, 1e-6);
  EXPECT_NEAR(bar.attenuation(), 1.194405e-1, 1e-7);
  EXPECT_NEAR(bar.values_at({0, 0, 0}, 0.02)[1], std::sin(4.0) * std::pow(1 - std::exp(-2.0), 3),
              1e-9)
      << "at x = 0 the velocity is the signal";
  // when the start has decayed, v = exp(-alpha x) sin(omega (t - x/c))
  for (const double x : {0.3, 1.0, 2.5}) {
    const double t = 0.3;
    const double steady =
        std::exp(-bar.attenuation() * x) * std::sin(200 * (t - x / bar.phase_speed()));
    EXPECT_NEAR(bar.values_at({x, 0, 0}, t)[1], steady, 1e-8) << x;
  }
}

TEST(ZenerBar, IsTheSumOfTheModesOfTheSlab) {
  // Held at 0, constant stress at L: u = sigma x/M + sum q_n(t) sin(k_n x), k_n = (n + 1/2) pi/L,
  // q_n(0) minus the static amplitude, branches relaxed with it (they are 0 in the virgin slab).
  ZenerBarParameters p = ve1();
  p.length = 0.4;
  p.amplitude = 1e3;
  const ZenerBar slab("w", p);
  const double x = 0.27, L = p.length;
  for (const double t : {1e-3, 2.5e-3, 7e-3, 20e-3}) {
    double u = p.amplitude * x / p.modulus;
    const int n_modes = 2000;
    for (int n = 0; n < n_modes; ++n) {
      functions::ZenerModeParameters mode;
      const double k = (n + 0.5) * pi / L;
      mode.wave_number_squared = k * k;
      mode.density = p.density;
      mode.modulus = p.modulus;
      mode.branch_moduli = p.branch_moduli;
      mode.branch_times = p.branch_times;
      mode.relaxed = true;
      mode.amplitude = -(n % 2 == 0 ? 1 : -1) * 2 * p.amplitude / (L * k * k * p.modulus);
      u += functions::ZenerMode("q", mode).values(t)[0] * std::sin(k * x);
    }
    // the modes left out sum up to less than 2 L/(pi^2 n) of the static displacement, in practice
    // a hundredth of it since they alternate
    EXPECT_NEAR(slab.values_at({x, 0, 0}, t)[0], u, 2e-6 * p.amplitude * L / p.modulus) << t;
  }
}

TEST(ZenerBar, IsFiniteWhereTheFrontIsOnTheNode) {
  ZenerBarParameters p = ve1();
  p.amplitude = 1;
  const ZenerBar slab("w", p);
  for (int i = 1; i <= 40; ++i) {
    const double x = 0.025 * i, t = (1 - x) / slab.front_speed();
    for (const double after : {0.0, 1e-19, 1e-16, 1e-12}) {
      const double stress = slab.values_at({x, 0, 0}, t + after)[3];
      EXPECT_GE(stress, -1e-9);
      EXPECT_LE(stress, 1 + 1e-9);
    }
  }
}

TEST(ZenerBar, AgreesWithItselfAtTwoPrecisions) {
  ZenerBarParameters p = ve1();
  p.branch_moduli.push_back(9e6);
  p.branch_times.push_back(3e-4);
  p.amplitude = 1;
  p.angular_frequency = 700;
  p.ramp_rate = 300;
  for (const bool is_slab : {true, false}) {
    for (const Signal signal : {Signal::step, Signal::one_minus_cosine, Signal::sine}) {
      p.is_slab = is_slab;
      p.signal = signal;
      const ZenerBar bar("w", p);
      const double M = p.modulus, c = bar.front_speed();
      const double stress = is_slab ? 1 : p.density * c;
      for (const double x : {0.05, 0.4, 0.95}) {
        for (const double t : {4e-3, 7.3e-3, 25e-3}) {
          const BarMotion a = bar.motion<double>(x, t, 24), b = bar.motion<long double>(x, t, 36);
          EXPECT_NEAR(a.stress, b.stress, 1e-8 * stress);
          EXPECT_NEAR(a.strain, b.strain, 1e-8 * stress / M);
          EXPECT_NEAR(a.v, b.v, 1e-8 * stress / (p.density * c));
          EXPECT_NEAR(a.u, b.u, 1e-8 * stress / M);
        }
      }
    }
  }
}

TEST(ZenerBar, SatisfiesItsEquations) {
  ZenerBarParameters p = ve1();
  p.amplitude = 1;
  p.signal = Signal::one_minus_cosine;
  p.angular_frequency = 900;
  const ZenerBar bar("w", p);
  const double x = 0.4, t = 9e-3, h = 1e-3, dt = 1e-6;
  const auto at = [&](double X, double T) { return bar.motion<long double>(X, T, 32); };
  const double v = (at(x, t + dt).u - at(x, t - dt).u) / (2 * dt);
  const double strain = (at(x + h, t).u - at(x - h, t).u) / (2 * h);
  const double a = (at(x, t + dt).v - at(x, t - dt).v) / (2 * dt);
  const double force = (at(x + h, t).stress - at(x - h, t).stress) / (2 * h);
  const BarMotion m = at(x, t);
  EXPECT_NEAR(m.v, v, 1e-5 * std::abs(v));  // second-order differences
  EXPECT_NEAR(m.strain, strain, 1e-4 * std::abs(strain));
  EXPECT_NEAR(p.density * a, force, 1e-3 * std::abs(force));
}

}  // namespace
}  // namespace diptych::exact
