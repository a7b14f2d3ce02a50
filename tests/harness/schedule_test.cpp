/// Time left of a command from runs whose cost follows the model.

#include "benchmarks/terminal/schedule.hpp"

#include <gtest/gtest.h>

namespace diptych::harness {
namespace {

/// Levels 0 to n - 1 of both methods, as `converge` runs them.
std::vector<PlannedRun> levels(int n, int dimension = 3) {
  std::vector<PlannedRun> runs;
  for (int level = 0; level < n; ++level) {
    runs.push_back({"sph", "sph", level, dimension});
    runs.push_back({"fvm", "fvm", level, dimension});
  }
  return runs;
}

TEST(Schedule, SaysNothingOfAMethodThatHasNotRun) {
  Schedule schedule(levels(3));
  EXPECT_EQ(schedule.n_runs(), 6u);
  EXPECT_EQ(schedule.current(), 0u);
  EXPECT_FALSE(schedule.seconds_left());
  EXPECT_FALSE(schedule.seconds_left(1, 2)) << "SPH is under way, of FVM nothing is known";
  schedule.finish(2);
  EXPECT_FALSE(schedule.seconds_left());
  EXPECT_TRUE(schedule.seconds_left(0.5, 1)) << "FVM is under way";
}

// 2 s and 1 s on level 0: 16 times as much on level 1, 256 on level 2
TEST(Schedule, KnowsNodesTimesSteps) {
  Schedule schedule(levels(3));
  schedule.finish(2);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(0.25, 1), 0.25 + 16 * (2 + 1) + 256 * (2 + 1));
  schedule.finish(1);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(), 272 * 3);
  Schedule plane(levels(2, 2));
  plane.finish(2);
  plane.finish(1);
  EXPECT_DOUBLE_EQ(*plane.seconds_left(), 8 * 3) << "nodes and steps of a plane";
}

// what is under way, and then the nearest level, is known better than level 0
TEST(Schedule, TakesTheNearestLevelThatIsKnown) {
  Schedule schedule(levels(3));
  schedule.finish(2);
  schedule.finish(1);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(10, 40), 10 + 16 * 1 + 16 * 40 + 256 * 1);
  schedule.finish(40);
  schedule.finish(20);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(), 16 * (40 + 20));
  schedule.finish(700);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(5, 300), 5) << "the last run";
  schedule.finish(300);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(), 0);
}

// repetitions of one run: their mean; a variant that has not run: the others of its method
TEST(Schedule, JudgesAVariantByTheOthersOfItsMethod) {
  Schedule schedule({{"sph a", "sph", 0, 2},
                     {"sph a", "sph", 0, 2},
                     {"sph b", "sph", 1, 2},
                     {"sph a", "sph", 1, 2}});
  schedule.finish(1);
  schedule.finish(3);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(), 2 * 8 * 2);
  schedule.finish(100);
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(), 2 * 8) << "its own kind first, if on another level";
}

TEST(Schedule, LearnsNothingFromARunThatBrokeDown) {
  Schedule schedule(levels(2));
  schedule.finish(std::nullopt);
  schedule.finish(1);
  EXPECT_EQ(schedule.current(), 2u);
  EXPECT_FALSE(schedule.seconds_left());
  EXPECT_DOUBLE_EQ(*schedule.seconds_left(3, 4), 3 + 16);
}

}  // namespace
}  // namespace diptych::harness
