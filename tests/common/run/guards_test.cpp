/// Runs that are no solution any more are stopped, with what they had found until then; sound ones
/// are not.

#include "common/run/observers/cell_guard.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "common/run/observers/history.hpp"
#include "common/run/observers/involution_guard.hpp"
#include "common/run/simulation.hpp"
#include "tests/common/run/free_cube.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::free_cube;

constexpr double any_loss = std::numeric_limits<double>::infinity();

/// A run of the cube with guards, and with `inverted` cells of 64 from the fourth output on.
struct Guarded {
  Guarded(const std::string& method,
          const std::vector<std::string>& overrides,
          std::int64_t inverted = 0,
          double least_energy = 0)
      : scene(tests::scene_of(method, free_cube, overrides)),
        probes(scene.setup.probes, scene.graph, {}),
        cells([this, inverted] {
          return ++n_outputs > 3 && inverted > 0 ? LeastCell{-0.5, inverted, 64, {0.25, 0.5, 0.75}}
                                                 : LeastCell{1, 0, 64};
        }),
        history(*scene.solver, probes, cells),
        energy_guard(scene.solver->balance(),
                     scene.setup.guards.energy_residual,
                     {any_loss},
                     EnergyUnits{least_energy}),
        cell_guard(cells) {}

  /// @param guards_cells  as guards.inverted_cells = "stop"
  Ending run(bool guards_cells = true) {
    std::vector<Observer*> observers{&cells, &history, &energy_guard};
    if (guards_cells) observers.push_back(&cell_guard);
    Simulation simulation(scene.setup, *scene.solver, observers);
    const Ending ending = simulation.run();
    if (simulation.breakdown()) message = simulation.breakdown()->what();
    return ending;
  }

  tests::Scene scene;
  Probes probes;
  int n_outputs = 0;
  Cells cells;
  History history;
  EnergyGuard energy_guard;
  CellGuard cell_guard;
  std::string message;
};

TEST(EnergyGuard, StopsAnUnstableRunBeforeAnyNodeShowsIt) {
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    Guarded run(method, {"time.cfl=3"});
    EXPECT_EQ(run.run(), Ending::breakdown);
    EXPECT_THAT(run.message, AllOf(HasSubstr("energy budget"), HasSubstr("bound 0.01, step "),
                                   HasSubstr("time.cfl"), HasSubstr("guards.energy_residual")));
    const io::HistoryRow& last = run.history.rows().back();
    EXPECT_GT(last.energy.relative_residual, 0.01) << "the row that it stopped at is kept";
    EXPECT_TRUE(std::isfinite(last.energy.kinetic));
    EXPECT_GT(last.min_jacobian, 0.9) << "strains are some hundredths yet";
  }
}

/// The budget closes all the same: what D_ab gave is in it.
TEST(EnergyGuard, StopsWhereNumericalDissipationGivesEnergy) {
  Guarded run("fvm", {});
  const scheme::Balance initial = run.scene.solver->balance();
  for (const double part : {0.009, 0.011}) {
    EnergyGuard guard(initial, 0.01, {any_loss}, {});
    scheme::Balance now = initial;
    scheme::Audit audit;
    audit.numerical_dissipation = -part * initial.kinetic;
    now.kinetic += part * initial.kinetic;
    const StepReport step;
    if (part < 0.01) {
      EXPECT_NO_THROW(guard.at_check({step, now, audit}));
      continue;
    }
    try {
      guard.at_check({step, now, audit});
      ADD_FAILURE() << "not stopped";
    } catch (const base::BreakdownError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("has given the body 0.01"), HasSubstr("limiter"),
                                      HasSubstr("guards.energy_residual")));
    }
  }
}

