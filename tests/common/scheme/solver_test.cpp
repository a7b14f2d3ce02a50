/// Whole steps: determinism, conservation, energy budget, order of the integrators, breakdown.

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using algebra::Vec3;
using tests::elastic;
using tests::run_to;
using tests::Scene;
using tests::scene_of;
using tests::spinning_cube;

class Solver : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, Solver, testing::Values("sph", "fvm"));

double relative_residual(const scheme::Balance& start, const run::Solver& solver) {
  const scheme::Balance now = solver.balance();
  const scheme::Audit& audit = solver.audit();
  const double before = start.kinetic + start.strain;
  return (now.kinetic + now.strain - before - audit.external_work + audit.numerical_dissipation +
          audit.viscous_dissipation) /
         before;
}

/// Relative energy residual at the end with a fixed number of equal steps.
double residual_with_steps(const std::string& method,
                           const std::string& text,
                           const std::string& integrator,
                           int n_steps) {
  Scene scene = scene_of(method, text, {"time.integrator=\"" + integrator + "\""});
  const scheme::Balance start = scene.solver->balance();
  const double end = 1e-3;
  for (int k = 1; k <= n_steps; ++k)
    scene.solver->step(end * k / n_steps);
  EXPECT_DOUBLE_EQ(scene.solver->time(), end);
  return std::abs(relative_residual(start, *scene.solver));
}

TEST_P(Solver, StateIsBitIdenticalForOneTwoAndThreeThreads) {
  for (const char* integrator : {"leapfrog", "ssp-rk2", "ssp-rk3"}) {
    std::vector<std::string> hashes;
    for (const int threads : {1, 2, 3}) {
      parallel::set_threads(threads);
      Scene scene =
          scene_of(GetParam(), spinning_cube,
                   {std::string("time.integrator=\"") + integrator + "\"", "mesh.cells=[9, 9, 9]"});
      for (int k = 0; k < 3; ++k)
        scene.solver->step(1);
      hashes.push_back(scene.solver->state_hash(tests::natural_order(scene.graph)));
    }
    parallel::set_threads(0);
    EXPECT_EQ(hashes[0], hashes[1]) << integrator;
    EXPECT_EQ(hashes[0], hashes[2]) << integrator;
  }
}

TEST_P(Solver, EnergyResidualFallsAtTheOrderOfTheIntegrator) {
  // Leapfrog's dissipation lags by half a step, its residual is first order in dt times the small
  // numerical dissipation, second order without it.
  struct Expectation {
    const char* integrator;
    double order;
  };
  for (const auto& [integrator, order] :
       {Expectation{"ssp-rk2", 1.8}, Expectation{"ssp-rk3", 2.7}, Expectation{"ssp-rk43", 2.7}}) {
    const int n = order < 2 ? 64 : 32;  // SSP-RK2 has its order with SPH from here on
    const double coarse = residual_with_steps(GetParam(), spinning_cube, integrator, n);
    const double fine = residual_with_steps(GetParam(), spinning_cube, integrator, 2 * n);
    EXPECT_GE(std::log2(coarse / fine), order) << integrator << ": " << coarse << ", " << fine;
    EXPECT_LE(fine, 1e-3) << integrator;
  }
  const std::string conservative = elastic(spinning_cube) + "[scheme]\ndissipation = 0\n";
  const double coarse = residual_with_steps(GetParam(), conservative, "leapfrog", 16);
  const double fine = residual_with_steps(GetParam(), conservative, "leapfrog", 32);
  EXPECT_GE(std::log2(coarse / fine), 1.8) << coarse << ", " << fine;
}

TEST_P(Solver, FreeBodyKeepsLinearMomentumAndWithProjectionAngularMomentum) {
  for (const std::string& text : {std::string(spinning_cube), elastic(spinning_cube)}) {
    for (const char* integrator : {"leapfrog", "ssp-rk3"}) {
      Scene scene = scene_of(GetParam(), text,
                             {std::string("time.integrator=\"") + integrator + "\"",
                              "scheme.angular_momentum_projection=true",
                              "initial.velocity=[\"3 - 105*y + 20*x\", \"105*x\", \"z*x*40\"]"});
      const scheme::Balance start = scene.solver->balance();
      for (int k = 0; k < 60; ++k)
        scene.solver->step(1);
      const scheme::Balance end = scene.solver->balance();
      EXPECT_LE((end.linear_momentum - start.linear_momentum).norm(), 1e-13 * start.momentum_scale);
      EXPECT_LE((end.angular_momentum - start.angular_momentum).norm(),
                1e-12 * start.angular_scale);
    }
  }
}

TEST_P(Solver, BothDissipationsArePositiveAndTheRestIsConserved) {
  Scene scene = scene_of(GetParam(), spinning_cube);
  const scheme::Balance start = scene.solver->balance();
  run_to(*scene.solver, scene.setup.time.end);
  EXPECT_GT(scene.solver->audit().viscous_dissipation, 1e-3 * start.kinetic);
  EXPECT_GT(scene.solver->audit().numerical_dissipation, 0);
  EXPECT_LE(std::abs(relative_residual(start, *scene.solver)), 2e-3);
}

TEST_P(Solver, EvolvedCofactorAndJacobianFollowF) {
  Scene scene = scene_of(GetParam(), spinning_cube);
  for (int k = 1; k <= 16; ++k)
    scene.solver->step(1e-3 * k / 16);
  EXPECT_LE(scene.solver->balance().involution_H, 1e-13);
  EXPECT_LE(scene.solver->balance().involution_J, 1e-13);
  Scene leapfrog = scene_of(GetParam(), spinning_cube, {"time.integrator=\"leapfrog\""});
  for (int k = 0; k < 20; ++k)
    leapfrog.solver->step(1);
  EXPECT_LE(leapfrog.solver->balance().involution_H, 1e-13);
  EXPECT_LE(leapfrog.solver->balance().involution_J, 1e-13);
}

TEST_P(Solver, UnknownsFFJAndFHJAgreeToTheOrderOfTheIntegrator) {
  const auto final_F = [&](const char* unknowns) {
    Scene scene =
        scene_of(GetParam(), spinning_cube, {std::string("scheme.unknowns=\"") + unknowns + "\""});
    for (int k = 1; k <= 40; ++k)
      scene.solver->step(1e-3 * k / 40);
    return scene.solver->snapshot().F;
  };
  const auto F = final_F("F"), FJ = final_F("FJ"), FHJ = final_F("FHJ");
  for (size_t a = 0; a < F.size(); ++a) {
    EXPECT_LE((F[a] - FHJ[a]).norm(), 1e-6);
    EXPECT_LE((F[a] - FJ[a]).norm(), 1e-6);
  }
}

TEST_P(Solver, BreakdownNamesNodeStepAndState) {
  Scene scene = scene_of(GetParam(), elastic(spinning_cube),
                         {"initial.velocity=[\"-20000*x\", \"-20000*y\", \"-20000*z\"]"});
  try {
    run_to(*scene.solver, 1e-2);
    FAIL() << "the cube was crushed through itself without a report";
  } catch (const base::BreakdownError& error) {
    EXPECT_EQ(error.code(), base::ExitCode::breakdown);
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("node"), testing::HasSubstr("step"),
                                             testing::HasSubstr("J")));
  }
}

}  // namespace
}  // namespace diptych
