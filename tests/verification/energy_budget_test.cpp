/// The energy budget over time: what is left of K + W - work + dissipations is the error of the
/// integrator alone, whatever the boundary does, and falls at its order.

#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace diptych {
namespace {

using tests::Scene;
using tests::text_of;

const std::string block = R"toml(
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [4, 3, 3]
)toml" + tests::viscoelastic("0.3") +
                          R"toml([initial]
velocity = ["10*x*y", "-8*y*x", "6*z*x*(1 - z)"]
[time]
end = 1
)toml";

const std::string body_force = R"toml(
[load]
body_force = ["1e6*cos(300*t)", "2e6*y", "0"]
)toml";
const std::string moving = R"toml(
[[boundary]]
group = "x_min"
type = "velocity"
value = ["12*z*(1 - z)*sin(400*t)", "0", "2*t*400*y*(1 - z)"]
)toml";
const std::string traction = R"toml(
[[boundary]]
group = "x_max"
type = "traction"
value = ["2e5*sin(500*t)", "-3e5*y", "1e5"]
)toml";
const std::string rolling = R"toml(
[[boundary]]
group = "y_min"
type = "symmetry"
)toml";
const std::string pressure = R"toml(
[[boundary]]
group = "y_max"
type = "pressure"
value = "3e5*(1 + x)*cos(200*t)"
)toml";
const std::string skew = R"toml(
[[boundary]]
group = "z_min"
type = "skew-symmetry"
)toml";
const std::string fixed = R"toml(
[[boundary]]
group = "z_max"
type = "fixed"
)toml";

class EnergyBudget : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  /// Largest at eight instants of n equal steps, relative to the energy at the start: at a single
  /// one, errors of second and third order may cancel.
  double residual(int n, const std::string& text, const std::string& integrator, int factor) const {
    parallel::set_threads(1);
    const auto& [method, correction] = GetParam();
    Scene scene = tests::scene_of(method, text,
                                  {tests::any_step, text_of("time.integrator", integrator),
                                   "scheme.dissipation=" + std::to_string(factor),
                                   std::string("scheme.face_correction=") + correction});
    const scheme::Balance start = scene.solver->balance();
    double largest = 0;
    for (int k = 1; k <= n; ++k) {
      scene.solver->step(4e-3 * k / n);
      if (k % (n / 8) != 0) continue;
      const scheme::Balance now = scene.solver->balance();
      largest = std::max(largest, std::abs(now.kinetic + now.strain - start.kinetic - start.strain -
                                           scene.solver->audit().gain()));
    }
    return largest / start.kinetic;
  }
  void expect_order(const std::string& text,
                    const std::string& integrator,
                    int factor,
                    double order) const {
    const double coarse = residual(80, text, integrator, factor);
    const double fine = residual(160, text, integrator, factor);
    EXPECT_GE(std::log2(coarse / fine), order)
        << integrator << ": " << coarse << ' ' << fine << text;
    EXPECT_LE(fine, 1e-2) << integrator;
  }
};
INSTANTIATE_TEST_SUITE_P(All,
                         EnergyBudget,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values("0", "\"1/6\"")));

TEST_P(EnergyBudget, ClosesAtTheOrderOfTheIntegratorUnderAllConditionsAtOnce) {
  // loads act on held nodes as well, and edges are shared
  const std::string all =
      block + body_force + moving + traction + rolling + pressure + skew + fixed;
  expect_order(all, "ssp-rk2", 1, 1.9);
  expect_order(all, "ssp-rk3", 1, 2.9);
  expect_order(all, "ssp-rk43", 1, 2.9);
  expect_order(all, "leapfrog", 0, 1.95);  // without D_ab, which lags by half a step
}