/// What leapfrog's energy swings by comes back; what it has lost does not, nor what grows.
TEST(EnergyGuard, LeavesOutWhatSwingsBack) {
  scheme::Balance initial;
  initial.kinetic = 10;
  const auto is_stopped = [&](double residual, double swing) {
    EnergyGuard guard(initial, 0.01, {any_loss}, {1e-9});
    scheme::Balance now = initial;
    now.kinetic += 10 * residual;
    now.swing = 10 * swing;
    StepReport step;
    step.step = 1000;
    try {
      guard.at_check({step, now, {}});
    } catch (const base::BreakdownError&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(is_stopped(0.03, 0));
  EXPECT_TRUE(is_stopped(0.03, 0.015));
  EXPECT_FALSE(is_stopped(0.03, 0.025));
  EXPECT_TRUE(is_stopped(-0.03, 0.025)) << "lost";
  EXPECT_FALSE(is_stopped(-0.03, -0.025)) << "it swings to either side";
  EXPECT_TRUE(is_stopped(0.3, 0.3)) << "no swing is as large";
}

/// A load that grows on a body that holds next to nothing: what its first steps swing by, more than
/// the body holds, is in the work of the load.
TEST(EnergyGuard, LetsLoadsGrowOnBodiesThatHoldLittle) {
  constexpr double threshold = 0.003;
  const std::string text = R"toml(
[mesh]
element = "triangle"
cells = [8, 8]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e7
poissons_ratio = 0.3
[initial]
velocity = ["-0.08*x", 0]
[[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = "x_max"
type = "traction"
value = ["7.5e5*sin(pi*t/0.0066)^2", "6.4e5*sin(pi*t/0.0066)^2"]
[time]
end = 1e-3)toml";
  for (const char* method : {"sph", "fvm"}) {
    const tests::Scene scene = tests::scene_of(method, text);
    EnergyGuard guard(scene.solver->balance(), threshold, {any_loss}, {1e-12});
    double largest = 0;
    const scheme::Balance begun = scene.solver->balance();
    for (int frame = 1; frame <= 20; ++frame) {
      tests::run_to(*scene.solver, 5e-5 * frame);
      const scheme::Balance now = scene.solver->balance();
      const scheme::Audit& audit = scene.solver->audit();
      const StepReport late{1000, 0, 0, 1, 0, false};  // no first steps any more
      EXPECT_NO_THROW(guard.at_check({late, now, audit})) << method << ", frame " << frame;
      const double off = now.kinetic + now.strain - begun.kinetic - begun.strain - audit.gain();
      const double held = std::max(now.kinetic + now.strain, audit.external_work);
      largest = std::max(largest, std::abs(off) / held);
    }
    EXPECT_LT(largest, 1e-3)
        << "more than the threshold where loads worked at the velocity of the middle";
  }
}

TEST(EnergyGuard, StopsEnergyOfNothingInTheFirstStepsOfABodyAtRest) {
  const auto judge = [&](std::int64_t number, double kinetic) {
    EnergyGuard guard(scheme::Balance{}, 0.01, {0.5}, {1e-9});
    scheme::Balance now;
    scheme::Audit audit;
    guard.at_check({StepReport{}, now, audit});
    now.kinetic = kinetic;
    audit.external_work = 1;
    StepReport step;
    step.step = number;
    guard.at_check({step, now, audit});
  };
  // of 8/n^2: 0.32 and 0.08 of the energy held; of 0.5/n: 0.0263 and 0.0102
  EXPECT_NO_THROW(judge(2, 100));
  EXPECT_NO_THROW(judge(5, 1.4));
  EXPECT_THROW(judge(5, 1.5), base::BreakdownError);
  EXPECT_NO_THROW(judge(10, 1.08));
  EXPECT_THROW(judge(10, 1.09), base::BreakdownError);
  EXPECT_NO_THROW(judge(19, 1.026));
  EXPECT_THROW(judge(19, 1.028), base::BreakdownError);
  EXPECT_NO_THROW(judge(49, 1.0102));
  EXPECT_THROW(judge(50, 1.0102), base::BreakdownError);
  EXPECT_NO_THROW(judge(10, 1e-10 + 1));
}

// A pulse in the midst of a run: the steps in which the energy grows 128-fold are first steps, too,
// but what makes all of its growth of nothing is not.
TEST(EnergyGuard, CountsTheFirstStepsFromWhereTheEnergyGrows) {
  const auto judge = [&](double grown, double share, std::int64_t number) {
    scheme::Balance now;
    now.kinetic = 1;
    EnergyGuard guard(now, 0.01, {0.5}, {1e-9});
    scheme::Audit audit;
    StepReport step;
    step.step = 100;
    guard.at_check({step, now, audit});
    step.step = 104;
    now.kinetic = grown;
    audit.external_work = (grown - 1) * (1 - share);
    guard.at_check({step, now, audit});
    step.step = number;
    guard.at_check({step, now, audit});
  };
  EXPECT_NO_THROW(judge(200, 0.3, 105));
  EXPECT_THROW(judge(200, 0.6, 105), base::BreakdownError);
  EXPECT_THROW(judge(200, 0.3, 110), base::BreakdownError) << "6 steps on, 8/36";
  EXPECT_NO_THROW(judge(200, 0.05, 110));
  EXPECT_THROW(judge(200, 0.05, 154), base::BreakdownError);
  EXPECT_THROW(judge(30, 0.3, 105), base::BreakdownError);
}

// the load sets in between two checks: its first step is not the tenth
TEST(EnergyGuard, CountsTheFirstStepsFromWhereTheBodyMoves) {
  for (const std::int64_t loaded : {1, 9}) {
    EnergyGuard guard(scheme::Balance{}, 0.01, {0.5}, {1e-9});
    scheme::Balance now;
    scheme::Audit audit;
    StepReport step;
    guard.at_check({step, now, audit});
    while (step.step < 10) {
      ++step.step;
      step.least_J = step.step < loaded ? 1 - 1e-15 : 0.999;
      guard.after_step(step);
    }
    audit.external_work = 1;
    now.kinetic = 1.5;  // residual 1/3 of what it holds: more than 8/10^2, less than 8/2^2
    if (loaded == 1) {
      EXPECT_THROW(guard.at_check({step, now, audit}), base::BreakdownError);
    } else {
      EXPECT_NO_THROW(guard.at_check({step, now, audit}));
    }
  }
}

// shear moves no J: how long it has gone on is not known, but no start errs by so much
TEST(EnergyGuard, HasABoundWhereShearAloneSetsIn) {
  for (const double kinetic : {1.5, 3.0}) {
    EnergyGuard guard(scheme::Balance{}, 0.01, {0.5}, {1e-9});
    scheme::Balance now;
    scheme::Audit audit;
    StepReport step;
    guard.at_check({step, now, audit});
    for (step.step = 1; step.step < 100; ++step.step)
      guard.after_step(step);
    audit.external_work = 1;
    now.kinetic = kinetic;
    if (kinetic > 2) {
      EXPECT_THROW(guard.at_check({step, now, audit}), base::BreakdownError);
    } else {
      EXPECT_NO_THROW(guard.at_check({step, now, audit}));
    }
  }
}

/// The step at which the energy of a body first is more than its budget allows.
class FirstGrowth : public Observer {
 public:
  FirstGrowth(const Solver& solver, const scheme::Balance& initial)
      : solver_(solver), energy_(initial) {}
  void after_step(const StepReport& step) override {
    last = step.step;
    const double residual = energy_.at(solver_.balance(), solver_.audit()).relative_residual;
    if (first < 0 && residual > beyond_swing) first = step.step;
  }
  std::int64_t first = -1, last = 0;

 private:
  static constexpr double beyond_swing = 6e-3;  // that leapfrog is held to
  const Solver& solver_;
  EnergyRecord energy_;
};

// Whatever the output times: this run has one at its end only.
TEST(EnergyGuard, StopsWithinAHundredStepsOfTheFirstGrowth) {
  for (const char* method : {"sph", "fvm"}) {
    for (const char* integrator : {"ssp-rk2", "ssp-rk3", "leapfrog"}) {
      for (const char* cfl : {"2", "3", "4"}) {
        SCOPED_TRACE(std::string(method) + " " + integrator + " " + cfl);
        Guarded run(method,
                    {std::string("time.cfl=") + cfl,
                     std::string("time.integrator=\"") + integrator + "\"", "output.frames=1",
                     "time.end=1", "sph.gradient=\"corrected\"", "fvm.stencil=\"edge\""});
        FirstGrowth growth(*run.scene.solver, run.scene.solver->balance());
        Simulation simulation(run.scene.setup, *run.scene.solver,
                              {&run.cells, &run.history, &growth, &run.energy_guard});
        if (simulation.run() == Ending::done) {
          EXPECT_LE(std::abs(run.history.rows().back().energy.relative_residual), 1e-2);
          continue;
        }
        if (growth.first < 0) {  // so large a step may take energy away instead, slowly
          EXPECT_LT(run.history.rows().back().energy.relative_residual, -1e-2);
          continue;
        }
        EXPECT_LE(growth.last - growth.first, 100) << simulation.breakdown()->what();
      }
    }
  }
}

// Every step begins with H = cof F and J = det F: only a bound that nothing meets is exceeded.
TEST(InvolutionGuard, StopsWhereHAndJHaveLeftF) {
  Guarded run("fvm", {"time.cfl=0.5"});
  InvolutionGuard guard(*run.scene.solver, -1);
  Simulation simulation(run.scene.setup, *run.scene.solver, {&run.cells, &run.history, &guard});
  EXPECT_EQ(simulation.run(), Ending::breakdown);
  EXPECT_THAT(simulation.breakdown()->what(),
              AllOf(HasSubstr("|H - cof F|"), HasSubstr("bound -1, step "), HasSubstr("at node "),
                    HasSubstr("time.cfl"), HasSubstr("guards.involution")));
  EXPECT_TRUE(simulation.breakdown()->node());
}

TEST(InvolutionGuard, LetsPassWhereHAndJAreExact) {
  Guarded run("fvm", {"time.cfl=0.5"});
  InvolutionGuard guard(*run.scene.solver, 1e-12);
  Simulation simulation(run.scene.setup, *run.scene.solver, {&run.cells, &run.history, &guard});
  EXPECT_EQ(simulation.run(), Ending::done);
}

TEST(StepGuard, HasTheShareOfTheCase) {
  // a cube that is crushed: its wave speeds rise, and the step falls by a third and more
  tests::Scene scene = tests::scene_of(
      "fvm", free_cube,
      {"initial.velocity=[\"-300*x\", \"-300*y\", \"-300*z\"]", "guards.least_step=0.7"});
  Simulation simulation(scene.setup, *scene.solver, {});
  ASSERT_EQ(simulation.run(), Ending::breakdown);
  EXPECT_THAT(simulation.breakdown()->what(),
              AllOf(HasSubstr("collapsed"), HasSubstr("guards.least_step (0.7 of the first step)"),
                    HasSubstr("at node ")));
  EXPECT_TRUE(scene.solver->is_sound());
}

TEST(EnergyGuard, LetsAStableRunPass) {
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    Guarded run(method, {"time.cfl=0.5"});
    EXPECT_EQ(run.run(), Ending::done) << run.message;
  }
}

TEST(EnergyGuard, HasTheBoundOfTheCase) {
  // the residual of the second-order scheme is 1e-3, of the order of dt^2
  Guarded run("fvm", {"time.cfl=0.5", "guards.energy_residual=1e-5"});
  EXPECT_EQ(run.run(), Ending::breakdown);
  EXPECT_THAT(run.message, HasSubstr("bound 1e-05"));
}

TEST(EnergyGuard, DoesNotJudgeRounding) {
  // all that the cube ever has is 190 J
  Guarded run("fvm", {"time.cfl=0.5", "guards.energy_residual=1e-5"}, 0, 1e3);
  EXPECT_EQ(run.run(), Ending::done) << run.message;
}

// Of a body that is let go its kinetic energy is seen at outputs alone: a strip with strains of
// 1e-6 was stopped with 3 frames and not with 10.
TEST(EnergyGuard, JudgesLossesBelowRoundingByWhatABodyHeldAtFirst) {
  scheme::Balance initial, now;
  initial.strain = 10;
  now.kinetic = 1;
  now.strain = 6;
  scheme::Audit audit;
  StepReport step;
  step.step = 100;
  EnergyGuard guard(initial, 1e9, {0.5}, {1e3});
  audit.numerical_dissipation = 3;
  EXPECT_NO_THROW(guard.at_check({step, now, audit}));
  audit.numerical_dissipation = 6;
  EXPECT_THROW(guard.at_check({step, now, audit}), base::BreakdownError);
}

TEST(EnergyRecord, HasNoResidualOfABodyThatHoldsWhatRoundingMakes) {
  scheme::Balance initial, now;
  scheme::Audit audit;
  now.strain = 3e-10;
  EXPECT_EQ(EnergyRecord(initial, {1e-9}).at(now, audit).relative_residual, 0);
  EXPECT_EQ(EnergyRecord(initial).at(now, audit).relative_residual, 1);
  now.strain = 2e-9;
  EXPECT_EQ(EnergyRecord(initial, {1e-9}).at(now, audit).relative_residual, 1);
}

TEST(MomentumRecord, HasNoDriftOfABodyAtRest) {
  scheme::Balance initial, now;
  now.linear_momentum.x() = now.momentum_scale = 1e-13;
  now.angular_momentum.z() = now.angular_scale = 1e-12;
  const auto drift = [&](const MomentumUnits& rounding) {
    MomentumRecord record(initial, rounding);
    record.at(now, scheme::Audit{});
    return std::array{record.linear_drift(), record.angular_drift()};
  };
  EXPECT_EQ(drift({}), (std::array{1.0, 1.0}));
  EXPECT_EQ(drift({1e-9, 1e-9}), (std::array{0.0, 0.0}));
  EXPECT_EQ(drift({1e-14, 1e-9}), (std::array{1.0, 0.0}));
}

TEST(CellGuard, StopsWhereACellIsInsideOutAndKeepsTheRow) {
  Guarded run("fvm", {"time.cfl=0.5"}, 1);
  EXPECT_EQ(run.run(), Ending::breakdown);
  EXPECT_THAT(run.message, AllOf(HasSubstr("1 of 64 cells"), HasSubstr("time 0.024 s"),
                                 HasSubstr("(0.25, 0.5, 0.75)"), HasSubstr("sign-preserving"),
                                 HasSubstr("guards.inverted_cells")));
  ASSERT_EQ(run.history.rows().size(), 4u);
  EXPECT_EQ(run.history.rows().back().least_cell_J, -0.5);
}

TEST(CellGuard, IsNotThereWhereTheCaseWarns) {
  Guarded run("fvm", {"time.cfl=0.5"}, 1);
  EXPECT_EQ(run.run(false), Ending::done) << run.message;
  io::RunSummary summary;
  run.cells.fill(summary);
  EXPECT_EQ(summary.most_inverted_cells, 1);
  EXPECT_NEAR(summary.inverted_from.value_or(0), 0.024, 1e-15) << "the output time, to rounding";
}

}  // namespace
}  // namespace diptych::run
