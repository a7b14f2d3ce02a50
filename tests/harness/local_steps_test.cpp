/// Local steps of meshes whose levels are known.

#include "benchmarks/cost/local_steps.hpp"

#include "fvm/fvm_graph.hpp"
#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych::harness {
namespace {

/// A strip of squares whose cells along x are `shrunk` times as long beyond x = n/2.
scheme::PairGraph strip(int n, double shrunk) {
  auto mesh = meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1.0 * n, 4, 0}, {n, 4, 1});
  for (auto& X : mesh.nodes)
    if (X[0] > n / 2) X[0] = n / 2 + (X[0] - n / 2) * shrunk;
  return fvm::build_graph(mesh, {});
}

TEST(LocalSteps, SaveNothingWhereAllNodesAreAlike) {
  const LocalSteps steps = local_steps(strip(40, 1), 8);
  EXPECT_LT(steps.rate_ratio, 2);
  EXPECT_EQ(steps.shares.size(), 1u);
  EXPECT_EQ(steps.of_pairs, 1);
  EXPECT_EQ(steps.of_nodes, 1);
}

// Cells of 1 by 1 beside cells of 1/8 by 1: rates 2 and 9, which is two levels (4.5 = 2^2.17); the
// column between them, 9/16 wide, has 2.8, level 1. Of 41 columns 20 take the smallest step, 20
// four of them.
TEST(LocalSteps, KnowTheLevelsOfTwoSizes) {
  const LocalSteps steps = local_steps(strip(40, 0.125), 8);
  ASSERT_EQ(steps.shares.size(), 3u);
  EXPECT_NEAR(steps.shares[1], 1.0 / 41, 1e-12);
  EXPECT_NEAR(steps.shares[2], 20.0 / 41, 1e-12);
  EXPECT_NEAR(steps.of_nodes, 41 / (20 + 0.5 + 20 * 0.25), 1e-12);
  EXPECT_GT(steps.of_pairs, 1.5);
  EXPECT_LT(steps.of_pairs, steps.of_nodes);
  EXPECT_EQ(local_steps(strip(40, 0.125), 1).of_pairs, 1);
  EXPECT_NEAR(local_steps(strip(40, 0.125), 2).of_nodes, 41 / (20 + 21 * 0.5), 1e-12);
}

}  // namespace
}  // namespace diptych::harness
