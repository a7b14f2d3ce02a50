#include "common/run/sample_part.hpp"

#include "common/run/largest_rates.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/generators.hpp"
#include "sph/sph_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::run {
namespace {

using meshes::CellType;

meshes::Mesh cube(CellType type, int n) {
  return meshes::box(type, {0, 0, 0}, {1.0 * n, 1.0 * n, 1.0 * n}, {n, n, n});
}

constexpr ElasticRatios ratios{0.4};

struct Rates {
  double omega, d, limit;
};

Rates rates_of(const scheme::PairGraph& graph, const std::vector<double>& moves) {
  scheme::Body<3> body(graph, scheme::BodyOptions{});
  LargestRates<3> largest(body, 0, moves);
  return {largest.frequency(ratios), largest.dissipation(ratios.shear),
          largest.leapfrog_limit(0.4, ratios, 1)};
}

void expect_rates_of_whole(const scheme::PairGraph& graph, std::int64_t wanted) {
  const auto part = sample_part(graph, wanted);
  ASSERT_TRUE(part) << graph.classes.rows.representative.size() << " classes";
  EXPECT_LT(3 * part->graph.n_nodes(), graph.n_nodes());
  EXPECT_GT(std::count(part->moves.begin(), part->moves.end(), 1.0), 2000);
  const Rates whole = rates_of(graph, {}), sample = rates_of(part->graph, part->moves);
  EXPECT_NEAR(sample.omega, whole.omega, 0.01 * whole.omega);
  EXPECT_NEAR(sample.d, whole.d, 0.01 * whole.d);
  EXPECT_NEAR(sample.limit, whole.limit, 0.01 * whole.limit);
}

TEST(SamplePart, HasTheLargestRatesOfTheWhole) {
  expect_rates_of_whole(fvm::build_graph(cube(CellType::hexahedron, 30), {}), 5000);
  expect_rates_of_whole(fvm::build_graph(cube(CellType::tetrahedron, 30), {}), 5000);
  expect_rates_of_whole(sph::build_graph(cube(CellType::hexahedron, 35), {}), 10000);
}

// What moves has its whole row, so that its operator is a part of that of the whole.
TEST(SamplePart, HoldsTheNodesAtItsRim) {
  const auto graph = fvm::build_graph(cube(CellType::tetrahedron, 20), {});
  const auto part = sample_part(graph, 2700);
  ASSERT_TRUE(part);
  const scheme::PairGraph& sub = part->graph;
  EXPECT_EQ(std::ssize(part->moves), sub.n_nodes());
  for (std::int64_t a = 0; a < sub.n_nodes(); ++a) {
    if (part->moves[a] == 0) continue;
    algebra::Mat3 gradient = algebra::Mat3::Zero();  // of X, which rows that are cut miss
    for (std::int64_t p = sub.row[a]; p < sub.row[a + 1]; ++p)
      gradient += 0.5 / sub.Omega[a] * (sub.X[sub.neighbour[p]] - sub.X[a]) * sub.C[p].transpose();
    EXPECT_NEAR((gradient - algebra::Mat3::Identity()).norm(), 0, 1e-9) << a;
  }
}

TEST(SamplePart, IsNotTakenOfSmallBodiesNorOfThoseOfManyClasses) {
  EXPECT_FALSE(sample_part(fvm::build_graph(cube(CellType::hexahedron, 10), {})));
  auto graph = fvm::build_graph(cube(CellType::hexahedron, 20), {});
  EXPECT_FALSE(sample_part(graph, 200));  // 27 classes
  graph.classes = {};
  EXPECT_FALSE(sample_part(graph, 2000));  // whoever has not said its classes is no lattice
}

}  // namespace
}  // namespace diptych::run
