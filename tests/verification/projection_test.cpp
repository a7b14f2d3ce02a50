/// What the angular-momentum projection must leave alone: F stays the gradient of the motion that
/// made it, and the energy that it moves is in the budget.

#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using algebra::Mat3;
using tests::Scene;
using tests::text_of;

class Projection : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  /// The spinning, stretching cube after n equal steps to 1 ms.
  std::unique_ptr<Scene> after(int n) const {
    parallel::set_threads(1);
    const auto& [method, integrator] = GetParam();
    auto scene = std::make_unique<Scene>(
        method, cases::case_from_text(tests::spinning_cube, "scene",
                                      {tests::any_step, text_of("time.integrator", integrator),
                                       "scheme.angular_momentum_projection=true"}));
    start_ = scene->solver->balance();
    tests::make_steps(*scene->solver, 1e-3, n);
    return scene;
  }
  double residual(int n) const {
    const auto scene = after(n);
    const scheme::Balance now = scene->solver->balance();
    const scheme::Audit& audit = scene->solver->audit();
    return std::abs(now.kinetic + now.strain - start_.kinetic - start_.strain - audit.gain()) /
           start_.kinetic;
  }
  mutable scheme::Balance start_;
};
INSTANTIATE_TEST_SUITE_P(All,
                         Projection,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values("leapfrog", "ssp-rk2", "ssp-rk3")));

// (18b) is linear: with velocities and rates of the same instants F_a is the gradient of x at a.
TEST_P(Projection, KeepsFTheGradientOfTheMotion) {
  const auto scene = after(32);
  const auto& graph = scene->graph;
  const scheme::Snapshot s = scene->solver->snapshot();
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    Mat3 F = Mat3::Identity();
    for (std::int64_t c = graph.row[a]; c < graph.row[a + 1]; ++c) {
      F += 0.5 / graph.Omega[a] * (s.u[graph.neighbour[c]] - s.u[a]) * graph.C[c].transpose();
    }
    ASSERT_LE((F - s.F[a]).norm(), 1e-13);
  }
}

TEST_P(Projection, IsCounted) {
  const auto scene = after(16);
  EXPECT_EQ(scene->solver->interventions().projections, 16);
  const bool is_leapfrog = std::get<1>(GetParam()) == std::string("leapfrog");
  EXPECT_EQ(scene->solver->interventions().resynchronisations, is_leapfrog ? 0 : 16);
  EXPECT_EQ(scene->solver->interventions().limited_pairs, 0);
}

TEST_P(Projection, IsInTheEnergyBudget) {
  const std::string integrator = std::get<1>(GetParam());
  const int n = integrator == "ssp-rk2" ? 64 : 32;  // of SPH it has its order from here on
  const double coarse = residual(n), fine = residual(2 * n);
  if (integrator == "leapfrog") {  // D_ab lags by half a step there: no order to see
    EXPECT_LE(fine, 5e-6);
    return;
  }
  EXPECT_GE(std::log2(coarse / fine), integrator == "ssp-rk2" ? 1.9 : 2.7) << coarse << ' ' << fine;
}

// The tumbling block: D_ab takes several times the energy of the body from its spin, and the
// projection gives it back; without that in the budget the residual is 2.5 (SPH), 0.35 (FVM).
TEST_P(Projection, LeavesTheBudgetOfALongFlightClosed) {
  if (DIPTYCH_GMSH_FOUND == 0) GTEST_SKIP() << "the block is meshed by gmsh, which is not here";
  const auto& [method, integrator] = GetParam();
  const Scene scene = tests::scene_of_case(
      method, "l-block", {text_of("time.integrator", integrator), "parameters.h=1.5"});
  for (int k = 0; k < 10000; ++k)
    scene.solver->step(1e9);
  const scheme::Balance now = scene.solver->balance();
  const scheme::Audit& audit = scene.solver->audit();
  EXPECT_LE(std::abs(now.kinetic + now.strain - audit.gain()),
            1e-2 * (now.kinetic + now.strain));  // 0.6 % (leapfrog, SPH) and less
}

// A cantilever with a moving clamp, loaded off its axis: D_ab takes moments that no support feels.
const std::string clamped = R"toml(
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [3, 1, 1]
cells = [6, 2, 2]
)toml" + tests::viscoelastic("0.3") +
                            R"toml([initial]
velocity = ["0", "20*x*(1 + z)", "-10*x*x*y"]
[[boundary]]
group = "x_min"
type = "velocity"
value = ["3*sin(40*t)", "0", "2*cos(30*t)*y"]
[[boundary]]
group = "x_max"
type = "traction"
value = ["0", "1e5*cos(100*t)", "-2e5*y"]
[[boundary]]
group = "y_min"
type = "symmetry"
[time]
end = 0.05
)toml";

/// What loads and supports do not account for, over the largest that the nodes began with.
algebra::Vec3 missing_moment(const Scene& scene, const scheme::Balance& start) {
  return (scene.solver->balance().angular_momentum - start.angular_momentum -
          scene.solver->audit().impulse.angular) /
         start.angular_scale;
}