// A wave 40 spacings long, 30 periods at the default step: SSP-RK3 takes 6e-3 of its energy.
TEST(DefaultIntegrator, KeepsTheEnergyOfAStandingWave) {
  parallel::set_threads(1);
  const std::string wave = R"toml([mesh]
element = "quadrilateral"
upper = [2, 0.05]
cells = [80, 2]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[boundary]]
group = ["x_min", "x_max", "y_min", "y_max"]
type = "symmetry"
[initial]
velocity = ["0.01*sin(2*pi*x)", 0]
[time]
end = "30/sqrt(1e3*0.7/1.3/0.4)"
)toml";
  for (const char* method : {"sph", "fvm"}) {
    Scene scene = tests::scene_of(method, wave);
    const scheme::Balance start = scene.solver->balance();
    tests::run_to(*scene.solver, scene.setup.time.end);
    const scheme::Balance now = scene.solver->balance();
    const double lost = start.kinetic + start.strain - now.kinetic - now.strain;
    EXPECT_NEAR(lost, scene.solver->audit().numerical_dissipation, 1e-5 * start.kinetic) << method;
    EXPECT_LE(lost, 2e-3 * start.kinetic) << method;
  }
}

// With H and J as unknowns of their own; dt/tau from 1e-8 to 1e8 on the shear wave.
TEST(StiffEnergyBudget, ClosesForEveryTau) {
  constexpr double end = 0.0163;
  for (const char* integrator : {"ssp-rk3", "ssp-rk2"}) {
    double largest[2] = {0, 0};
    for (const double z : {1e-8, 1e-2, 1.0, 10.0, 1e2, 1e3, 1e5, 1e8}) {
      for (const int k : {0, 1}) {
        const int n = 40 << k;
        const std::string tau = fmt::format("{:.17g}", end / 40 / z);
        Scene scene = tests::scene_of_case("fvm", "shear-wave-plane-ve2",
                                           {tests::any_step, text_of("time.integrator", integrator),
                                            "parameters.tau_C=" + tau, "parameters.tau_G=" + tau});
        const scheme::Balance start = scene.solver->balance();
        tests::make_steps(*scene.solver, end, n);
        const scheme::Balance now = scene.solver->balance();
        const scheme::Audit& audit = scene.solver->audit();
        largest[k] =
            std::max(largest[k], std::abs(now.kinetic + now.strain - start.kinetic - start.strain -
                                          audit.external_work + audit.numerical_dissipation +
                                          audit.viscous_dissipation) /
                                     start.strain);
      }
    }
    EXPECT_GE(std::log2(largest[0] / largest[1]), 1.9) << integrator;
    EXPECT_LE(largest[1], 1e-3) << integrator;
  }
}

// Branches that are virgin in a strained body give all of their energy within a step where tau is
// small, and follow it closely from then on: a power at an instant times dt was off by dt/tau.
TEST(StiffEnergyBudget, HoldsTheReleaseOfStrainedVirginBranches) {
  constexpr double end = 1e-3;
  for (const char* integrator : {"leapfrog", "ssp-rk2", "ssp-rk3"}) {
    for (const double z : {1e-8, 1e-4, 1e-1, 1.0, 1e1, 1e2, 1e4, 1e8}) {
      const std::string tau = fmt::format("{:.17g}", end / 40 / z);
      Scene scene = tests::scene_of(
          "fvm", tests::spinning_cube,
          {tests::any_step, text_of("time.integrator", integrator), "mesh.cells=[3, 3, 3]",
           "material.branch.0.tau_C=" + tau, "material.branch.0.tau_G=" + tau,
           "initial.displacement=[\"0.4*x\",\"0.2*y*x\",\"-0.1*z\"]"});
      const scheme::Balance start = scene.solver->balance();
      double before = 0;
      for (int k = 1; k <= 40; ++k) {
        scene.solver->step(end * k / 40);
        const double now = scene.solver->audit().viscous_dissipation;
        EXPECT_GE(now, before - 1e-15 * start.strain) << integrator << ' ' << z << ' ' << k;
        before = now;
      }
      const scheme::Balance now = scene.solver->balance();
      const double residual =
          now.kinetic + now.strain - start.kinetic - start.strain - scene.solver->audit().gain();
      EXPECT_LE(std::abs(residual), 1e-3 * start.strain) << integrator << ' ' << z;
    }
  }
}

}  // namespace
}  // namespace diptych
