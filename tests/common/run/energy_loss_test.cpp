/// What numerical dissipation may take before a run is stopped.

#include "common/base/error.hpp"
#include "common/run/observers/energy_guard.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <limits>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The budget closes here, too; a body without energy is not judged, nor the first steps after.
TEST(EnergyGuard, StopsWhereNumericalDissipationHasTakenMoreThanItMay) {
  scheme::Balance initial, now;
  initial.kinetic = 10;
  const auto judge = [&](EnergyGuard& guard, std::int64_t number, double taken) {
    scheme::Audit audit;
    audit.numerical_dissipation = taken;
    now.kinetic = initial.kinetic - taken;
    StepReport step;
    step.step = number;
    guard.at_check({step, now, audit});
  };
  EnergyGuard guard(initial, 0.01, {0.5}, {1e-9}),
      free(initial, 0.01, {std::numeric_limits<double>::infinity()}, {1e-9});
  EXPECT_NO_THROW(judge(guard, 1, 4.9));
  EXPECT_NO_THROW(judge(free, 2, 9.9));
  try {
    judge(guard, 2, 5.1);
    ADD_FAILURE() << "not stopped";
  } catch (const base::BreakdownError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("numerical dissipation has taken 0.51 of the largest energy so "
                                "far, bound 0.5, step 2, "),
                      HasSubstr("--level"), HasSubstr("scheme.limiter"),
                      HasSubstr("guards.numerical_dissipation")));
  }
}

// A disc that its surface squeezes by 60 J held 2e-8 J of unresolved motion at first, and lost it.
TEST(EnergyGuard, DoesNotJudgeLossesBeforeLoadsHaveActed) {
  scheme::Balance initial, now;
  initial.kinetic = 1;
  now.kinetic = 0.2;
  EnergyGuard guard(initial, 0.01, {0.5, 2.0}, {1e-9});
  const auto judge = [&](std::int64_t number, double time) {
    scheme::Audit audit;
    audit.numerical_dissipation = 0.8;
    StepReport step;
    step.step = number;
    step.time = time;
    guard.at_check({step, now, audit});
  };
  EXPECT_NO_THROW(judge(100, 1.9));
  EXPECT_THROW(judge(150, 2.0), base::BreakdownError);
}

// At strains of 1e-7 strain energy is rounding, while velocities have all their digits.
TEST(EnergyGuard, JudgesLossesOfAMotionTooSmallForItsStrainEnergy) {
  scheme::Balance initial, now;
  StepReport step;
  step.step = 100;
  const auto judge = [&](double size, double lost) {
    initial.kinetic = size;
    now.kinetic = size * (1 - lost);
    scheme::Audit audit;
    audit.numerical_dissipation = size * lost;
    EnergyGuard(initial, 0.01, {0.5}, {1e-9}).at_check({step, now, audit});
  };
  EXPECT_NO_THROW(judge(1e-12, 0.49));
  EXPECT_THROW(judge(1e-12, 0.51), base::BreakdownError);
  EXPECT_NO_THROW(judge(1e-20, 0.9)) << "what rounding makes of velocities";
}

TEST(EnergyGuard, DoesNotJudgeLossesInTheFirstStepsOfABodyAtRest) {
  const scheme::Balance rest;
  EnergyGuard guard(rest, 0.01, {0.5}, {1e-9});
  const auto judge = [&](std::int64_t number, double work, double taken) {
    scheme::Balance now;
    now.kinetic = work - taken;
    scheme::Audit audit;
    audit.external_work = work;
    audit.numerical_dissipation = taken;
    StepReport step;
    step.step = number;
    guard.at_check({step, now, audit});
  };
  judge(0, 0, 0);
  EXPECT_NO_THROW(judge(EnergyGuard::steps_of_any_loss - 1, 1, 0.8));
  EXPECT_THROW(judge(EnergyGuard::steps_of_any_loss, 1, 0.8), base::BreakdownError);
}

}  // namespace
}  // namespace diptych::run
