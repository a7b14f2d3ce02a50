/// Homogeneous deformations of the viscoelastic model with exact answers at finite strain:
/// relaxation at fixed F, start-up of simple shear, large-amplitude oscillatory shear, confined
/// relaxation. The internal variables are advanced by the library's updates.

#include "tests/common/physics/body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::tests {
namespace {

using algebra::to_eigen;
using physics::deformation_of;

/// The second viscoelastic material of the catalogue: E = 17 MPa, nu = 0.3, xi = zeta,
/// beta_C = beta_G = 1/2, tau_C = 2 ms, tau_G = 1 ms.
Body<physics::MooneyRivlin> material_VE2() {
  const auto p = physics::mooney_rivlin_parameters(physics::lame_from_young(17e6, 0.3), 0.5);
  return {{p.xi, p.zeta, p.lambda_hat}, {{p.xi / 2, 2e-3, p.zeta / 2, 1e-3}}, {virgin()}};
}

/// Advances the branches over dt by (GEXP); F runs from F0 to F1 with the given rates.
void relax(Body<physics::MooneyRivlin>& body,
           double dt,
           const Tensor<double>& F0,
           const Tensor<double>& rate0,
           const Tensor<double>& F1,
           const Tensor<double>& rate1) {
  for (size_t k = 0; k < body.branches.size(); ++k) {
    const auto rest_at = [&](double theta) {
      return deformation_of(physics::hermite(theta, dt, F0, rate0, F1, rate1));
    };
    const auto rule_C = physics::gauss_relaxation(dt / body.branches[k].tau_C);
    const auto rule_G = physics::gauss_relaxation(dt / body.branches[k].tau_G);
    auto& state = body.states[k];
    state.A = physics::relaxed(rule_C, state.A, physics::inverse_C(rest_at(rule_C.theta[0])),
                               physics::inverse_C(rest_at(rule_C.theta[1])));
    state.S = physics::relaxed(rule_G, state.S, physics::inverse_G(rest_at(rule_G.theta[0])),
                               physics::inverse_G(rest_at(rule_G.theta[1])));
  }
}

TEST(HomogeneousDeformation, StressRelaxesAsTheSumOfTwoExponentials) {
  RandomStates random(81);
  const auto model = material_VE2();
  const auto& m = model.material;
  const auto& branch = model.branches[0];
  for (int n = 0; n < 50; ++n) {
    const auto X = deformation_of(random.deformation_gradient(2));
    const Mat3 F = to_eigen(X.F), H = to_eigen(X.H);
    const Mat3 P_infinity = to_eigen(physics::piola_stress<true>(m.response(X), X));
    const Mat3 P_C = 2 * branch.xi * (F - F.inverse().transpose());
    const Mat3 P_G = 2 * branch.zeta * (to_eigen(algebra::cross(X.H, X.F)) - 2 / X.J * H);
    for (const double t : {0.0, 1e-4, 2e-3, 1e-2, 1.0}) {
      auto body = model;  // one step, whatever its length: the updates are exact for constant F
      relax(body, t, X.F, {}, X.F, {});
      const Mat3 expected =
          P_infinity + std::exp(-t / branch.tau_C) * P_C + std::exp(-t / branch.tau_G) * P_G;
      EXPECT_LT(distance(to_eigen(body.piola(X)), expected), 1e-12 * expected.norm()) << t;
    }
  }
}

Tensor<double> simple_shear(double gamma) {
  auto F = algebra::identity<double>();
  F(0, 1) = gamma;
  return F;
}
Tensor<double> shear_rate(double rate) {
  Tensor<double> F{};
  F(0, 1) = rate;
  return F;
}
/// Kirchhoff stress P F^T.
Mat3 kirchhoff(const Body<physics::MooneyRivlin>& body, const Tensor<double>& F) {
  return to_eigen(body.piola(F)) * to_eigen(F).transpose();
}

TEST(HomogeneousDeformation, StartUpOfShearHasTheNormalStressesOfMaxwellsModel) {
  const auto model = material_VE2();
  const auto& branch = model.branches[0];
  const double mu = 2 * (model.material.xi + model.material.zeta);
  for (const double rate : {10.0, 1e3}) {
    for (const double t : {1e-4, 1e-3, 4e-3}) {
      // one step: C^-1 and G^-1 are quadratic in time, for which (GEXP) is exact
      auto body = model;
      const auto F = simple_shear(rate * t);
      relax(body, t, simple_shear(0), shear_rate(rate), F, shear_rate(rate));
      const Mat3 tau = kirchhoff(body, F);
      const auto elastic = Body<physics::MooneyRivlin>{model.material, {}, {}};
      const Mat3 tau_elastic = kirchhoff(elastic, F);
      const auto shear = [&](double relaxation) {
        return rate * relaxation * -std::expm1(-t / relaxation);
      };
      const auto D = [&](double relaxation) {
        const double e = std::exp(-t / relaxation);
        return 2 * std::pow(rate * relaxation, 2) * (1 - e - t / relaxation * e);
      };
      const double xi2 = 2 * branch.xi, zeta2 = 2 * branch.zeta;
      const Mat3 viscous = tau - tau_elastic;
      const double scale = 1e-11 * (tau.norm() + tau_elastic.norm());  // D cancels at small t/tau
      EXPECT_NEAR(tau_elastic(0, 1), mu * rate * t, scale);
      EXPECT_NEAR(viscous(0, 1), xi2 * shear(branch.tau_C) + zeta2 * shear(branch.tau_G), scale);
      EXPECT_NEAR(viscous(0, 0) - viscous(1, 1), xi2 * D(branch.tau_C) + zeta2 * D(branch.tau_G),
                  scale);
      EXPECT_NEAR(viscous(1, 1) - viscous(2, 2), -zeta2 * D(branch.tau_G), scale);
    }
  }
}

TEST(HomogeneousDeformation, OscillatoryShearIsLinearInTheAmplitude) {
  const auto model = material_VE2();
  const auto& branch = model.branches[0];
  const double mu = 2 * (model.material.xi + model.material.zeta);
  const int per_cycle = 200, n_cycles = 30;
  for (const double omega : {200.0, 600.0, 3000.0}) {
    double storage = mu, loss = 0;
    for (const auto& [modulus, relaxation] :
         {std::pair{2 * branch.xi, branch.tau_C}, std::pair{2 * branch.zeta, branch.tau_G}}) {
      const double wt = omega * relaxation;
      storage += modulus * wt * wt / (1 + wt * wt);
      loss += modulus * wt / (1 + wt * wt);
    }
    for (const double amplitude : {0.01, 2.0}) {
      auto body = model;
      double in_phase = 0, out_of_phase = 0;
      const double dt = 2 * M_PI / omega / per_cycle;
      for (int n = 1; n <= n_cycles * per_cycle; ++n) {
        const double p0 = omega * dt * (n - 1), p1 = omega * dt * n;
        const auto F = simple_shear(amplitude * std::sin(p1));
        relax(body, dt, simple_shear(amplitude * std::sin(p0)),
              shear_rate(amplitude * omega * std::cos(p0)), F,
              shear_rate(amplitude * omega * std::cos(p1)));
        // the last cycle; what is left of the start has decayed below e^-30 = 1e-13
        if (n <= (n_cycles - 1) * per_cycle) continue;
        const double shear_stress = kirchhoff(body, F)(0, 1);
        in_phase += 2 * shear_stress * std::sin(p1) / per_cycle / amplitude;
        out_of_phase += 2 * shear_stress * std::cos(p1) / per_cycle / amplitude;
      }
      // Hermite interpolation of a sine: (omega dt)^4/384 = 2.5e-9
      EXPECT_NEAR(in_phase / storage, 1, 1e-8) << omega << " " << amplitude;
      EXPECT_NEAR(out_of_phase / loss, 1, 1e-7) << omega << " " << amplitude;
    }
  }
}

TEST(HomogeneousDeformation, ConfinedRelaxationIsThatOfUniaxialStrain) {
  auto model = material_VE2();
  model.branches[0].tau_G = model.branches[0].tau_C;
  const auto& m = model.material;
  const auto& branch = model.branches[0];
  for (const double f : {0.4, 0.9, 1.5, 3.0}) {
    auto F = algebra::identity<double>();
    F(0, 0) = f;
    for (const double t : {0.0, 1e-3, 5e-3}) {
      auto body = model;
      relax(body, t, F, {}, F, {});
      const double expected =
          2 * (m.xi + 2 * m.zeta) * (f - 1 / f) + m.lambda_hat * (f - 1) +
          std::exp(-t / branch.tau_C) * (2 * branch.xi + 4 * branch.zeta) * (f - 1 / f);
      EXPECT_NEAR(body.piola(F)(0, 0) / expected, 1, 1e-12) << f << " " << t;
    }
  }
}

TEST(HomogeneousDeformation, UniaxialStrainStressesOfTheExactImpactAndPull) {
  // relaxed material, nu = 0.3: stretches of the shock and rarefaction of a 10 m/s impact and pull
  const Body<physics::MooneyRivlin> body = {material_VE2().material, {}, {}};
  const auto stress = [&](double f) {
    auto F = algebra::identity<double>();
    F(0, 0) = f;
    return body.piola(F)(0, 0);
  };
  EXPECT_NEAR(stress(0.93173301) / -1.611320e6, 1, 1e-6);  // seven digits are tabulated
  EXPECT_NEAR(stress(1.07033015) / 1.564154e6, 1, 1e-6);
}

TEST(HomogeneousDeformation, InPlaneStrainAreaBranchesEvolveOutOfPlane) {
  // A_33 stays 1, S_33 does not: (G^-1)_33 = J^-2
  auto body = material_VE2();
  auto F = simple_shear(0.3);
  F(0, 0) = 1.4;
  const auto X = deformation_of(F);
  relax(body, 1e-3, F, {}, F, {});
  EXPECT_DOUBLE_EQ(body.states[0].A(2, 2), 1);
  const double rest = 1 / (X.J * X.J);
  EXPECT_NEAR(body.states[0].S(2, 2), rest + (1 - rest) * std::exp(-1), 1e-14);
}

}  // namespace
}  // namespace diptych::tests
