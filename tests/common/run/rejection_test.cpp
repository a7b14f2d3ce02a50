/// A step that fails is made again from its beginning with half its size, and what a run keeps of
/// the state before it is that state to the last bit.

#include "common/io/checkpoint_file.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::HasSubstr;
using tests::Scene;

/// A cube that meets a wall faster than sound (242 m/s): the default step turns the layer at the
/// wall inside out.
std::string impact(const std::string& integrator, int n_branches, int speed) {
  return R"([mesh]
element = "hexahedron"
cells = [6, 6, 6]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.45
)" + (n_branches > 0 ? std::string("[[material.branch]]\nbeta_C = 0.5\ntau_C = 2e-3\n") : "") +
         R"([initial]
velocity = [0, 0, -)" +
         std::to_string(speed) + R"(]
[[boundary]]
group = "z_min"
type = "rigid-wall"
point = [0, 0, -0.01]
normal = [0, 0, 1]
[time]
end = 2e-3
integrator = ")" +
         integrator + "\"\n[scheme]\nvolumes = \"nodes\"\n";  // volumes of cells stand this
}

struct Setting {
  const char* method;
  const char* integrator;
  int n_branches;
  int speed;  ///< m/s
};

std::string text_of(const Setting& setting) {
  return impact(setting.integrator, setting.n_branches, setting.speed);
}

class Rejection : public testing::TestWithParam<Setting> {
 protected:
  Scene scene(const std::vector<std::string>& overrides = {}) const {
    return tests::scene_of(GetParam().method, text_of(GetParam()), overrides);
  }
};

/// Steps until one has been rejected for good. @return the hash before it
std::string hash_before_breakdown(Scene& scene) {
  const auto order = tests::natural_order(scene.graph);
  std::string hash;
  while (scene.solver->time() < scene.setup.time.end) {
    hash = scene.solver->state_hash(order);
    try {
      scene.solver->step(scene.setup.time.end);
    } catch (const base::BreakdownError& error) {
      EXPECT_TRUE(error.node()) << error.what();
      return hash;
    }
  }
  return "";
}

TEST_P(Rejection, GoesOnWhereOneStepWouldHaveEndedTheRun) {
  Scene none = scene({"time.max_retries=0"});
  ASSERT_NE(hash_before_breakdown(none), "") << "no step of this scene fails";
  EXPECT_FALSE(none.solver->is_sound()) << "without retries the body is as it has ended up";
  const double broke_at = none.solver->time();
  Scene some = scene();
  int rejected = 0, steps = 0;
  while (some.solver->time() <= 1.05 * broke_at) {
    const StepReport step = some.solver->step(some.setup.time.end);
    rejected += step.rejected;
    EXPECT_GT(step.least_J, 0);
    ++steps;
  }
  EXPECT_GT(rejected, 0);
  EXPECT_LT(rejected, steps) << "every step would be rejected if the next were as large at once";
}

TEST_P(Rejection, BringsTheStateBackToTheLastBit) {
  Scene whole = scene({"time.max_retries=1", "initial.velocity=[0, 0, -1000]"});
  const std::string before = hash_before_breakdown(whole);
  ASSERT_NE(before, "") << "one retry was enough for this scene";
  EXPECT_EQ(whole.solver->state_hash(tests::natural_order(whole.graph)), before);
  EXPECT_TRUE(whole.solver->is_sound());
}

// An attempt that is thrown away but booked would give the wall its impulse twice.
TEST_P(Rejection, KeepsTheBudgetOfMomentum) {
  Scene some = scene();
  const scheme::Balance initial = some.solver->balance();
  int rejected = 0;
  while (rejected == 0 && some.solver->time() < some.setup.time.end)
    rejected += some.solver->step(some.setup.time.end).rejected;
  ASSERT_GT(rejected, 0);
  const algebra::Vec3 missing = some.solver->balance().linear_momentum - initial.linear_momentum -
                                some.solver->audit().impulse.linear;
  EXPECT_LE(missing.norm(), 1e-13 * initial.momentum_scale) << "some roundings of a few steps";
}

TEST_P(Rejection, IsTheSameForEveryNumberOfThreads) {
  std::vector<std::string> hashes;
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    Scene some = scene();
    int rejected = 0;
    for (int k = 0; k < 10; ++k)
      rejected += some.solver->step(some.setup.time.end).rejected;
    EXPECT_GT(rejected, 0);
    hashes.push_back(some.solver->state_hash(tests::natural_order(some.graph)));
  }
  parallel::set_threads(0);
  EXPECT_THAT(hashes, testing::Each(hashes[0]));
}

INSTANTIATE_TEST_SUITE_P(All,
                         Rejection,
                         testing::Values(Setting{"sph", "ssp-rk3", 1, 300},
                                         Setting{"fvm", "ssp-rk3", 0, 300},
                                         Setting{"sph", "leapfrog", 0, 300},
                                         Setting{"fvm", "leapfrog", 1, 400}),
                         [](const auto& test) {
                           std::string name = std::string(test.param.method) + "_" +
                                              test.param.integrator + "_" +
                                              std::to_string(test.param.n_branches);
                           std::erase(name, '-');
                           return name;
                         });

