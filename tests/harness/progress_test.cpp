/// The line of progress at every width.

#include "benchmarks/terminal/progress.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

ProgressState state() {
  ProgressState s;
  s.label = "sph level 2";
  s.run = 13;
  s.n_runs = 36;
  s.time = 0.1353;
  s.end_time = 0.3;
  s.step = 123456;
  s.dt = 2.3456e-5;
  s.energy_residual = 1.2e-5;
  s.seconds_left = 200;
  s.command_seconds_left = 7500;
  return s;
}

TEST(ProgressLine, OfALogHasEverything) {
  EXPECT_EQ(progress_line(state(), 0),
            "sph level 2, run 13 of 36   45 %  step 123456  dt 2.35e-05 s  t 0.1353 of 0.3 s  "
            "3 min 20 s left, all runs 2 h 5 min  energy residual 1.2e-05");
}

TEST(ProgressLine, CountsRejectedStepsWhereThereAreSuch) {
  ProgressState s = state();
  s.rejected = 7;
  EXPECT_THAT(progress_line(s, 0), HasSubstr("  step 123456, 7 rejected  dt 2.35e-05 s"));
  EXPECT_THAT(progress_line(s, 99), Not(HasSubstr("rejected"))) << "goes with the step";
}

TEST(ProgressLine, FitsTheTerminal) {
  for (size_t width = 20; width <= 200; ++width)
    EXPECT_LE(progress_line(state(), width).size(), width);
  // the time of the scene, what is left and, at 100 columns, the number of the run stay
  EXPECT_EQ(progress_line(state(), 99),
            "sph level 2, run 13 of 36   45 %  t 0.1353 of 0.3 s  3 min 20 s left, all runs "
            "2 h 5 min");
  EXPECT_EQ(progress_line(state(), 79),
            "sph level 2   45 %  t 0.1353 of 0.3 s  3 min 20 s left, all runs 2 h 5 min");
}

TEST(ProgressLine, OfASingleRunHasNoNumber) {
  ProgressState s = state();
  s.n_runs = 1;
  s.command_seconds_left.reset();
  EXPECT_EQ(progress_line(s, 99),
            "sph level 2   45 %  step 123456  t 0.1353 of 0.3 s  3 min 20 s left  energy residual "
            "1.2e-05");
}

TEST(ProgressLine, BeforeEveryKindIsKnownSaysWhichRunItIs) {
  ProgressState s = state();
  s.command_seconds_left.reset();
  EXPECT_THAT(progress_line(s, 0), StartsWith("sph level 2, run 13 of 36 "));
  EXPECT_THAT(progress_line(s, 0), Not(HasSubstr("all runs")));
}

}  // namespace
}  // namespace diptych::harness
