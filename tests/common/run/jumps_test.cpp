/// Steps end where loads jump in time: each step sees its loads on one side of a jump.

#include "common/io/checkpoint_file.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::Contains;

/// A free block of 1 m^3 that is pulled at one side.
std::string pulled(const std::string& integrator, const std::string& load) {
  return fmt::format(R"toml([mesh]
cells = [3, 3, 3]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[boundary]]
group = "z_max"
type = "traction"
value = [0, 0, "{}"]
[time]
end = 0.1
integrator = "{}"
[output]
frames = 5
)toml",
                     load, integrator);
}

struct Times : Observer {
  void after_step(const StepReport& step) override { at.push_back(step.time); }
  std::vector<double> at;
};

struct Ran {
  Ran(const std::string& integrator, const std::string& load)
      : scene(tests::scene_of("fvm", pulled(integrator, load))) {
    Simulation simulation(scene.setup, *scene.solver, {&times});
    EXPECT_EQ(simulation.run(), Ending::done);
  }
  double momentum() const { return scene.solver->balance().linear_momentum[2]; }
  tests::Scene scene;
  Times times;
};

class Jumps : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Jumps, testing::Values("leapfrog", "ssp-rk2", "ssp-rk3"));

TEST_P(Jumps, APulseShorterThanAStepGivesItsImpulse) {
  const Ran ran(GetParam(), "(t > 0.0501 && t < 0.0503) ? 1e3 : 0");
  EXPECT_NEAR(ran.momentum(), 1e3 * 2e-4, 1e-12);
  EXPECT_THAT(ran.times.at, Contains(0.0501));
  EXPECT_THAT(ran.times.at, Contains(std::nextafter(0.0503, 0)));
}

TEST_P(Jumps, ALoadThatStopsHasActedUntilThen) {
  for (const double end : {0.04, 0.0412345}) {  // at an output and between
    const Ran ran(GetParam(), fmt::format("t < {} ? 1e3 : 0", end));
    EXPECT_NEAR(ran.momentum(), 1e3 * end, 1e-10);
  }
  const Ran late(GetParam(), "t <= 0.04 ? 1e3 : 0");
  EXPECT_NEAR(late.momentum(), 40, 1e-10);
}

TEST_P(Jumps, OfOneLoadMayBeAsNearAsRounding) {
  const Ran ran(GetParam(),
                "(t < 0.02 ? 1e3 : 0) + (t <= 0.02 ? 1e3 : 0) + (3*t < 0.06 ? 1e3 : 0)");
  EXPECT_NEAR(ran.momentum(), 60, 1e-10);
}

TEST_P(Jumps, MayStandBesideAnOutputOrTheEnd) {
  for (const char* end : {"0.0399999999", "0.09999999999", "0.0400000001"}) {
    const Ran ran(GetParam(), fmt::format("t < {} ? 1e3 : 0", end));
    EXPECT_NEAR(ran.momentum(), 1e3 * std::stod(end), 1e-10) << end;
  }
}

/// A strong load on a body that hardly moves does not make its steps vanish.
TEST_P(Jumps, AskForFewStepsOfABodyThatHardlyMoves) {
  const auto steps = [&](const std::string& more) {
    tests::Scene scene = tests::scene_of(
        "fvm",
        pulled(GetParam(), "t < 0.03 ? 0 : 2e4") + "[initial]\nvelocity = [\"1e-6*x\", 0, 0]\n",
        {more});
    Simulation simulation(scene.setup, *scene.solver, {});
    EXPECT_EQ(simulation.run(), Ending::done);
    return static_cast<double>(simulation.totals().steps);
  };
  EXPECT_LT(steps("time.max_retries=5"), 2.5 * steps("time.max_retries=0"));
}

/// The run that goes on from before, at or behind a jump has the bits of the one that never ended.
TEST_P(Jumps, RunsGoOnFromBesideThem) {
  const std::string load = "t < 0.04 ? 1e4*sin(100*t) : 0";
  const auto hash_of = [](const tests::Scene& scene) {
    return scene.solver->state_hash(tests::natural_order(scene.graph));
  };
  Ran whole(GetParam(), load);
  const auto before = std::find(whole.times.at.begin(), whole.times.at.end(), 0.04);
  const auto at =
      before == whole.times.at.end()
          ? std::find(whole.times.at.begin(), whole.times.at.end(), std::nextafter(0.04, 0)) -
                whole.times.at.begin()
          : before - whole.times.at.begin();
  ASSERT_LT(at, std::ssize(whole.times.at));
  for (const std::int64_t steps : {at, at + 1, at + 2, at + 6}) {
    const test::Scratch folder;
    const std::string path = folder.path() + "/checkpoint.hdf";
    {
      tests::Scene scene = tests::scene_of("fvm", pulled(GetParam(), load),
                                           {fmt::format("time.max_steps={}", steps)});
      Simulation simulation(scene.setup, *scene.solver, {});
      simulation.run();
      io::CheckpointWriter writer(path);
      simulation.archive(writer);
      writer.publish();
    }
    tests::Scene scene = tests::scene_of("fvm", pulled(GetParam(), load));
    Simulation simulation(scene.setup, *scene.solver, {});
    io::CheckpointReader reader(path);
    simulation.archive(reader);
    reader.finish();
    EXPECT_EQ(simulation.run(), Ending::done);
    EXPECT_EQ(hash_of(scene), hash_of(whole.scene)) << "after " << steps << " steps";
  }
}

TEST_P(Jumps, SmoothLoadsHaveNone) {
  const Ran one(GetParam(), "1e3*cos(10*t)"), other(GetParam(), "t < 5 ? 1e3*cos(10*t) : 0");
  EXPECT_EQ(one.times.at, other.times.at);
}

}  // namespace
}  // namespace diptych::run