/// The steps behind a rejected one are kept small, also by who goes on from a checkpoint there.
TEST_P(Rejection, IsRememberedByACheckpoint) {
  const test::Scratch folder;
  Scene whole = scene(), part = scene();
  const double end = whole.setup.time.end;
  int rejected = 0;
  while (rejected == 0 && whole.solver->time() < end)
    rejected += whole.solver->step(end).rejected;
  ASSERT_GT(rejected, 0);
  io::CheckpointWriter writer(folder / "checkpoint.hdf");
  whole.solver->archive(writer);
  writer.publish();
  io::CheckpointReader reader(folder / "checkpoint.hdf");
  part.solver->archive(reader);
  for (int k = 0; k < 5; ++k) {
    const StepReport wanted = whole.solver->step(end), found = part.solver->step(end);
    EXPECT_EQ(found.dt, wanted.dt) << k;
    EXPECT_EQ(found.rejected, wanted.rejected) << k;
  }
  const auto order = tests::natural_order(whole.graph);
  EXPECT_EQ(part.solver->state_hash(order), whole.solver->state_hash(order));
}

TEST(Rejection, LetsStepsGrowBack) {
  Scene some = tests::scene_of("fvm", impact("ssp-rk3", 0, 300));
  int rejected = 0;
  double least = 1;
  StepReport step;
  while (some.solver->time() < some.setup.time.end) {
    step = some.solver->step(some.setup.time.end);
    rejected += step.rejected;
    least = std::min(least, step.dt);
  }
  EXPECT_GT(rejected, 0);
  EXPECT_GT(step.dt, 1.5 * least);
}

/// Leapfrog goes back over steps that it makes again: nothing of what they add up is lost.
TEST(Rejection, OfLeapfrogGoesBackOverManySteps) {
  // spins and stretches on its way to a wall far away
  Scene crushed =
      tests::scene_of("fvm", impact("leapfrog", 1, 0),
                      {"initial.velocity=[\"-40*y\", \"40*x + 10*y\", -1000]",
                       "boundary.0.point=[0, 0, -18]", "time.max_retries=1", "time.end=0.1"});
  const auto order = tests::natural_order(crushed.graph);
  std::string hash;
  scheme::Audit audit;
  std::int64_t steps = 0;
  bool broke = false;
  while (!broke && crushed.solver->time() < crushed.setup.time.end) {
    hash = crushed.solver->state_hash(order);
    audit = crushed.solver->audit();
    try {
      steps = crushed.solver->step(crushed.setup.time.end).step;
    } catch (const base::BreakdownError&) {
      broke = true;
    }
  }
  ASSERT_TRUE(broke);
  EXPECT_GT(steps, 20) << "no step lies between the copy and the failure";
  EXPECT_EQ(crushed.solver->state_hash(order), hash);
  EXPECT_EQ(crushed.solver->audit().external_work, audit.external_work);
  EXPECT_EQ(crushed.solver->audit().numerical_dissipation, audit.numerical_dissipation);
  EXPECT_EQ(crushed.solver->audit().impulse.linear, audit.impulse.linear);
}

/// Whatever the scheme keeps for the budget of the next step is put back too.
TEST(Rejection, MakesTheSameStepWithTheSameBudgetAgain) {
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {},
           {"scheme.face_correction=0.125"},
           {"scheme.face_correction=0.125", "time.integrator=ssp-rk3"},
           {"scheme.reconstruction=symmetric"},
           {"scheme.reconstruction=objective"},
           {"scheme.impedance=exact"},
           {"scheme.unknowns=F"},
           {"scheme.volumes=cells"},
           {"time.integrator=ssp-rk43", "scheme.limiter=sign-preserving"}}) {
    for (const char* method : {"sph", "fvm"}) {
      // stretched along the wall, in flight
      std::vector<std::string> overrides{"initial.velocity=[\"-40*y\", \"40*x + 10*y^2\", -100]",
                                         "boundary.0.point=[0, 0, -18]"};
      overrides.insert(overrides.end(), options.begin(), options.end());
      Scene scene = tests::scene_of(method, impact("leapfrog", 1, 0), overrides);
      const auto order = tests::natural_order(scene.graph);
      for (int k = 0; k < 7; ++k)
        scene.solver->step(1);
      const scheme::Audit once = scene.solver->audit();
      const std::string hash = scene.solver->state_hash(order);
      ASSERT_TRUE(scene.solver->take_back());
      scene.solver->step(1);
      const std::string what = std::string(method) + " " + testing::PrintToString(options);
      EXPECT_EQ(scene.solver->state_hash(order), hash) << what;
      EXPECT_EQ(scene.solver->audit().numerical_dissipation, once.numerical_dissipation) << what;
      EXPECT_EQ(scene.solver->audit().viscous_dissipation, once.viscous_dissipation) << what;
      EXPECT_EQ(scene.solver->audit().external_work, once.external_work) << what;
    }
  }
}

/// Keeps what it is told of the last good state.
class Keeper : public Observer {
 public:
  void at_breakdown(const Output& output) override {
    time = output.state.time();
    least_J = output.balance.least_J;
  }
  double time = -1, least_J = 0;
};

TEST(LastGoodState, IsToldAfterABreakdown) {
  tests::Scene scene = tests::scene_of("fvm", impact("ssp-rk3", 1, 1000), {"time.max_retries=1"});
  Keeper keeper;
  Simulation simulation(scene.setup, *scene.solver, {&keeper});
  ASSERT_EQ(simulation.run(), Ending::breakdown);
  EXPECT_THAT(simulation.breakdown()->what(), HasSubstr("after 1 retry with half the step"));
  EXPECT_EQ(keeper.time, scene.solver->time());
  EXPECT_GT(keeper.least_J, 0);
  EXPECT_EQ(simulation.take_state().time, keeper.time);
}

}  // namespace
}  // namespace diptych::run
