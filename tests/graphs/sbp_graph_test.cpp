/// What operators that sum by parts add to the identities of every graph (identities_test.cpp):
/// exactness for polynomials, derivatives that commute, areas of boundary groups, falling back.

#include "fvm/sbp_graph.hpp"

#include "common/base/error.hpp"
#include "common/scheme/graph/sweep_graph.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/renumber.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>
#include <set>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;

meshes::Mesh block(const std::array<int, 3>& cells) {
  return meshes::box(CellType::hexahedron, {-0.5, 0.1, 0}, {0.5, 1.3, 0.8}, cells);
}

/// Largest error of the gradient of x^k + y^k + z^k, relative to its size, at nodes that are
/// `inside` or not.
double gradient_error(const scheme::PairGraph& graph, int k, bool inside, int block_size, int n) {
  std::vector<Vec3> v(graph.X.size());
  for (size_t a = 0; a < v.size(); ++a)
    v[a] = Vec3(graph.X[a].array().pow(k).sum(), 0, 0);
  double worst = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const std::int64_t i = a % n, j = a / n % n, l = a / n / n;
    const auto is_in = [&](std::int64_t at) { return at >= block_size && at < n - block_size; };
    if (inside && !(is_in(i) && is_in(j) && is_in(l))) continue;
    const Vec3 exact = k * graph.X[a].array().pow(k - 1);
    worst = std::max(worst, (gradient(graph, v, a).row(0).transpose() - exact).norm());
  }
  return worst / k;
}

TEST(SbpGraph, IsExactForPolynomialsUpToTheOrderInsideAndHalfOfItAtTheBoundary) {
  const int n = 15;
  for (const auto& [order, size] : {std::pair{2, 1}, {4, 4}, {6, 6}}) {
    const scheme::PairGraph graph = fvm::sbp_graph(block({n - 1, n - 1, n - 1}), order);
    for (int k = 1; k <= order; ++k) {
      EXPECT_LE(gradient_error(graph, k, true, size, n), 1e-12) << order << " x^" << k;
      if (k <= order / 2) {
        EXPECT_LE(gradient_error(graph, k, false, size, n), 1e-12) << order << " x^" << k;
      }
    }
    EXPECT_GE(gradient_error(graph, order + 1, true, size, n), 1e-7);
    EXPECT_GE(gradient_error(graph, order / 2 + 1, false, size, n), 1e-5);
  }
}

TEST(SbpGraph, OfOrderTwoIsTheEdgeStencil) {
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const meshes::Mesh mesh = test_box(type, 5, 0);
    const scheme::PairGraph sbp = fvm::build_graph(mesh, {"sbp", 2});
    const scheme::PairGraph edge = fvm::build_graph(mesh, {"edge"});
    ASSERT_EQ(sbp.neighbour, edge.neighbour);
    for (size_t a = 0; a < sbp.X.size(); ++a) {
      EXPECT_NEAR(sbp.Omega[a], edge.Omega[a], 1e-15);
      EXPECT_NEAR((sbp.boundary_area[a] - edge.boundary_area[a]).norm(), 0, 1e-15);
    }
    for (size_t p = 0; p < sbp.C.size(); ++p)
      EXPECT_NEAR((sbp.C[p] - edge.C[p]).norm(), 0, 1e-15);
    ASSERT_EQ(sbp.patches.size(), edge.patches.size());
    for (size_t g = 0; g < sbp.patches.size(); ++g) {
      EXPECT_EQ(sbp.patches[g].name, edge.patches[g].name);
      ASSERT_EQ(sbp.patches[g].nodes, edge.patches[g].nodes);
      for (size_t i = 0; i < sbp.patches[g].area.size(); ++i)
        EXPECT_NEAR((sbp.patches[g].area[i] - edge.patches[g].area[i]).norm(), 0, 1e-15);
    }
  }
}

