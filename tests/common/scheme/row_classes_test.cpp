#include "common/scheme/row_classes.hpp"

#include "common/scheme/sweep_graph.hpp"
#include "meshes/perturbation.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

namespace diptych::scheme {
namespace {

meshes::Mesh cube(int n) {
  return meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {0.3, 0.3, 0.3}, {n, n, n});
}

/// Corner, edge, face and middle, on each side: 3^3 kinds of rows whatever the size.
TEST(RowClasses, FiniteVolumesOnABoxHaveTwentySeven) {
  for (const int n : {4, 7}) {
    const RowClasses classes = classify_rows(tests::graph_of("fvm", cube(n)));
    EXPECT_EQ(classes.representative.size(), 27U);
  }
}

TEST(RowClasses, DisorderLeavesEveryInnerRowItsOwn) {
  meshes::Mesh mesh = cube(6);
  meshes::perturb_interior(mesh, 0.2, 1);
  const PairGraph graph = tests::graph_of("fvm", mesh);
  const RowClasses classes = classify_rows(graph);
  EXPECT_GE(classes.representative.size(), 125U);  // 5^3 nodes are moved
}

/// What stands for a row is the row up to rounding, and the same numbers on both sides of a pair.
TEST(RowClasses, KeepTheGeometry) {
  for (const std::string method : {"sph", "fvm"}) {
    const PairGraph graph = tests::graph_of(method, cube(6));
    const RowClasses classes = classify_rows(graph);
    double largest = 0, change = 0;
    for (size_t p = 0; p < graph.C.size(); ++p) {
      largest = std::max(largest, graph.C[p].norm());
      change = std::max(change, (classes.C[p] - graph.C[p]).norm());
    }
    EXPECT_LE(change, 2e-12 * largest) << method;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const std::int64_t b = classes.representative[classes.of_row[a]];
      ASSERT_EQ(graph.row[a + 1] - graph.row[a], graph.row[b + 1] - graph.row[b]);
      for (std::int64_t k = 0; k < graph.row[a + 1] - graph.row[a]; ++k) {
        const std::int64_t p = classes.order[graph.row[a] + k], q = classes.order[graph.row[b] + k];
        ASSERT_EQ(classes.C[p], classes.C[q]);
        ASSERT_EQ(classes.C[graph.reverse[p]], classes.C[graph.reverse[q]]);
      }
    }
  }
}

TEST(RowClasses, GeometryOfALatticeStandsOnce) {
  const SweepGraph<3> sweep(tests::graph_of("fvm", cube(7)));
  EXPECT_EQ(sweep.strain.size(), 27);
  EXPECT_EQ(sweep.neighbours.size(), 512);
}

}  // namespace
}  // namespace diptych::scheme
