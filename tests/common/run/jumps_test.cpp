/// Steps end where loads jump in time: each step sees its loads on one side of a jump.

#include "common/io/checkpoint_file.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tuple>

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

TEST_P(Jumps, SmoothPulsesShorterThanAStepGiveTheirs) {
  for (const auto& [load, impulse] : std::initializer_list<std::pair<const char*, double>>{
           {"t < 1e-3 ? 1e3*sin(pi*t/1e-3)^2 : 0", 0.5},
           {"(t > 0.0502 && t < 0.0503) ? 1e4*sin(pi*(t - 0.0502)/1e-4) : 0", 2 / M_PI},
           {"1e5*max(0, 1 - abs(t - 0.05033)/1e-5)", 1},
           {"1e3*exp(-((t - 0.05)/2e-3)^2)", 2 * std::sqrt(M_PI)}}) {
    const Ran ran(GetParam(), load);
    EXPECT_NEAR(ran.momentum(), impulse, 0.01 * impulse) << load;
  }
}

/// Supports that start, stop or move for less than a step end up where they are told to.
TEST_P(Jumps, SupportsMoveAsFarAsPrescribed) {
  for (const auto& [velocity, distance] : std::initializer_list<std::pair<const char*, double>>{
           {"(t > 0.0502 && t < 0.0522) ? 0.5 : 0", 1e-3},
           {"(t > 0.0502 && t < 0.0503) ? 5 : 0", 5e-4},
           {"t < 0.0105 ? 0.1 : 0", 1.05e-3},
           {"(t > 0.0502 && t < 0.0504) ? 10*sin(pi*(t - 0.0502)/2e-4)^2 : 0", 1e-3}}) {
    tests::Scene scene = tests::scene_of(
        "fvm", pulled(GetParam(), "0") +
                   fmt::format("[[boundary]]\ngroup = \"z_min\"\ntype = \"velocity\"\n"
                               "value = [0, 0, \"{}\"]\n",
                               velocity));
    const scheme::Balance begun = scene.solver->balance();
    Simulation simulation(scene.setup, *scene.solver, {});
    EXPECT_EQ(simulation.run(), Ending::done);
    const Snapshot fields = scene.solver->snapshot();
    for (size_t a = 0; a < scene.graph.X.size(); ++a)
      if (scene.graph.X[a][2] == 0) {
        EXPECT_NEAR(fields.u[a][2], distance, 0.01 * distance) << velocity;
      }
    const scheme::Balance balance = scene.solver->balance();
    const scheme::Audit& audit = scene.solver->audit();
    EXPECT_NEAR(balance.kinetic - begun.kinetic + balance.strain + audit.numerical_dissipation,
                audit.external_work, 0.02 * std::abs(audit.external_work))
        << velocity;
  }
}

/// Exactly, step by step, and what an impact of supports brings is in the budget at once, also at
/// an output.
TEST_P(Jumps, OfSupportsAreBookedWhereTheyAre) {
  for (const char* instant : {"0.05", "0.0512345"}) {
    const double t = std::stod(instant);
    tests::Scene scene =
        tests::scene_of("fvm",
                        pulled(GetParam(), "0") + fmt::format("[[boundary]]\ngroup = \"z_min\"\n"
                                                              "type = \"velocity\"\n"
                                                              "value = [0, 0, \"t < {} ? 1 : 3\"]\n"
                                                              "[initial]\nvelocity = [0, 0, 1]\n",
                                                              instant),
                        {"time.max_retries=0"});
    EnergyGuard guard(scene.solver->balance(), 0.01, {0.5}, {1e-9});
    Simulation simulation(scene.setup, *scene.solver, {&guard});
    EXPECT_EQ(simulation.run(), Ending::done) << instant;
    const Snapshot fields = scene.solver->snapshot();
    for (size_t a = 0; a < scene.graph.X.size(); ++a) {
      if (scene.graph.X[a][2] == 0) {
        EXPECT_NEAR(fields.u[a][2], t + 3 * (0.1 - t), 1e-9) << instant;
      }
    }
  }
}

