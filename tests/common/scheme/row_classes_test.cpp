#include "common/scheme/graph/classify_rows.hpp"
#include "common/scheme/graph/sweep_graph.hpp"
#include "meshes/renumber.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace diptych::scheme {
namespace {

meshes::Mesh cube(int n) {
  return meshes::box(meshes::CellType::hexahedron, {0, 0, 0}, {0.3, 0.3, 0.3}, {n, n, n});
}

/// Corner, edge, face and middle, on each side: 3^3 kinds of rows whatever the size.
TEST(RowClasses, FiniteVolumesOnABoxHaveTwentySeven) {
  for (const int n : {4, 7}) {
    const RowClasses classes = classify_rows(tests::graph_of("fvm", cube(n)));
    EXPECT_EQ(classes.rows.representative.size(), 27U);
  }
}

TEST(RowClasses, DisorderLeavesEveryInnerRowItsOwn) {
  meshes::Mesh mesh = cube(6);
  meshes::perturb_interior(mesh, 0.2, 1);
  const PairGraph graph = tests::graph_of("fvm", mesh);
  const RowClasses classes = classify_rows(graph);
  EXPECT_GE(classes.rows.representative.size(), 125U);  // 5^3 nodes are moved
}

/// What stands for a row is the row up to rounding.
TEST(RowClasses, KeepTheGeometry) {
  for (const std::string method : {"sph", "fvm"}) {
    const PairGraph graph = tests::graph_of(method, cube(6));
    const RowClasses classes = classify_rows(graph);
    double largest = 0, change = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const std::int64_t b = classes.rows.representative[classes.rows.of[a]];
      ASSERT_EQ(graph.row[a + 1] - graph.row[a], graph.row[b + 1] - graph.row[b]);
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        largest = std::max(largest, graph.C[p].norm());
        change = std::max(change, (shared_C(graph, classes, a, p) - graph.C[p]).norm());
      }
    }
    EXPECT_LE(change, 2e-12 * largest) << method;
  }
}

/// Numbered at random, a lattice has the same classes, and its rows the same common order.
TEST(RowClasses, AreThoseOfEveryNumbering) {
  const meshes::Mesh mesh = cube(6);
  std::vector<std::int32_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for (const std::string method : {"sph", "fvm"}) {
    const PairGraph natural = tests::graph_of(method, mesh);
    const PairGraph shuffled = tests::graph_of(method, meshes::renumbered(mesh, order));
    const RowClasses classes = classify_rows(natural), same = classify_rows(shuffled);
    EXPECT_TRUE(classes.order.empty()) << method;
    EXPECT_EQ(same.rows.representative.size(), classes.rows.representative.size()) << method;
    EXPECT_EQ(group_by_neighbours(shuffled, same, false).representative.size(),
              group_by_neighbours(natural, classes, false).representative.size())
        << method;
    EXPECT_GT(group_by_neighbours(shuffled, same, true).representative.size(), 300U) << method;
    for (std::int64_t a = 0; a < shuffled.n_nodes(); ++a) {
      for (std::int64_t k = 0; k < shuffled.row[a + 1] - shuffled.row[a]; ++k)
        ASSERT_EQ(same.place_of(shuffled.row[a], same.pair(shuffled.row[a], k)), k);
    }
  }
}

/// Five kinds of places along a side, by how far the boundary is: those next to it too.
TEST(RowClasses, NeighboursTellThePlacesNextToTheBoundaryApart) {
  const PairGraph graph = tests::graph_of("fvm", cube(7));
  const RowClasses classes = classify_rows(graph);
  for (const bool numbering : {false, true})
    EXPECT_EQ(group_by_neighbours(graph, classes, numbering).representative.size(), 125U);
}

TEST(SweepGraph, GeometryOfALatticeStandsOnce) {
  const PairGraph graph = tests::graph_of("fvm", cube(7));
  const SweepGraph<3> rows(graph, Arrangement::rows);
  EXPECT_EQ(rows.strain.size(), 27);
  EXPECT_EQ(rows.neighbours.size(), 512);
  const SweepGraph<3> runs(graph, Arrangement::runs);
  EXPECT_LE(runs.strain.size(), 9 * 7);  // rows of eight nodes: by the side of y and z alone
  EXPECT_EQ(runs.offset.size(), runs.row[64]);
}

/// Boxes of all elements have runs, disorder of the nodes or not; another numbering has not.
TEST(SweepGraph, ArrangementFollowsTheNumbering) {
  for (const auto type : {meshes::CellType::hexahedron, meshes::CellType::tetrahedron}) {
    meshes::Mesh mesh = meshes::box(type, {0, 0, 0}, {1, 1, 1}, {9, 9, 9});
    meshes::perturb_interior(mesh, 0.1, 1);
    for (const std::string method : {"sph", "fvm"}) {
      EXPECT_EQ(SweepGraph<3>(tests::graph_of(method, mesh)).shape.arrangement, Arrangement::runs)
          << method;
    }
    const meshes::Mesh other = meshes::renumbered(mesh, meshes::rcm_order(mesh));
    EXPECT_EQ(SweepGraph<3>(tests::graph_of("fvm", other)).shape.arrangement, Arrangement::rows);
  }
}

}  // namespace
}  // namespace diptych::scheme
