/// What is made of the answers of ranks about their cells.

#include "benchmarks/run/surveys.hpp"

#include "benchmarks/run/cell_survey.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych::harness {
namespace {

/// As CellSurvey answers. @param folded  cells with a corner inside out, -1: none
std::vector<double> answer_of(
    double J, int n_inverted, int cell, double steps_left, int folded = -1) {
  const double n_folded = folded < 0 ? 0 : 2;
  return {J,
          static_cast<double>(n_inverted),
          static_cast<double>(cell),
          10.0 * cell,
          1,
          2,
          3,
          steps_left,
          n_folded,
          static_cast<double>(folded),
          1.0 * folded,
          5,
          6};
}

TEST(OutlookOfRanks, IsThatOfTheLeastCell) {
  const auto all = outlook_of({answer_of(0.5, 0, 7, 40), {}, answer_of(-0.1, 2, 3, 9)}, 100);
  EXPECT_EQ(all.now.J, -0.1);
  EXPECT_EQ(all.now.node, 30);
  EXPECT_EQ(all.now.n_inverted, 2);
  EXPECT_EQ(all.now.n_cells, 100);
  EXPECT_EQ(all.now.centre, algebra::Vec3(1, 2, 3));
  EXPECT_EQ(all.steps_left, 9);
}

TEST(OutlookOfRanks, DoesNotHangOnTheirOrder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto first = answer_of(0.5, 1, 3, 40), second = answer_of(0.5, 2, 7, 9),
             bad = answer_of(nan, 1, 9, 80);
  for (const run::Answers& answers : {run::Answers{first, second}, run::Answers{second, first}}) {
    EXPECT_EQ(outlook_of(answers, 10).now.node, 30) << "of the same J the first cell";
    EXPECT_EQ(outlook_of(answers, 10).now.n_inverted, 3);
  }
  for (const run::Answers& answers : {run::Answers{first, bad}, run::Answers{bad, first}}) {
    EXPECT_TRUE(std::isnan(outlook_of(answers, 10).now.J));
    EXPECT_EQ(outlook_of(answers, 10).now.node, 90);
  }
}

TEST(OutlookOfRanks, TellsOfTheFirstCellThatIsFolded) {
  const auto sound = answer_of(0.1, 0, 1, 40), fold = answer_of(0.5, 0, 7, 40, 20),
             other = answer_of(0.4, 0, 3, 9, 12);
  EXPECT_EQ(outlook_of({sound}, 100).now.n_folded, 0);
  for (const run::Answers& answers :
       {run::Answers{sound, fold, {}, other}, run::Answers{other, fold, sound}}) {
    const run::LeastCell now = outlook_of(answers, 100).now;
    EXPECT_EQ(now.n_folded, 4);
    EXPECT_EQ(now.folded, algebra::Vec3(12, 5, 6));
    EXPECT_EQ(now.J, 0.1) << "the least cell is another one";
  }
}

TEST(CellSurvey, SeesTheLeastCellOfABody) {
  const tests::Scene scene = tests::scene_of("fvm", R"toml([mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [8, 8]
[material]
model = "neo-hookean"
density = 1
youngs_modulus = 1
poissons_ratio = 0.3
[initial]
velocity = ["-x^2", 0]
[time]
end = 0.1
)toml");
  tests::run_to(*scene.solver, 0.02);
  CellSurvey survey(scene.mesh.mesh, *scene.solver);
  const double dt = 0.01;
  const auto seen = outlook_of({survey.answer(*scene.solver, {&dt, 1})}, scene.mesh.mesh.n_cells());
  EXPECT_EQ(seen.now.n_inverted, 0);
  EXPECT_NEAR(seen.now.J, 1 - 2 * 0.02, 0.01);
  EXPECT_GT(seen.now.centre[0], 0.8) << "where it is pressed most";
  EXPECT_NEAR(seen.steps_left, seen.now.J / (2 * dt), 0.2 * seen.steps_left);
}

}  // namespace
}  // namespace diptych::harness
