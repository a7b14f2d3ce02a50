/// What observers of a simulation are told of, and how simulations end.

#include "common/run/simulation.hpp"

#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;
using testing::Le;

const char* const swaying = R"([mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [2, 2]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[initial]
velocity = ["SPEED*y", 0]
[time]
end = 0.03
[output]
frames = 2
)";

/// With shear of so many 1/s.
cases::Case case_of(const char* shear, const std::vector<std::string>& overrides = {}) {
  std::string text = swaying;
  text.replace(text.find("SPEED"), 5, shear);
  return cases::case_from_text(text, "scene", overrides);
}

/// Writes down what it is told.
class Listener : public Observer {
 public:
  void begin() override { told.push_back("begin"); }
  void after_step(const StepReport& step) override {
    told.push_back(fmt::format("step {}", step.step));
    times.push_back(step.time);
  }
  void at_output(const Output& output) override {
    told.push_back(fmt::format("output {}", output.number));
    EXPECT_EQ(output.state.time(), output.step.time);
    EXPECT_EQ(output.state.time(), times.empty() ? 0 : times.back());
    EXPECT_GT(output.balance.kinetic, 0);
    EXPECT_EQ(output.state.fields().u.size(), 9u);
    output_times.push_back(output.state.time());
  }
  void end(Ending ending) override { told.push_back(status_of(ending)); }

  std::vector<std::string> told;
  std::vector<double> times, output_times;
};

/// What a listener should have heard of this many steps to each output.
std::vector<std::string> sequence(const std::vector<int>& steps, const char* ending) {
  std::vector<std::string> told{"begin", "output 0"};
  int n = 0;
  for (size_t k = 0; k < steps.size(); ++k) {
    for (int i = 0; i < steps[k]; ++i)
      told.push_back(fmt::format("step {}", ++n));
    told.push_back(fmt::format("output {}", k + 1));
  }
  told.push_back(ending);
  return told;
}

TEST(Simulation, TellsOfEachStepAndOfEachOutputOnceAndInOrder) {
  tests::Scene scene("fvm", case_of("1"));
  Listener first, second;
  Simulation simulation(scene.setup, *scene.solver, {&first, &second});
  EXPECT_EQ(simulation.run(), Ending::done);
  const auto half =
      std::count_if(first.times.begin(), first.times.end(), [](double t) { return t <= 0.015; });
  const StepTotals& totals = simulation.totals();
  EXPECT_GT(half, 1) << "steps between outputs are what this is about";
  const int n = static_cast<int>(half);
  EXPECT_EQ(first.told, sequence({n, static_cast<int>(totals.steps) - n}, "done"));
  EXPECT_EQ(second.told, first.told);
  EXPECT_THAT(first.output_times, ElementsAre(0, 0.015, 0.03));
  EXPECT_THAT((std::vector{totals.dt_min, totals.dt_max}), Each(AllOf(Gt(0), Le(0.015))));
  EXPECT_LE(totals.dt_min, totals.dt_max);
  EXPECT_EQ(simulation.take_state().time, 0.03);
}

/// Parts of the state at an output, before and after all of it was asked for.
class Looker : public Observer {
 public:
  void at_output(const Output& output) override {
    const std::vector<std::int32_t> nodes{5, 0, 3};
    const Snapshot before = output.state.fields_of(nodes);
    const Snapshot& all = output.state.fields();
    const Snapshot after = output.state.fields_of(nodes);
    EXPECT_EQ(&output.state.fields(), &all);
    for (const Snapshot* part : {&before, &after}) {
      EXPECT_EQ(part->time, output.step.time);
      ASSERT_EQ(part->u.size(), nodes.size());
      for (size_t k = 0; k < nodes.size(); ++k) {
        const auto a = static_cast<size_t>(nodes[k]);
        EXPECT_EQ(part->u[k], all.u[a]);
        EXPECT_EQ(part->v[k], all.v[a]);
        EXPECT_EQ(part->F[k], all.F[a]);
        EXPECT_EQ(part->P[k], all.P[a]);
        EXPECT_EQ(part->J[k], all.J[a]);
      }
    }
    ++n_outputs;
  }
  int n_outputs = 0;
};

