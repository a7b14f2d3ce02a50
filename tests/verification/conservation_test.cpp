/// Momenta of free bodies (benchmarks C4) over ten thousand steps: linear momentum to 1e-13 of
/// sum |p|, angular momentum with the projection to 1e-12 of sum |x||p|, against the impulse of the
/// loads while they act and after. The scales are sums over nodes of what is summed: rounding of a
/// sum is relative to them.

#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using algebra::Vec3;
using tests::Scene;
using tests::scene_of_case;
using tests::text_of;

struct Drift {
  double linear = 0, angular = 0;  ///< largest over the run
};

Drift drift_over(run::Solver& solver, int n_steps, double limit) {
  const scheme::Balance start = solver.balance();
  Drift largest;
  double p_scale = start.momentum_scale, L_scale = start.angular_scale;
  for (int k = 1; k <= n_steps; ++k) {
    solver.step(limit);
    if (k % 100 != 0) continue;
    const scheme::Balance now = solver.balance();
    const scheme::Impulse& given = solver.audit().impulse;
    p_scale = std::max(p_scale, now.momentum_scale);
    L_scale = std::max(L_scale, now.angular_scale);
    const Vec3 p = now.linear_momentum - start.linear_momentum - given.linear;
    const Vec3 L = now.angular_momentum - start.angular_momentum - given.angular;
    largest.linear = std::max(largest.linear, p.norm() / p_scale);
    largest.angular = std::max(largest.angular, L.norm() / L_scale);
  }
  return largest;
}

class Conservation : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string method() const { return std::get<0>(GetParam()); }
  std::string integrator() const { return text_of("time.integrator", std::get<1>(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(
    All,
    Conservation,
    testing::Combine(testing::Values("sph", "fvm"),
                     testing::Values("leapfrog", "ssp-rk2", "ssp-rk3", "ssp-rk43")));

TEST_P(Conservation, LBlockKeepsMomentaThroughLoadsAndFlight) {
  if (DIPTYCH_GMSH_FOUND == 0) GTEST_SKIP() << "the block is meshed by gmsh, which is not here";
  for (const char* name : {"l-block", "l-block-ve2"}) {
    // 90 nodes; the loads act from 0 to 5 s, 10^4 steps reach 300 s and more
    Scene scene = scene_of_case(method(), name, {integrator(), "parameters.h=1.5"});
    const Drift drift = drift_over(*scene.solver, 10000, 1e9);
    EXPECT_GT(scene.solver->time(), 100) << name;
    EXPECT_GT(scene.solver->balance().angular_momentum.norm(), 1e5) << "the loads did not act";
    EXPECT_LE(drift.linear, 1e-13) << name;
    EXPECT_LE(drift.angular, 1e-12) << name;
  }
}

TEST_P(Conservation, SpinningBodiesKeepMomenta) {
  struct Body {
    const char *name, *cells, *velocity, *correction;
  };
  const char* const tumbling = "[\"7-omega*y\",\"omega*x-3\",\"20*x\"]";
  for (const Body& body :
       {Body{"spinning-cube", "[3, 3, 3]", tumbling, "\"1/6\""},
        Body{"spinning-cube-ve2", "[3, 3, 3]", tumbling, "0"},
        Body{"spinning-square", "[4, 4]", "[\"7-omega*y\",\"omega*x-3\"]", "\"1/6\""}}) {
    Scene scene = scene_of_case(method(), body.name,
                                {integrator(), std::string("mesh.cells=") + body.cells,
                                 std::string("initial.velocity=") + body.velocity,
                                 std::string("scheme.face_correction=") + body.correction});
    const Drift drift = drift_over(*scene.solver, 10000, 1e9);
    EXPECT_LE(drift.linear, 1e-13) << body.name;
    EXPECT_LE(drift.angular, 1e-12) << body.name;
  }
}

// Without projection and D_ab only the integrator breaks the balance of angular momentum, and
// leapfrog does not: its x and v are those of one instant.
TEST_P(Conservation, AngularMomentumFollowsTheImpulseAtTheOrderOfTheIntegrator) {
  if (DIPTYCH_GMSH_FOUND == 0) GTEST_SKIP() << "the block is meshed by gmsh, which is not here";
  const std::string name = std::get<1>(GetParam());
  const auto missing = [&](int n) {
    Scene scene =
        scene_of_case(method(), "l-block-ve2",
                      {integrator(), tests::any_step, "parameters.h=1.5", "scheme.dissipation=0",
                       "scheme.angular_momentum_projection=false"});
    tests::make_steps(*scene.solver, 2, n);  // within the first ramp of the loads
    const auto now = scene.solver->balance();
    return (now.angular_momentum - scene.solver->audit().impulse.angular).norm() /
           now.angular_scale;
  };
  const double coarse = missing(60), fine = missing(120);
  if (name == "leapfrog") {
    EXPECT_LE(coarse, 1e-13);
    return;
  }
  EXPECT_GT(coarse, 1e-11) << "nothing to converge: the test tests nothing";
  EXPECT_GE(std::log2(coarse / fine), name == "ssp-rk2" ? 1.9 : 2.8) << coarse << ' ' << fine;
}

// In the plane there is no momentum but p_x, p_y, L_z.
TEST(ConservationInThePlane, NothingLeavesThePlane) {
  Scene scene = scene_of_case("fvm", "spinning-square", {"mesh.cells=[4, 4]"});
  for (int k = 0; k < 50; ++k)
    scene.solver->step(1);
  const auto now = scene.solver->balance();
  EXPECT_EQ(now.linear_momentum[2], 0);
  EXPECT_EQ(now.angular_momentum[0], 0);
  EXPECT_EQ(now.angular_momentum[1], 0);
}

}  // namespace
}  // namespace diptych