/// D_x D_y = D_y D_x in the interior and at the boundary: why det F stays a null Lagrangian.
TEST(SbpGraph, HasDerivativesThatCommute) {
  const scheme::PairGraph graph = fvm::sbp_graph(block({8, 12, 9}), 4);
  const std::vector<Vec3> v = random_field(graph, 3);
  std::vector<Vec3> by[3];
  for (auto& field : by)
    field.resize(v.size());
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const Mat3 G = gradient(graph, v, a);
    for (int i = 0; i < 3; ++i)
      by[i][a] = G.col(i);
  }
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const Mat3 of_x = gradient(graph, by[0], a), of_y = gradient(graph, by[1], a),
               of_z = gradient(graph, by[2], a);
    EXPECT_LE((of_x.col(1) - of_y.col(0)).norm(), 1e-12 * of_x.norm());
    EXPECT_LE((of_y.col(2) - of_z.col(1)).norm(), 1e-12 * of_y.norm());
  }
}

TEST(SbpGraph, DoesNotDependOnTheNumberingOfTheMesh) {
  const meshes::Mesh mesh = block({8, 9, 7});
  std::vector<std::int32_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const scheme::PairGraph graph = fvm::sbp_graph(mesh, 4);
  const scheme::PairGraph other = fvm::sbp_graph(meshes::renumbered(mesh, order), 4);
  ASSERT_EQ(graph.n_pairs(), other.n_pairs());
  // order[new] = old
  std::vector<std::int32_t> number(order.size());
  for (size_t b = 0; b < order.size(); ++b)
    number[order[b]] = static_cast<std::int32_t>(b);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const std::int64_t b = number[a];
    EXPECT_NEAR(graph.Omega[a], other.Omega[b], 1e-14 * graph.Omega[a]);
    const auto first = other.neighbour.begin() + other.row[b],
               last = other.neighbour.begin() + other.row[b + 1];
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const auto found = std::lower_bound(first, last, number[graph.neighbour[p]]);
      ASSERT_TRUE(found != last && *found == number[graph.neighbour[p]]);
      EXPECT_NEAR((graph.C[p] - other.C[found - other.neighbour.begin()]).norm(), 0, 1e-15);
    }
  }
}

/// Rows of a lattice are of 7 classes along each direction of order 4: the inside, and of each
/// block four, of which the second and third (Q_13 = 0, Q_20 = 1/12, Q_21 = -Q_23) are their own
/// mirror images. They share their geometry, in runs.
TEST(SbpGraph, HasRowsThatAreTranslatesOfEachOther) {
  const scheme::PairGraph graph = fvm::sbp_graph(block({20, 20, 20}), 4);
  EXPECT_EQ(graph.classes.rows.representative.size(), 7U * 7 * 7);
  EXPECT_TRUE(graph.classes.order.empty());
  const scheme::PairGraph flat =
      fvm::sbp_graph(meshes::box(CellType::quadrilateral, {0, 0, 0}, {4, 4, 0}, {80, 80, 1}), 4);
  EXPECT_EQ(flat.classes.rows.representative.size(), 49U);
  EXPECT_EQ(scheme::SweepGraph<2>(flat).shape.arrangement, scheme::Arrangement::runs);
}

TEST(SbpGraph, GivesWholeSidesTheirArea) {
  const scheme::PairGraph graph = fvm::sbp_graph(block({8, 9, 12}), 4);
  const std::map<std::string, Vec3> areas = {{"x_min", {-0.96, 0, 0}}, {"x_max", {0.96, 0, 0}},
                                             {"y_min", {0, -0.8, 0}},  {"y_max", {0, 0.8, 0}},
                                             {"z_min", {0, 0, -1.2}},  {"z_max", {0, 0, 1.2}}};
  ASSERT_EQ(graph.patches.size(), 6U);
  for (const auto& patch : graph.patches) {
    Vec3 sum = Vec3::Zero(), first = Vec3::Zero(), centre(0, 0.7, 0.4);
    for (size_t i = 0; i < patch.nodes.size(); ++i) {
      sum += patch.area[i];
      first += patch.area[i].norm() * (graph.X[patch.nodes[i]] - centre);
    }
    EXPECT_NEAR((sum - areas.at(patch.name)).norm(), 0, 1e-14) << patch.name;
    EXPECT_NEAR(first.cross(sum).norm(), 0, 1e-14) << patch.name;  // the load acts at the centre
  }
}