TEST(Simulation, GivesPartsOfTheStateAsTheyAreInAllOfIt) {
  for (const char* method : {"sph", "fvm"}) {
    tests::Scene scene(method, case_of("1"));
    Looker looker;
    Simulation simulation(scene.setup, *scene.solver, {&looker});
    EXPECT_EQ(simulation.run(), Ending::done);
    EXPECT_EQ(looker.n_outputs, 3);
  }
}

TEST(Simulation, EndsAtTheStepLimitWithAnOutput) {
  tests::Scene scene("fvm", case_of("1", {"time.max_steps=1"}));
  Listener listener;
  Simulation simulation(scene.setup, *scene.solver, {&listener});
  EXPECT_EQ(simulation.run(), Ending::step_limit);
  EXPECT_EQ(listener.told, sequence({1}, "step limit"));
}

TEST(Simulation, EndsWhereItIsInterruptedWithAnOutput) {
  tests::Scene scene("fvm", case_of("1"));
  Listener listener;
  Simulation simulation(scene.setup, *scene.solver, {&listener},
                        [&] { return listener.times.size() == 2; });
  EXPECT_EQ(simulation.run(), Ending::interrupted);
  EXPECT_EQ(listener.told, sequence({2}, "interrupted"));
}

TEST(Simulation, TellsOfABreakdownWithoutAnOutput) {
  tests::Scene scene("fvm", case_of("1e4", {"time.max_retries=1"}));
  Listener listener;
  Simulation simulation(scene.setup, *scene.solver, {&listener});
  EXPECT_EQ(simulation.run(), Ending::breakdown);
  ASSERT_TRUE(simulation.breakdown());
  EXPECT_THAT(simulation.breakdown()->what(), HasSubstr("node"));
  EXPECT_EQ(listener.told.back(), "breakdown");
  EXPECT_EQ(simulation.totals().steps, static_cast<std::int64_t>(listener.times.size()));
  EXPECT_EQ(simulation.totals().begun, simulation.totals().steps + 1);
  EXPECT_EQ(simulation.take_state().time, scene.solver->time()) << "that before the step";
}

/// Stops the simulation at its second output.
class Objector : public Observer {
 public:
  void at_output(const Output& output) override {
    if (output.number == 1) throw base::BreakdownError("enough");
  }
};

TEST(Simulation, CanBeBrokenOffByAnObserver) {
  tests::Scene scene("fvm", case_of("1"));
  Objector objector;
  Listener listener;
  Simulation simulation(scene.setup, *scene.solver, {&listener, &objector});
  EXPECT_EQ(simulation.run(), Ending::breakdown);
  EXPECT_STREQ(simulation.breakdown()->what(), "enough");
  EXPECT_EQ(listener.told.back(), "breakdown");
  EXPECT_THAT(listener.output_times, ElementsAre(0, 0.015));
  EXPECT_EQ(simulation.totals().begun, simulation.totals().steps);
  EXPECT_EQ(simulation.take_state().time, 0.015) << "that of the output which it ended with";
}

/// Fails as a full disk does.
class FullDisk : public Observer {
 public:
  void after_step(const StepReport& step) override {
    if (step.step == 2) throw base::EnvironmentError("disk full");
  }
};

TEST(Simulation, ThrowsOnWhatIsNoBreakdownAndKeepsItsTotals) {
  tests::Scene scene("fvm", case_of("1"));
  FullDisk disk;
  Simulation simulation(scene.setup, *scene.solver, {&disk});
  EXPECT_THROW(simulation.run(), base::EnvironmentError);
  EXPECT_FALSE(simulation.breakdown());
  EXPECT_EQ(simulation.totals().steps, 2);
}

}  // namespace
}  // namespace diptych::run
