/// The first steps of a body that sets off are made again smaller where they open the energy
/// budget.

#include "common/run/budget_of_start.hpp"

#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

namespace diptych::run {
namespace {

using tests::Scene;

/// A column that is given a twist of 400 rad/s at its top, without strain.
std::string twist(const std::string& integrator) {
  return R"case([mesh]
lower = [-0.5, -0.5, 0]
upper = [0.5, 0.5, 3]
cells = [4, 4, 12]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.45
zeta_ratio = 0.5
[initial]
velocity = ["-600*y*sin(pi*z/6)", "600*x*sin(pi*z/6)", 0]
[[boundary]]
group = "z_min"
type = "fixed"
[time]
end = 0.1
integrator = ")case" +
         integrator + "\"\n";
}

struct Start {
  double residual = 0;  ///< of the energy at t = 0
  double largest = 0;   ///< that a step opened the budget by
  int rejected = 0;
};

Start first_steps_of(Scene scene) {
  const auto now = [&] { return EnergyBudget{scene.solver->balance(), scene.solver->audit()}; };
  const EnergyBudget initial = now();
  Start start;
  EnergyBudget before = initial;
  for (std::int64_t k = 0; k < BudgetOfStart::n_steps; ++k) {
    start.rejected += scene.solver->step(scene.setup.time.end).rejected;
    const EnergyBudget after = now();
    const double held = std::max(before.balance.kinetic + before.balance.strain,
                                 after.balance.kinetic + after.balance.strain);
    start.largest =
        std::max(start.largest, std::abs(after.unaccounted() - before.unaccounted()) / held);
    before = after;
  }
  start.residual = std::abs(before.unaccounted() - initial.unaccounted()) / initial.balance.kinetic;
  return start;
}

class BudgetOfStartOf : public testing::TestWithParam<const char*> {};

TEST_P(BudgetOfStartOf, RungeKuttaIsHeldToTheGuard) {
  const std::string text = twist("ssp-rk3");
  const Start free = first_steps_of(tests::scene_of(GetParam(), text, {"time.max_retries=0"}));
  constexpr double share = 0.01 / BudgetOfStart::n_steps;
  ASSERT_GT(free.largest, 2 * share) << "this scene asks nothing";
  const Start held = first_steps_of(tests::scene_of(GetParam(), text));
  EXPECT_GT(held.rejected, 0);
  EXPECT_LE(held.largest, share);
  EXPECT_LE(held.residual, 0.01);
  const Start loose =
      first_steps_of(tests::scene_of(GetParam(), text, {"guards.energy_residual=0.5"}));
  EXPECT_EQ(loose.rejected, 0);
  EXPECT_EQ(loose.residual, free.residual);
}

/// A block that is let go with a stress that its free sides do not carry.
const std::string let_go = R"case([mesh]
cells = [4, 4, 4]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[initial]
displacement = [0, 0, "0.1*z"]
[[boundary]]
group = "z_min"
type = "fixed"
[time]
end = 0.1
)case";

/// Largest part of the energy by which the budget was open after one of the first steps.
double largest_gap_of(Scene scene, int n_steps) {
  const EnergyBudget initial{scene.solver->balance(), scene.solver->audit()};
  const double held = initial.balance.kinetic + initial.balance.strain;
  double largest = 0;
  for (int k = 0; k < n_steps; ++k) {
    scene.solver->step(scene.setup.time.end);
    const EnergyBudget now{scene.solver->balance(), scene.solver->audit()};
    largest = std::max(largest, std::abs(now.unaccounted() - initial.unaccounted()) / held);
  }
  return largest;
}

TEST_P(BudgetOfStartOf, LeapfrogIsHeldToTheGuardWhereItsEnergySwings) {
  constexpr double bound = 0.01;
  EXPECT_GT(largest_gap_of(tests::scene_of(GetParam(), let_go, {"time.max_retries=0"}), 40), bound)
      << "this scene asks nothing";
  EXPECT_LE(largest_gap_of(tests::scene_of(GetParam(), let_go), 40), bound);
}

TEST_P(BudgetOfStartOf, ABodyAtRestIsLeftAlone) {
  EXPECT_EQ(
      first_steps_of(tests::scene_of(GetParam(), twist("ssp-rk3"),
                                     {"initial.velocity=[0, 0, 0]", "boundary.0.type=\"traction\"",
                                      "boundary.0.value=[0, 0, 1e5]"}))
          .rejected,
      0);
}

INSTANTIATE_TEST_SUITE_P(Both,
                         BudgetOfStartOf,
                         testing::Values("sph", "fvm"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace diptych::run