/// Boundary faces of x_min whose centre has y below a bound, as a group.
meshes::Mesh with_part(meshes::Mesh mesh, double most_y) {
  const meshes::BoundaryGroup side = mesh.group("x_min");
  meshes::BoundaryGroup part{"part", {}};
  for (const std::int32_t f : side.faces) {
    const auto& nodes = mesh.boundary_faces[f].nodes;
    if (0.5 * (mesh.nodes[nodes[0]][1] + mesh.nodes[nodes[2]][1]) < most_y) part.faces.push_back(f);
  }
  mesh.boundary_groups.push_back(part);
  return mesh;
}

TEST(SbpGraph, TakesPartsOfASideThatEndOutsideTheBlocks) {
  const scheme::PairGraph graph = fvm::sbp_graph(with_part(block({8, 12, 8}), 0.1 + 0.6), 4);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& area : graph.patches.back().area)
    sum += area;
  EXPECT_NEAR((sum - Vec3(-0.6 * 0.8, 0, 0)).norm(), 0, 1e-14);
  try {
    fvm::sbp_graph(with_part(block({8, 12, 8}), 0.1 + 0.2), 4);
    ADD_FAILURE() << "went through";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'part' ends within the first nodes"));
  }
}

/// Of two ends of a group what one has too much may be what the other misses, on one side or as
/// vectors on two: sums do not show it.
TEST(SbpGraph, LooksAtEachEndOfAGroup) {
  const auto group_of = [](const meshes::Mesh& mesh, const auto& is_in) {
    meshes::BoundaryGroup part{"part", {}};
    for (const char* side : {"x_min", "x_max"}) {
      for (const std::int32_t f : mesh.group(side).faces) {
        const auto& nodes = mesh.boundary_faces[f].nodes;
        const double y = 0.5 * (mesh.nodes[nodes[0]][1] + mesh.nodes[nodes[2]][1]) - 0.1;
        if (is_in(side == std::string("x_max"), std::lround(10 * y - 0.5))) part.faces.push_back(f);
      }
    }
    return part;
  };
  // rows of faces along y, of 12: weights 17/48, 59/48, 43/48, 49/48, 1
  const std::pair<const char*, std::function<bool(bool, long)>> unfit[] = {
      {"the first row of both sides", [](bool, long row) { return row == 0; }},
      {"one row at one end of a side, two at the other",
       [](bool is_far, long row) { return !is_far && (row < 1 || row > 9); }},
      {"what is left between them",
       [](bool is_far, long row) { return is_far && row > 0 && row < 10; }},
      {"a hole of one row", [](bool is_far, long row) { return is_far && row != 2; }}};
  for (const auto& [what, is_in] : unfit) {
    meshes::Mesh mesh = block({8, 12, 8});
    mesh.boundary_groups.push_back(group_of(mesh, is_in));
    EXPECT_THROW(fvm::sbp_graph(mesh, 4), base::InputError) << what;
    EXPECT_THAT(fvm::unsure_because(mesh, 4), HasSubstr("'part' ends within")) << what;
  }
  meshes::Mesh mesh = block({8, 12, 8});
  mesh.boundary_groups.push_back(
      group_of(mesh, [](bool is_far, long row) { return is_far ? row > 6 : row < 5; }));
  EXPECT_EQ(fvm::unsure_because(mesh, 4), "");
}

TEST(SbpGraph, FallsToTheWidestPairThatFitsAndSaysSo) {
  const meshes::Mesh mesh = block({12, 8, 1});
  const auto lines = fvm::sbp_lines(mesh, 6);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].order, 6);
  EXPECT_EQ(lines[1].order, 4);
  EXPECT_EQ(lines[2].order, 2);
  const scheme::Operators operators = fvm::operators_on(mesh, {"sbp", 6});
  EXPECT_EQ(operators.text,
            "sbp: order 6 on 13 nodes along (1, 0, 0), order 4 on 9 nodes along (0, 1, 0), order 2 "
            "on 2 nodes along (0, 0, 1)");
  ASSERT_EQ(operators.notices.size(), 2U);
  EXPECT_THAT(operators.notices[1],
              HasSubstr("order 2 instead of 6 along (0, 0, 1): its lines have 2 nodes"));
  EXPECT_TRUE(fvm::operators_on(mesh, {"edge"}).text.empty());
}

}  // namespace
}  // namespace diptych::graphs
