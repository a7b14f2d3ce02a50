/// Homogeneous tests of the material against closed forms at finite strain (one C and one G branch)
/// and against tabulated integrations of the uniaxial tests.

#include "benchmarks/material/material_path.hpp"
#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::harness {
namespace {

using run::Mat3;

constexpr double tau_C = 2e-3, tau_G = 1e-3;
constexpr double mu = 17e6 / 2.6, lambda = 17e6 * 0.3 / (1.3 * 0.4);
constexpr double xi_a = 0.5 * mu / 4, zeta_a = 0.5 * mu / 4;  // beta = 0.5, xi = zeta = mu/4

cases::MaterialCase ve2() {
  cases::MaterialCase m;
  m.density = 1100;
  m.shear_modulus = mu;
  m.lame = lambda;
  m.zeta_ratio = 0.5;
  m.branches = {{0.5, tau_C, 0.5, tau_G}};
  return m;
}

/// E = 17 MPa, nu = 0.45, beta = 1, both times equal.
cases::MaterialCase ve5(double tau) {
  cases::MaterialCase m;
  m.density = 1100;
  m.shear_modulus = 17e6 / 2.9;
  m.lame = 17e6 * 0.45 / (1.45 * 0.1);
  m.zeta_ratio = 0.5;
  m.branches = {{1, tau, 1, tau}};
  return m;
}

MaterialPath path_of(const std::string& name, double end, int n_steps) {
  MaterialPath path;
  read_path_name(name, path);
  path.end = end;
  path.n_steps = n_steps;
  return path;
}

std::vector<PathPoint> followed(const cases::MaterialCase& material, const MaterialPath& path) {
  return follow(run::make_material_point(material), path);
}

TEST(MaterialPath, StepInShearRelaxesExponentially) {
  MaterialPath path = path_of("shear-step", 3e-3, 7);
  path.amplitude = 0.8;
  const auto material = run::make_material_point(ve2());
  cases::MaterialCase without = ve2();
  without.branches.clear();
  const auto points = follow(material, path);
  for (const PathPoint& p : points) {
    // c = F A F^T and d = H S H^T decay to I: P12 of the branches is (2 xi^a + 2 zeta^a) gamma
    const double branches =
        0.8 * (2 * xi_a * std::exp(-p.time / tau_C) + 2 * zeta_a * std::exp(-p.time / tau_G));
    EXPECT_NEAR(p.P(0, 1), mu * 0.8 + branches, 1e-9 * mu);
  }
  const double equilibrium = followed(without, path).front().P(0, 0);
  EXPECT_NE(equilibrium, points.front().P(0, 0)) << "the branches carry normal stress";
}

TEST(MaterialPath, StartOfShearGivesTheMaxwellStresses) {
  // Kirchhoff stress of the branches: C: 2 xi^a g tau (1 - e), N1 = 2 xi^a D; G: N1 = -N2 = 2
  // zeta^a D with D = 2 (g tau)^2 [1 - e - (t/tau) e]
  MaterialPath path = path_of("shear-ramp", 5e-3, 200);
  path.rate = 400;
  cases::MaterialCase without = ve2();
  without.branches.clear();
  for (const auto& [update, tolerance] : {std::pair{Update::gauss, 1e-8}, {Update::linear, 3e-4}}) {
    path.update = update;
    const PathPoint p = followed(ve2(), path).back(), e = followed(without, path).back();
    const double t = p.time;
    const Mat3 branches = (p.P - e.P) * p.state.F.transpose();
    const auto D = [&](double tau) {
      const double decay = std::exp(-t / tau), g = 400 * tau;
      return 2 * g * g * (1 - decay - t / tau * decay);
    };
    const double shear_C = 2 * xi_a * 400 * tau_C * (1 - std::exp(-t / tau_C));
    const double shear_G = 2 * zeta_a * 400 * tau_G * (1 - std::exp(-t / tau_G));
    EXPECT_NEAR(branches(0, 1), shear_C + shear_G, tolerance * mu);
    EXPECT_NEAR(branches(0, 0) - branches(1, 1), 2 * xi_a * D(tau_C) + 2 * zeta_a * D(tau_G),
                tolerance * mu);
    EXPECT_NEAR(branches(1, 1) - branches(2, 2), -2 * zeta_a * D(tau_G), tolerance * mu);
  }
}

TEST(MaterialPath, OscillatoryShearIsLinearAtAnyAmplitude) {
  const double omega = 500;
  const auto share = [&](double tau) { return omega * tau / (1 + omega * omega * tau * tau); };
  const double storage =
      mu + 2 * xi_a * omega * tau_C * share(tau_C) + 2 * zeta_a * omega * tau_G * share(tau_G);
  const double loss = 2 * xi_a * share(tau_C) + 2 * zeta_a * share(tau_G);
  for (const double amplitude : {0.01, 0.7, 3.0}) {
    MaterialPath path = path_of("shear-oscillation", 8 * 2 * M_PI / omega, 2000);
    path.amplitude = amplitude;
    path.angular_frequency = omega;
    const DynamicModuli G = dynamic_moduli(followed(ve2(), path), path);
    // the start has decayed to exp(-7 T/tau_C) = 1e-19; of a cycle of 250 nothing is missed
    EXPECT_NEAR(G.storage, storage, 1e-7 * mu) << amplitude;
    EXPECT_NEAR(G.loss, loss, 1e-7 * mu) << amplitude;
  }
}

/// Whatever the phase at which the steps meet the cycle: the loss modulus is a tenth of the other.
TEST(MaterialPath, ModuliAreKnownToAPercentFromTheStepsOnThatTheyAskFor) {
  MaterialPath path = path_of("confined-oscillation", 8.37 * 2 * M_PI / 500, 4000);
  path.amplitude = 0.2;
  path.angular_frequency = 500;
  const DynamicModuli exact = dynamic_moduli(followed(ve2(), path), path);
  for (const auto update : {Update::linear, Update::gauss}) {
    path.update = update;
    path.n_steps = static_cast<int>(std::ceil(8.37 * steps_of_a_cycle(update)));
    const DynamicModuli G = dynamic_moduli(followed(ve2(), path), path);
    EXPECT_NEAR(G.storage / exact.storage, 1, 0.01);
    EXPECT_NEAR(G.loss / exact.loss, 1, 0.01);
  }
}

/// An imposed stress has the moduli of an imposed strain.
TEST(MaterialPath, CreepHasTheModuliOfUniaxialStrain) {
  DynamicModuli G[2];
  for (const int i : {0, 1}) {
    MaterialPath path =
        path_of(i == 0 ? "uniaxial-oscillation" : "creep-oscillation", 8 * 2 * M_PI / 500, 400);
    path.amplitude = i == 0 ? 1e-3 : 1e-3 * mu;
    path.angular_frequency = 500;
    G[i] = dynamic_moduli(followed(ve2(), path), path);
  }
  EXPECT_NEAR(G[1].storage / G[0].storage, 1, 1e-3);
  EXPECT_NEAR(G[1].loss / G[0].loss, 1, 1e-3);
}

std::string refusal(const MaterialPath& path) {
  try {
    followed(ve2(), path);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MaterialPath, RefusesWhatItCannotFollowOrDoesNotUse) {
  MaterialPath path = path_of("shear-oscillation", 1, 1000);
  path.amplitude = 0.1;
  path.angular_frequency = 6000;  // 955 cycles
  EXPECT_EQ(refusal(path),
            "--steps 1000 are 1.05 a cycle, and its moduli need 16: give --steps 15279, or a "
            "shorter --end");
  path.n_steps = 15279;
  EXPECT_EQ(refusal(path), "accepted");
  path.update = Update::linear;
  EXPECT_THAT(refusal(path), testing::HasSubstr("--steps 23874"));
  path.rate = 1;
  EXPECT_EQ(refusal(path), "--rate has no effect on an oscillation; remove it");
  path = path_of("shear-step", 1, 10);
  path.amplitude = path.angular_frequency = 1;
  EXPECT_EQ(refusal(path), "--frequency has no effect on a step; remove it");
  path.angular_frequency = 0;
  for (double* value : {&path.amplitude, &path.rate, &path.angular_frequency, &path.end}) {
    MaterialPath whole = path;
    for (const double none : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      *value = none;
      EXPECT_THAT(refusal(path), testing::HasSubstr("must be a finite number"));
    }
    path = whole;
  }
}

TEST(MaterialPath, ConfinedStepRelaxesToTheElasticStress) {
  MaterialPath path = path_of("confined-step", 4e-3, 16);
  path.amplitude = -0.3;
  for (const PathPoint& p : followed(ve2(), path)) {
    const double f = 0.7, g = f - 1 / f, xi = mu / 4, zeta = mu / 4;
    const double P = 2 * (xi + 2 * zeta) * g + (lambda - 4 * zeta) * (f - 1) +
                     2 * xi_a * std::exp(-p.time / tau_C) * g +
                     4 * zeta_a * std::exp(-p.time / tau_G) * g;
    EXPECT_NEAR(p.P(0, 0), P, 1e-9 * mu);
  }
}

TEST(MaterialPath, UniaxialRelaxationAndCreepGiveTheTabulatedStates) {
  const double tau = 1e-2;
  MaterialPath relaxation = path_of("uniaxial-step", tau, 100);
  relaxation.amplitude = 0.5;
  const auto relaxed = followed(ve5(tau), relaxation);
  EXPECT_NEAR(relaxed.front().P(0, 0), 1.03034159e7, 0.1);
  EXPECT_NEAR(relaxed.back().P(0, 0), 7.05549577e6, 0.1);
  EXPECT_NEAR(relaxed.back().P(1, 1), 0, 1e-4);
  MaterialPath creep = path_of("creep-step", tau, 100);
  creep.amplitude = 3e6;
  const auto crept = followed(ve5(tau), creep);
  EXPECT_NEAR(crept.front().state.F(0, 0), 1.10184049, 1e-8);
  EXPECT_NEAR(crept.back().state.F(0, 0), 1.14781600, 1e-8);
}

TEST(MaterialPath, WorkIsStoredOrDissipated) {
  for (const char* name : {"shear-oscillation", "uniaxial-oscillation", "confined-oscillation"}) {
    MaterialPath path = path_of(name, 0.03, 4000);
    path.amplitude = 0.4;
    path.angular_frequency = 600;
    const auto points = followed(ve2(), path);
    const PathPoint& end = points.back();
    EXPECT_GT(end.dissipated, 0) << name;
    // trapezoids of 190 steps a cycle
    EXPECT_NEAR(end.work, end.energy - points.front().energy + end.dissipated, 1e-4 * end.work)
        << name;
  }
}

// Of a branch that relaxes within a millionth of a step, and within a tenth of one.
TEST(MaterialPath, WorkIsStoredOrDissipatedWhateverTheRelaxationTime) {
  for (const double tau : {1e-15, 1e-10, 1e-5, 3e-4}) {
    SCOPED_TRACE(tau);
    MaterialPath ramp = path_of("shear-ramp", 0.05, 500);
    ramp.rate = 10;
    const auto sheared = followed(ve5(tau), ramp);
    const PathPoint& end = sheared.back();
    EXPECT_NEAR(end.work, end.energy - sheared.front().energy + end.dissipated, 1e-5 * end.work);
    MaterialPath step = path_of("shear-step", 0.05, 500);
    step.amplitude = 0.1;
    const auto released = followed(ve5(tau), step);
    const double lost = released.front().energy - released.back().energy;
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(released.back().dissipated, lost, 1e-9 * lost);
  }
}

TEST(MaterialPath, UpdatesConvergeAtTheirOrders) {
  MaterialPath path = path_of("uniaxial-oscillation", 6e-3, 4000);
  path.amplitude = 0.4;
  path.angular_frequency = 800;
  const double exact = followed(ve2(), path).back().P(0, 0);
  for (const auto& [update, order] : {std::pair{Update::linear, 1.9}, {Update::gauss, 3.5}}) {
    path.update = update;
    double error[2];
    for (const int i : {0, 1}) {
      path.n_steps = i == 0 ? 20 : 40;
      error[i] = std::abs(followed(ve2(), path).back().P(0, 0) - exact);
    }
    EXPECT_GE(std::log2(error[0] / error[1]), order);
  }
}

TEST(MaterialPath, ScanFindsTheSlowestWave) {
  cases::MaterialCase elastic = ve2();
  elastic.branches.clear();
  const auto material = run::make_material_point(elastic);
  MaterialPath path = path_of("shear-step", 1, 1);
  path.amplitude = 1e-9;
  const auto scan = scan_hyperbolicity(material, follow(material, path), 300);
  EXPECT_NEAR(scan.least, mu, 1e-6 * mu) << "the shear modulus, undeformed";
  // An isochoric solid under strong extension keeps mu J^(-2/3) but loses the bulk's help: still
  // hyperbolic, since it is polyconvex
  cases::MaterialCase isochoric = elastic;
  isochoric.model = "neo-hookean-isochoric";
  isochoric.zeta_ratio = 0;
  const auto soft = run::make_material_point(isochoric);
  path = path_of("confined-ramp", 1, 50);
  path.rate = 4;
  EXPECT_GT(scan_hyperbolicity(soft, follow(soft, path), 300).least, 0);
}

TEST(MaterialPath, RefusesWhatItCannotFollow) {
  const auto material = run::make_material_point(ve2());
  MaterialPath path = path_of("confined-step", 1, 10);
  EXPECT_THROW(follow(material, path), base::InputError) << "no amplitude";
  path.amplitude = -1;
  EXPECT_THROW(follow(material, path), base::InputError) << "crushed to nothing";
  EXPECT_THROW(read_path_name("shear-bump", path), base::InputError);
  path = path_of("shear-oscillation", 1, 10);
  path.amplitude = 1;
  EXPECT_THROW(follow(material, path), base::InputError) << "no frequency";
}

}  // namespace
}  // namespace diptych::harness
