/// Runs whose angular momentum has drifted are stopped, sound ones are not.

#include "common/run/observers/momentum_guard.hpp"

#include "common/base/error.hpp"
#include "tests/common/run/free_cube.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::free_cube;

TEST(MomentumGuard, StopsWhereRotationIsBrakedAndNotWhereAMomentDoesIt) {
  scheme::Balance initial, now;
  initial.kinetic = now.kinetic = 1;
  initial.angular_momentum.z() = 10;
  initial.angular_scale = now.angular_scale = 12;
  tests::Scene scene = tests::scene_of("fvm", free_cube, {});
  Snapshot fields;
  const auto judge = [&](double L, double impulse) {
    MomentumGuard guard(initial, 0, 0.2, 1e-9);
    OutputState state(*scene.solver, fields);
    guard.at_output({0, StepReport{}, initial, scheme::Audit{}, state});
    now.angular_momentum.z() = L;
    scheme::Audit audit;
    audit.impulse.angular.z() = impulse;
    StepReport step;
    step.step = 50;
    guard.at_check({step, now, audit});
  };
  EXPECT_NO_THROW(judge(7.7, 0));
  EXPECT_NO_THROW(judge(-9, -18));
  EXPECT_THROW(judge(10, -3), base::BreakdownError);
  try {
    judge(7.5, 0);
    ADD_FAILURE() << "not stopped";
  } catch (const base::BreakdownError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("angular momentum has drifted by 0.208 of the largest sum of "
                                "|x||p| so far, bound 0.2, step 50, "),
                      HasSubstr("--level"), HasSubstr("angular_momentum_projection"),
                      HasSubstr("guards.angular_drift")));
  }
}

TEST(MomentumGuard, TellsTheFigureThatItJudges) {
  scheme::Balance initial, now;
  initial.kinetic = now.kinetic = 1;
  initial.angular_momentum.z() = 10;
  initial.angular_scale = now.angular_scale = 12;
  now.angular_momentum.z() = -200;
  scheme::Audit audit;
  audit.external_work = 50;
  MomentumGuard guard(initial, 100, 0.2, 1e-9);  // sqrt(2 100 50) = 100 N m s of the loads
  StepReport step;
  step.step = 50;
  try {
    guard.at_check({step, now, audit});
    ADD_FAILURE() << "not stopped";
  } catch (const base::BreakdownError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("drifted by 2.1 of the moments of the loads so far, bound 0.2"));
  }
}

TEST(MomentumGuard, DoesNotJudgeABodyAtRest) {
  scheme::Balance rest, now;
  MomentumGuard guard(rest, 0, 0.2, 1e-9);
  now.angular_momentum.z() = now.angular_scale = 1;  // of rounding, all of it drift
  const auto judge = [&](std::int64_t number, double kinetic) {
    now.kinetic = kinetic;
    StepReport step;
    step.step = number;
    guard.at_check({step, now, scheme::Audit{}});
  };
  EXPECT_NO_THROW(judge(50, 1e-10));
  EXPECT_NO_THROW(judge(69, 1));
  EXPECT_THROW(judge(70, 1), base::BreakdownError);
}

// Of a body in supports that is loaded slowly: its nodes have hardly a momentum.
TEST(MomentumGuard, MeasuresAHeldBodyWithTheWorkOfItsLoadsToo) {
  for (const bool is_held : {false, true}) {
    const scheme::Balance initial;
    scheme::Balance now;
    now.kinetic = 1;
    now.strain = 1e6;  // of a state that was there before: no measure of what moves
    scheme::Audit audit;
    audit.external_work = 100;
    now.angular_momentum.z() = now.angular_scale = 1;
    MomentumGuard guard(initial, is_held ? 1e-3 : 0, 0.2, 1e-9);
    StepReport step;
    const auto judge = [&](std::int64_t number, double time) {
      step.step = number;
      step.time = time;
      guard.at_check({step, now, audit});
    };
    EXPECT_THROW(judge(50, 0.01), base::BreakdownError) << is_held;
    if (is_held) {
      EXPECT_NO_THROW(judge(100, 0.06));
    } else {
      EXPECT_THROW(judge(100, 0.06), base::BreakdownError);
    }
  }
}

// Which comes to much where it has hardly begun to move: sqrt(2 I E) of the work E, here 10.
TEST(MomentumGuard, MeasuresAHeldBodyWithTheSpinThatTheWorkOfItsLoadsWouldGive) {
  const scheme::Balance initial;
  scheme::Balance now;
  now.kinetic = 1;
  now.angular_scale = 1;
  scheme::Audit audit;
  audit.external_work = 100;
  MomentumGuard guard(initial, 0.5, 0.2, 1e-9);
  StepReport step;
  step.step = 50;
  now.angular_momentum.z() = 1.9;
  EXPECT_NO_THROW(guard.at_check({step, now, audit}));
  audit.external_work = 90;  // the largest counts
  EXPECT_NO_THROW(guard.at_check({step, now, audit}));
  now.angular_momentum.z() = 2.1;
  EXPECT_THROW(guard.at_check({step, now, audit}), base::BreakdownError);
}

}  // namespace
}  // namespace diptych::run