/// What a jump sets off is made in smaller steps where it opens the budget, not for what it brings,
/// at rest and in flight.
TEST_P(Jumps, OfSupportsAreNotMadeAgain) {
  for (const int speed : {0, 1, 10}) {
    tests::Scene scene = tests::scene_of(
        "fvm", pulled(GetParam(), "0") +
                   fmt::format("[[boundary]]\ngroup = \"z_min\"\ntype = \"velocity\"\n"
                               "value = [0, 0, \"t < 0.0512345 ? {} : {}\"]\n[initial]\n"
                               "velocity = [0, 0, {}]\n",
                               speed, speed + 2, speed));
    Simulation simulation(scene.setup, *scene.solver, {});
    EXPECT_EQ(simulation.run(), Ending::done);
    EXPECT_LE(simulation.totals().rejected, speed == 0 ? 5 : 1) << speed;
  }
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

/// Impulse and work are of the same forces: a body that a uniform force moves as a whole has the
/// kinetic energy of its momentum, however few steps see the force change.
TEST_P(Jumps, ForcesThatChangeBesideThemDoTheWorkOfTheirImpulse) {
  const bool is_leapfrog = GetParam() == "leapfrog";
  for (const auto& [load, impulse] : std::initializer_list<std::pair<const char*, double>>{
           {"t < 0.003 ? 1e5*t/0.003 : 0", 150},
           {"t < 0.02 ? 1e5*t/0.02 : 0", 1000},
           {"t < 0.003 ? 1e5*(1 - t/0.003) : 0", 150},
           {"t < 0.02 ? 1e5*(t/0.02)^2 : 2e4", 1e4 / 15 + 1600},
           {"t >= 0.0123 ? 1e5*exp(-(t - 0.0123)/0.005) : 0", 500}}) {
    tests::Scene scene =
        tests::scene_of("sph", pulled(GetParam(), "0") +
                                   fmt::format("[load]\nbody_force = [0, 0, \"{}\"]\n", load));
    Simulation simulation(scene.setup, *scene.solver, {});
    EXPECT_EQ(simulation.run(), Ending::done);
    const double momentum = scene.solver->balance().linear_momentum[2], mass = 1000;
    EXPECT_NEAR(momentum, impulse, 0.005 * impulse) << load;
    const double kinetic = momentum * momentum / (2 * mass);
    EXPECT_NEAR(scene.solver->audit().external_work, kinetic,
                (is_leapfrog ? 1e-10 : 2e-3) * kinetic)
        << load;
  }
}

/// And of a body that the load deforms as it sets in: the budget closes, and its work is that of
/// fine steps.
TEST_P(Jumps, OfLoadsThatChangeCloseTheBudget) {
  for (const char* load : {"t < 0.003 ? 1e4*t/0.003 : 0", "t < 0.02 ? 1e4*t/0.02 : 0",
                           "t < 0.01 ? 1e4*(1 - t/0.01) : 0", "t < 0.02 ? 1e4*(t/0.02)^2 : 2e3",
                           "t >= 0.0123 ? 1e4*exp(-(t - 0.0123)/0.005) : 0"}) {
    const Ran ran(GetParam(), load);
    tests::Scene fine = tests::scene_of("fvm", pulled("leapfrog", load), {"time.cfl=0.1"});
    Simulation simulation(fine.setup, *fine.solver, {});
    EXPECT_EQ(simulation.run(), Ending::done);
    const scheme::Balance balance = ran.scene.solver->balance();
    const scheme::Audit& audit = ran.scene.solver->audit();
    const double work = fine.solver->audit().external_work;
    EXPECT_NEAR(balance.kinetic + balance.strain + audit.numerical_dissipation, audit.external_work,
                0.008 * work)
        << load;
    EXPECT_NEAR(audit.external_work, work, 0.02 * work) << load;
  }
}

/// What holds at t = 0 alone is of no time: a run begins with what is right behind it.
TEST_P(Jumps, AtTheStartAreBehindTheRun) {
  const auto run = [&](const std::string& velocity, double initial) {
    tests::Scene scene = tests::scene_of(
        "fvm", pulled(GetParam(), "0") +
                   fmt::format("[[boundary]]\ngroup = \"z_min\"\ntype = \"velocity\"\n"
                               "value = [0, 0, \"{}\"]\n[initial]\n"
                               "velocity = [0, 0, {}]\n",
                               velocity, initial));
    EnergyGuard guard(scene.solver->balance(), 0.01, {0.9}, {1e-9});
    const double begun = scene.solver->balance().kinetic;
    Simulation simulation(scene.setup, *scene.solver, {&guard});
    EXPECT_EQ(simulation.run(), Ending::done) << velocity;
    return std::array{begun, scene.solver->balance().kinetic, scene.solver->audit().external_work};
  };
  for (const auto& [velocity, constant, initial] :
       std::initializer_list<std::tuple<const char*, const char*, double>>{
           {"t > 0 ? 1 : 0", "1", 0}, {"sign(t)", "1", 0}, {"t > 0 ? 0 : 5", "0", 5}}) {
    const auto jumps = run(velocity, initial), same = run(constant, initial);
    for (size_t k = 0; k < same.size(); ++k)
      EXPECT_NEAR(jumps[k], same[k], 1e-9 * same[1]) << velocity << ", " << k;
  }
}

/// Nor does what holds at the end of a step alone act.
TEST_P(Jumps, MayHaveAValueOfTheirOwn) {
  for (const double t : {0.04, 0.0412345}) {
    const Ran one(GetParam(), fmt::format("1e3*(1 + sign({} - t))", t));
    EXPECT_NEAR(one.momentum(), 2e3 * t, 1e-9);
    const Ran other(GetParam(), fmt::format("abs(t - {}) <= 0 ? 1e9 : 0", t));
    EXPECT_NEAR(other.momentum(), 0, 1e-3);
  }
}

TEST_P(Jumps, SmoothLoadsHaveNone) {
  const Ran one(GetParam(), "1e3*cos(10*t)"), other(GetParam(), "t < 5 ? 1e3*cos(10*t) : 0");
  EXPECT_EQ(one.times.at, other.times.at);
}

}  // namespace
}  // namespace diptych::run
