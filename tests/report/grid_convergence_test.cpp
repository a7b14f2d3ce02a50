/// Grid convergence index against values worked out by hand and against the example of Celik et al.

#include "postprocess/report/grid_convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::report {
namespace {

TEST(GridConvergence, MatchesTheExampleOfCelik) {
  // J. Fluids Eng. 130, 078001, table 1, first column: p 1.53, 6.1685, index 2.2 %
  const double cells[3] = {18000, 8000, 4500};
  const double h[3] = {std::sqrt(1 / cells[0]), std::sqrt(1 / cells[1]), std::sqrt(1 / cells[2])};
  const GridConvergence g = grid_convergence(h, {6.063, 5.972, 5.863});
  EXPECT_EQ(g.kind, Convergence::monotone);
  EXPECT_NEAR(g.order, 1.53, 0.005);
  EXPECT_NEAR(g.extrapolated, 6.1685, 5e-4);
  EXPECT_NEAR(g.index, 0.022, 5e-4);
}

TEST(GridConvergence, FindsThePowerLawBehindThreeValues) {
  // f = 3 + 2 h^1.5: bar = 1.25 |2 h^1.5| at the fine grid
  const double h[3] = {0.1, 0.2, 0.35};
  const auto f = [](double x) { return 3 + 2 * std::pow(x, 1.5); };
  const GridConvergence g = grid_convergence(h, {f(h[0]), f(h[1]), f(h[2])});
  EXPECT_NEAR(g.order, 1.5, 1e-10);
  EXPECT_NEAR(g.extrapolated, 3, 1e-12);
  EXPECT_NEAR(g.error_bar, 1.25 * 2 * std::pow(0.1, 1.5), 1e-12);
  EXPECT_NEAR(g.index, g.error_bar / f(0.1), 1e-15);
}

TEST(GridConvergence, TrustsNoOrderAboveTheFormalOne) {
  // 1, 1.01, 1.17: order 4, but the bar is that of order 2: 1.25 * 0.01/3
  const GridConvergence g = grid_convergence({1, 2, 4}, {1, 1.01, 1.17});
  EXPECT_NEAR(g.order, 4, 1e-12);
  EXPECT_NEAR(g.extrapolated, 1 - 0.01 / 15, 1e-14);
  EXPECT_NEAR(g.error_bar, 1.25 * 0.01 / 3, 1e-14);
}

TEST(GridConvergence, GivesNoOrderWhereThereIsNone) {
  const GridConvergence to_and_fro = grid_convergence({1, 2, 4}, {1, 1.2, 1.1});
  EXPECT_EQ(to_and_fro.kind, Convergence::oscillating);
  EXPECT_TRUE(std::isnan(to_and_fro.order));
  EXPECT_TRUE(std::isnan(to_and_fro.extrapolated));
  EXPECT_NEAR(to_and_fro.error_bar, 0.6, 1e-14);
  const GridConvergence apart = grid_convergence({1, 2, 4}, {1.3, 1.1, 1});
  EXPECT_EQ(apart.kind, Convergence::diverging);
  EXPECT_NEAR(apart.error_bar, 0.9, 1e-14);
  EXPECT_EQ(grid_convergence({1, 2, 4}, {1.3, 1, 1}).kind, Convergence::diverging);
}

TEST(GridConvergence, KnowsValuesThatTheGridDoesNotTouch) {
  const GridConvergence g = grid_convergence({1, 2, 4}, {5, 5 + 1e-15, 5});
  EXPECT_EQ(g.kind, Convergence::same);
  EXPECT_EQ(g.extrapolated, 5);
  const GridConvergence zero = grid_convergence({1, 2, 4}, {0, 0, 0});
  EXPECT_EQ(zero.kind, Convergence::same);
  EXPECT_EQ(zero.error_bar, 0);
  EXPECT_TRUE(std::isnan(zero.index));
}

TEST(GridConvergence, AssumesTheFormalOrderOnTwoGrids) {
  EXPECT_NEAR(two_grid_error_bar({1, 2}, {10, 10.3}), 0.3, 1e-14);
}

}  // namespace
}  // namespace diptych::report
