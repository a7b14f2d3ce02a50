#include "common/functions/time_functions.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::functions {
namespace {

const double pi = std::acos(-1.0);

/// Unit cube, E = 17 MPa, nu = 0.3, rho = 1100, amplitude 5e-4, started at rest and relaxed.
ZenerModeParameters elastic_cube() {
  ZenerModeParameters p;
  p.wave_number_squared = 3 * pi * pi / 4;
  p.density = 1100;
  p.modulus = 17e6 * 0.7 / (1.3 * 0.4);  // lambda + 2 mu
  p.amplitude = 5e-4;
  p.relaxed = true;
  return p;
}

/// xi = zeta = mu/4, beta = 0.5: M_C = 4 beta xi (2 ms), M_G = 8 beta zeta (1 ms).
ZenerModeParameters two_branches() {
  ZenerModeParameters p = elastic_cube();
  const double xi = 17e6 / 2.6 / 4;
  p.branch_moduli = {2 * xi, 4 * xi};
  p.branch_times = {2e-3, 1e-3};
  return p;
}

/// Classical Runge-Kutta with n steps: q, q', q_1, ...
std::vector<double> integrated(const ZenerModeParameters& p, double end, int n) {
  const size_t n_branches = p.branch_times.size();
  const auto rate = [&](const std::vector<double>& s) {
    std::vector<double> r(s.size());
    double stress = p.modulus * s[0];
    for (size_t a = 0; a < n_branches; ++a) {
      stress += p.branch_moduli[a] * (s[0] - s[2 + a]);
      r[2 + a] = (s[0] - s[2 + a]) / p.branch_times[a];
    }
    r[0] = s[1];
    r[1] = -p.wave_number_squared / p.density * stress;
    return r;
  };
  const auto moved = [](std::vector<double> s, const std::vector<double>& r, double dt) {
    for (size_t i = 0; i < s.size(); ++i)
      s[i] += dt * r[i];
    return s;
  };
  std::vector<double> s{p.amplitude, p.rate};
  s.resize(2 + n_branches, p.relaxed ? p.amplitude : 0);
  const double dt = end / n;
  for (int i = 0; i < n; ++i) {
    const auto k1 = rate(s), k2 = rate(moved(s, k1, dt / 2)), k3 = rate(moved(s, k2, dt / 2)),
               k4 = rate(moved(s, k3, dt));
    for (size_t j = 0; j < s.size(); ++j)
      s[j] += dt / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
  }
  return s;
}

/// All values against a fine integration, relative to the size of the motion.
void expect_solves(const ZenerModeParameters& p, double end, int n, double tolerance) {
  const ZenerMode mode("q", p);
  const std::vector<double> s = integrated(p, end, n), v = mode.values(end);
  const double omega = std::sqrt(p.wave_number_squared * p.modulus / p.density);
  const double size = std::abs(p.amplitude) + std::abs(p.rate) / omega;
  EXPECT_NEAR(v[0], s[0], tolerance * size);
  EXPECT_NEAR(v[1], s[1], tolerance * size * omega);
  for (size_t a = 0; a < p.branch_times.size(); ++a)
    EXPECT_NEAR(v[3 + a], s[2 + a], tolerance * size) << "branch " << a + 1;
}

TEST(ZenerMode, GivesTheTabulatedSwingingCube) {
  const ZenerMode elastic("q", elastic_cube()), viscous("q", two_branches());
  const double t[] = {1e-3, 2e-3, 4e-3, 8e-3, 16e-3};
  const double q_elastic[] = {4.61992312e-4, 3.53747587e-4, 5.49421547e-7, -4.99998793e-4,
                              4.99995170e-4};
  const double q_viscous[] = {4.62171120e-4, 3.56142941e-4, 2.62088698e-5, -3.69476866e-4,
                              2.77336774e-4};
  for (int i = 0; i < 5; ++i) {  // nine printed digits
    EXPECT_NEAR(elastic.values(t[i])[0], q_elastic[i], 6e-13);
    EXPECT_NEAR(viscous.values(t[i])[0], q_viscous[i], 6e-13);
  }
}

TEST(ZenerMode, HasTheTabulatedRoots) {
  const ZenerMode mode("q", two_branches());
  std::vector<double> real, imaginary;
  for (const auto& root : mode.roots()) {
    real.push_back(root.real());
    imaginary.push_back(std::abs(root.imag()));
  }
  std::sort(real.begin(), real.end());
  EXPECT_NEAR(real[0], -962.393, 1e-3);
  EXPECT_NEAR(real[1], -469.211, 1e-3);
  EXPECT_NEAR(real[2], -34.197887, 1e-6);
  EXPECT_NEAR(*std::max_element(imaginary.begin(), imaginary.end()), 411.515496, 1e-6);
}

// Reference of an independent solver: one branch of modulus 19.6 MPa and 0.1 s, from rest virgin.
TEST(ZenerMode, AgreesWithAnIndependentSolution) {
  ZenerModeParameters p = elastic_cube();
  p.branch_moduli = {19615384.615384616};
  p.branch_times = {0.1};
  p.amplitude = 0;
  p.rate = 0.02;
  p.relaxed = false;
  const ZenerMode mode("q", p);
  const double t[] = {0.002, 0.01, 0.1};
  const double q[] = {3.2814252523252466e-05, -2.9302084301584148e-05, -1.5894249659029121e-06};
  const double q_dot[] = {0.009641227355930867, 0.0115271226250011, -0.015848634386634326};
  const double q_1[] = {3.608529648338119e-07, 2.54054622535501e-07, 9.618952890275978e-07};
  for (int i = 0; i < 3; ++i) {  // of sizes 4e-5, 2e-2, 1e-6; the reference claims ten digits
    const std::vector<double> v = mode.values(t[i]);
    EXPECT_NEAR(v[0], q[i], 1e-14);
    EXPECT_NEAR(v[1], q_dot[i], 5e-12);
    EXPECT_NEAR(v[3], q_1[i], 1e-15);
  }
}

TEST(ZenerMode, SolvesTheEquationsFromEveryStart) {
  // 16 ms in 4000 steps: (400/s * 4e-6 s)^4 is 6e-12.
  for (const bool relaxed : {true, false}) {
    ZenerModeParameters p = two_branches();
    p.relaxed = relaxed;
    p.rate = 0.3;
    expect_solves(p, 16e-3, 4000, 1e-10);
  }
}

TEST(ZenerMode, SolvesBranchesOfEqualTime) {
  ZenerModeParameters p = two_branches();
  p.branch_moduli.push_back(5e6);
  p.branch_times = {1e-3, 1e-3, 1e-2};
  expect_solves(p, 16e-3, 4000, 1e-10);
}

// Stiff branches follow q at once: q_1 = q - tau q' + O(tau^2), and q is the elastic one up to
// the damping omega M_1/M tau.
TEST(ZenerMode, KeepsItsDigitsWithStiffBranches) {
  ZenerModeParameters p = elastic_cube();
  p.branch_moduli = {p.modulus};
  p.branch_times = {1e-12};
  const ZenerMode stiff("q", p), elastic("q", elastic_cube());
  const std::vector<double> v = stiff.values(16e-3);
  EXPECT_NEAR(v[0], elastic.values(16e-3)[0], 1e-11 * p.amplitude * 392 * 16);
  EXPECT_NEAR(v[3], v[0] - 1e-12 * v[1], 1e-12 * p.amplitude);
}

// Branches of five decades of time, without a stiff integration: the equations at the answer.
TEST(ZenerMode, SatisfiesItsEquationsOverManyDecades) {
  ZenerModeParameters p = elastic_cube();
  for (const double tau : {1e-9, 1e-6, 1e-3, 1.0, 1e5}) {
    p.branch_moduli.push_back(p.modulus / 2);
    p.branch_times.push_back(tau);
  }
  p.relaxed = false;
  p.rate = 0.1;
  const ZenerMode mode("q", p);
  const std::vector<double> start = mode.values(0);
  EXPECT_NEAR(start[0], p.amplitude, 1e-12 * p.amplitude);
  EXPECT_NEAR(start[1], p.rate, 1e-12 * p.rate);
  for (size_t a = 0; a < 5; ++a)
    EXPECT_NEAR(start[3 + a], 0, 1e-12 * p.amplitude);
  const double t = 5e-3, h = 1e-6;
  const std::vector<double> before = mode.values(t - h), v = mode.values(t),
                            next = mode.values(t + h);
  // Central differences: (omega h)^2/6 = 5e-8 of the rate; times tau where that is long.
  EXPECT_NEAR((next[1] - before[1]) / (2 * h), v[2], 1e-6 * 5e-4 * 700 * 700);
  for (size_t a = 0; a < 5; ++a) {
    const double rate = (next[3 + a] - before[3 + a]) / (2 * h);
    const double tau = p.branch_times[a];
    EXPECT_NEAR(rate * tau, v[0] - v[3 + a], 1e-6 * p.amplitude * std::max(1.0, 700 * tau));
  }
}

TEST(ZenerMode, NamesAndAccelerationFit) {
  const ZenerMode mode("q", two_branches());
  EXPECT_EQ(mode.names(), (std::vector<std::string>{"q", "q_dot", "q_ddot", "q_1", "q_2"}));
  const double h = 1e-6, t = 3e-3;
  const double ddot = (mode.values(t + h)[1] - mode.values(t - h)[1]) / (2 * h);
  EXPECT_NEAR(mode.values(t)[2], ddot, 1e-6 * 5e-4 * 411 * 411);  // h^2 omega^2 / 6 = 3e-8
  const double dot = (mode.values(t + h)[0] - mode.values(t - h)[0]) / (2 * h);
  EXPECT_NEAR(mode.values(t)[1], dot, 1e-6 * 5e-4 * 411);
}

// The roots of w^3 T + w^2 + w T + m, in units of the glassy frequency, are all -3^-1/2 for
// T = 3^-1/2 and m = 1/9.
TEST(ZenerMode, RefusesCoincidentRoots) {
  ZenerModeParameters p;
  p.modulus = 1.0 / 9;
  p.branch_moduli = {8.0 / 9};
  p.branch_times = {1 / std::sqrt(3.0)};
  p.amplitude = 1;
  EXPECT_THROW(ZenerMode("q", p), base::InputError);
}

}  // namespace
}  // namespace diptych::functions
