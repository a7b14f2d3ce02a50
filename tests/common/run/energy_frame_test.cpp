/// Energies are judged in the frame of the centre of mass where nothing holds the body, and with
/// what walls take.

#include "common/base/error.hpp"
#include "common/run/observers/energy_guard.hpp"
#include "tests/common/run/free_cube.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::HasSubstr;
using tests::free_cube;

/// Of 2 kg, which nothing holds.
EnergyUnits free_units() {
  return {1e-9, {algebra::Mat3::Identity(), 2}, 0};
}

scheme::Balance flying(double kinetic, double speed) {
  scheme::Balance balance;
  balance.kinetic = kinetic;
  balance.linear_momentum.x() = 2 * speed;
  return balance;
}

StepReport at_step(std::int64_t number) {
  StepReport step;
  step.step = number;
  return step;
}

// A body that flies has the energy of its centre of mass in this frame and in no other.
TEST(EnergyGuard, JudgesAFlyingBodyAsOneInPlace) {
  const scheme::Balance initial = flying(1001, std::sqrt(1000.0));  // of which 1 turns it
  scheme::Audit audit;
  audit.numerical_dissipation = 0.6;
  const StepReport step = at_step(100);
  scheme::Balance now = initial;
  now.kinetic -= audit.numerical_dissipation;
  EnergyGuard frame(initial, 0.01, {0.5}, {1e-9}), body(initial, 0.01, {0.5}, free_units());
  EXPECT_NO_THROW(frame.at_check({step, now, audit}));
  EXPECT_THROW(body.at_check({step, now, audit}), base::BreakdownError);
  now.kinetic = 1001 - 0.02;
  audit.numerical_dissipation = 0;
  EXPECT_NEAR(EnergyRecord(initial, free_units()).at(now, audit).relative_residual, -0.02, 1e-12);
}

TEST(EnergyGuard, JudgesABodyThatFallsAsOneInPlace) {
  const scheme::Balance initial = flying(1, 0);  // all of it vibration
  scheme::Audit audit;
  audit.external_work = 100;
  audit.numerical_dissipation = 0.6;
  const scheme::Balance now = flying(101 - 0.6, 10);
  EnergyGuard body(initial, 0.01, {0.5}, free_units());
  try {
    body.at_check({at_step(100), now, audit});
    ADD_FAILURE() << "not stopped";
  } catch (const base::BreakdownError& error) {
    EXPECT_THAT(error.what(), HasSubstr("numerical dissipation has taken 0.6 of the largest"));
  }
  audit.numerical_dissipation = 0.4;
  EXPECT_NO_THROW(EnergyGuard(initial, 0.01, {0.5}, free_units())
                      .at_check({at_step(100), flying(101 - 0.4, 10), audit}));
}

TEST(EnergyGuard, CountsWhatWallsTakeAsTheyCatchNodes) {
  const scheme::Balance initial = flying(1, 0), now = flying(0.4, 0);
  scheme::Audit audit;
  audit.external_work = -0.5;
  audit.contact_loss = 0.5;
  audit.numerical_dissipation = 0.1;
  EnergyGuard guard(initial, 0.01, {0.5}, {1e-9});
  try {
    guard.at_check({at_step(100), now, audit});
    ADD_FAILURE() << "not stopped";
  } catch (const base::BreakdownError& error) {
    EXPECT_THAT(error.what(), HasSubstr("numerical dissipation (0.1) and walls at the catch of "
                                        "nodes (0.5) have taken 0.6 of the largest energy"));
  }
}

TEST(EnergyGuard, JudgesLossesFromATenthOfTheStepsOn) {
  const scheme::Balance initial = flying(1, 0), now = flying(0.4, 0);
  scheme::Audit audit;
  audit.numerical_dissipation = 0.6;
  const auto judge = [&](std::int64_t step) {
    EnergyGuard(initial, 0.01, {0.5, 1.0, 100}, {1e-9}).at_check({at_step(step), now, audit});
  };
  EXPECT_NO_THROW(judge(99));
  EXPECT_THROW(judge(100), base::BreakdownError);
}

TEST(EnergyUnits, HaveAFrameWhereNothingThatStandsStillHoldsTheBody) {
  const auto free_with = [](const std::string& boundary) {
    const tests::Scene scene = tests::scene_of("fvm", std::string(free_cube) + boundary, {});
    return algebra::Mat3(energy_units(scene.setup, scene.graph, 1).frame.free);
  };
  const algebra::Mat3 all = algebra::Mat3::Identity();
  const auto plane = [&](int i) {
    algebra::Mat3 of_plane = all;
    of_plane(i, i) = 0;
    return of_plane;
  };
  const auto group = [](const std::string& name, const std::string& type) {
    return "\n[[boundary]]\ngroup = \"" + name + "\"\ntype = \"" + type + "\"\n";
  };
  const auto expect = [](const algebra::Mat3& found, const algebra::Mat3& wanted) {
    EXPECT_LT((found - wanted).norm(), 1e-12) << found;
  };
  expect(free_with(""), all);
  expect(free_with(group("x_min", "symmetry")), plane(0));
  expect(free_with(group("x_min", "symmetry") + group("z_max", "symmetry")), plane(0) * plane(2));
  expect(free_with(group("y_min", "fixed")), algebra::Mat3::Zero());
  expect(free_with(group("y_min", "velocity") + "value = [\"t\", 0, 3]\n"), all);
  expect(free_with(group("y_min", "rigid-wall") + "point = [0, -1, 0]\nnormal = [0, 1, 0]\n"),
         plane(1));
}

}  // namespace
}  // namespace diptych::run