class SupportedProjection : public Projection {
 protected:
  /// After n steps to 50 ms: what is missing of the angular momentum, and the energy residual.
  std::pair<double, double> missing(int n, bool projection) const {
    parallel::set_threads(1);
    const auto& [method, integrator] = GetParam();
    Scene scene = tests::scene_of(
        method, clamped,
        {tests::any_step, text_of("time.integrator", integrator),
         std::string("scheme.angular_momentum_projection=") + (projection ? "true" : "false")});
    const scheme::Balance start = scene.solver->balance();
    tests::make_steps(*scene.solver, 0.05, n);
    const scheme::Balance now = scene.solver->balance();
    const scheme::Audit& audit = scene.solver->audit();
    EXPECT_LE((now.linear_momentum - start.linear_momentum - audit.impulse.linear).norm(),
              1e-12 * start.momentum_scale);
    return {missing_moment(scene, start).norm(),
            std::abs(now.kinetic + now.strain - start.kinetic - start.strain - audit.gain()) /
                start.kinetic};
  }
};
INSTANTIATE_TEST_SUITE_P(All,
                         SupportedProjection,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values("leapfrog", "ssp-rk2", "ssp-rk3")));

TEST_P(SupportedProjection, KeepsTheMomentsOfSupportsAndLoadsAndClosesTheBudget) {
  const std::string integrator = std::get<1>(GetParam());
  const auto without = missing(400, false), coarse = missing(400, true), fine = missing(800, true);
  EXPECT_GT(without.first, 1e-5) << "D_ab took no moment: the test tests nothing";
  EXPECT_LE(coarse.first, 1e-12);
  EXPECT_LE(fine.first, 1e-12);
  if (integrator != "ssp-rk3") {  // not yet of their order at these steps
    EXPECT_LE(fine.second, 1.5 * missing(800, false).second + 1e-5);
    return;
  }
  EXPECT_GE(std::log2(coarse.second / fine.second), 2.7) << coarse.second << ' ' << fine.second;
}

// An arm that a hub turns by ten radians: its reactions act where nodes were when a stage began.
const std::string arm = R"toml(
[parameters]
w = 40
[mesh]
element = "quadrilateral"
lower = [0.2, -0.1]
upper = [1.2, 0.1]
cells = [10, 2]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e7
poissons_ratio = 0.3
[initial]
velocity = ["-w*y", "w*x"]
[[boundary]]
group = "x_min"
type = "velocity"
value = ["w*(-x*sin(w*t) - y*cos(w*t))", "w*(x*cos(w*t) - y*sin(w*t))"]
[time]
end = 0.25
)toml";

struct Turned {
  double drift, strain;
};

Turned turned(const char* method, const char* integrator, int n, bool projection) {
  parallel::set_threads(1);
  Scene scene = tests::scene_of(
      method, arm,
      {tests::any_step, text_of("time.integrator", integrator),
       std::string("scheme.angular_momentum_projection=") + (projection ? "true" : "false")});
  const scheme::Balance start = scene.solver->balance();
  tests::make_steps(*scene.solver, 0.25, n);
  return {missing_moment(scene, start).z(), scene.solver->balance().strain};
}

// The moments of first order in dt that were booked here drove the arm by 0.01 of its momentum.
TEST(MovingSupport, HasTheMomentsOfItsReactionsWithEveryIntegrator) {
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    const Turned reference = turned(method, "leapfrog", 1600, false);
    for (const auto& [integrator, n] :
         {std::pair{"ssp-rk2", 2000}, {"ssp-rk3", 800}, {"ssp-rk43", 800}}) {
      SCOPED_TRACE(integrator);
      EXPECT_NEAR(turned(method, integrator, n, false).drift, reference.drift, 2e-4);
      EXPECT_NEAR(turned(method, integrator, n, true).strain, reference.strain,
                  0.02 * reference.strain);
    }
  }
}

// A block that slides along a wall, pressed on it by its weight.
const std::string sliding = R"toml(
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1, 0.5]
cells = [8, 4]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e7
poissons_ratio = 0.3
[initial]
velocity = [50, 0]
[load]
body_force = [0, -2e5]
[[boundary]]
group = "y_min"
type = "rigid-wall"
point = [0, 0]
normal = [0, 1]
[time]
end = 0.02
)toml";

TEST(MovingSupport, HasTheMomentsOfAWallAlongWhichABodySlides) {
  for (const char* method : {"sph", "fvm"}) {
    const auto drift = [&](const char* integrator, int n) {
      parallel::set_threads(1);
      Scene scene = tests::scene_of(method, sliding,
                                    {tests::any_step, text_of("time.integrator", integrator)});
      const scheme::Balance start = scene.solver->balance();
      tests::make_steps(*scene.solver, 0.02, n);
      return missing_moment(scene, start).z();
    };
    const double reference = drift("leapfrog", 400);
    for (const char* integrator : {"ssp-rk3", "ssp-rk43"}) {
      EXPECT_NEAR(drift(integrator, 100), reference, 2e-4) << method << ' ' << integrator;
    }
  }
}

}  // namespace
}  // namespace diptych
