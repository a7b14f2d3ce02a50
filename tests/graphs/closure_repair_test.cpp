#include "common/closure/closure_repair.hpp"

#include "common/closure/class_repair.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/minimal_residuals.hpp"
#include "common/scheme/graph/classify_rows.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

namespace diptych::graphs {
namespace {

using scheme::PairGraph;

PairGraph open_cloud(CellType type, int n, double fraction) {
  sph::Options options;
  options.closure = false;
  return sph::build_graph(test_box(type, n, fraction), options);
}

/// Weights of any symmetric kind.
std::vector<double> sizes(const PairGraph& graph) {
  std::vector<double> k(graph.C.size());
  for (size_t p = 0; p < k.size(); ++p)
    k[p] = graph.C[p].norm() + graph.C[graph.reverse(p)].norm();
  return k;
}

/// The same, one by one.
closure::PairWeight from(const std::vector<double>& k) {
  return [&k](std::int64_t, std::int64_t p) { return k[p]; };
}

/// The least change is a projection: a second repair of a graph that is closed, or of one moved
/// along the solution, changes nothing and leads to the same graph.
TEST(ClosureRepair, ByPairsIsAProjection) {
  const PairGraph open = open_cloud(CellType::hexahedron, 4, 0.2);
  const std::vector<double> k = sizes(open);
  PairGraph closed = open;
  closure::repair_closure_pairs(closed, k);
  PairGraph half = open;
  for (size_t p = 0; p < k.size(); ++p)
    half.C.each()[p] = 0.5 * (open.C[p] + closed.C[p]);
  closure::repair_closure_pairs(half, k);
  for (size_t p = 0; p < k.size(); ++p) {
    EXPECT_LE((half.C[p] - closed.C[p]).norm(), 1e-10 * closed.C[p].norm() + 1e-13);
  }
  EXPECT_EQ(closure::repair_closure_pairs(closed, k).iterations, 0);
}

/// Second differences along a ring, which see no constant, with a right side that has one: what
/// conjugate gradients take more and more of is left, and nothing else.
TEST(MinimalResiduals, AreThoseThatNoSolutionHasLess) {
  constexpr int n = 40;
  const closure::FieldOperator S = [](const closure::Field& in, closure::Field& out) {
    for (int a = 0; a < n; ++a)
      out[a] = 2 * in[a] - in[(a + 1) % n] - in[(a + n - 1) % n];
  };
  const closure::FieldOperator halved = [](const closure::Field& in, closure::Field& out) {
    for (int a = 0; a < n; ++a)
      out[a] = in[a] / 2;
  };
  const Vec3 constant(0.3, -0.1, 0);  // a third component that there is not
  closure::Field r(n), y;
  for (int a = 0; a < n; ++a)
    r[a] = constant + std::sin(0.1 * a * a) * Vec3(1, 2, 0);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& value : r)
    mean += value / n;
  const std::vector<double> unit(n, 1.0);
  const int steps = closure::minimal_residuals(S, halved, unit, {1e-12, 200, 60}, r, y);
  EXPECT_LE(steps, 200);
  closure::Field S_y(n);
  S(y, S_y);
  for (int a = 0; a < n; ++a)
    EXPECT_LE((r[a] - S_y[a] - mean).norm(), 1e-9) << a;
}

/// With the diagonal alone the steps grow fourfold from one row to the next.
TEST(ClosureRepair, TakesAsManyStepsOnFineGridsAsOnCoarse) {
  for (double fraction : {0.0, 0.2}) {
    for (int n : {8, 16, 32, 64}) {
      PairGraph graph = open_cloud(CellType::quadrilateral, n, fraction);
      const auto repair = closure::repair_closure_pairs(graph, sizes(graph));
      EXPECT_LT(repair.after, 1e-12) << n;
      EXPECT_LT(repair.iterations, 160) << n;
    }
  }
}

/// Rows of a lattice that are equal stay equal, as few as before; the change is hardly larger than
/// the least one.
TEST(ClosureRepair, ByClassesKeepsEqualRowsEqual) {
  for (CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const PairGraph open = open_cloud(type, is_flat(type) ? 30 : 17, 0);
    const std::vector<double> k = sizes(open);
    PairGraph by_classes = open, by_pairs = open;
    EXPECT_GT(quality(open).closure, 0.1);
    ASSERT_TRUE(closure::repair_closure_by_classes(by_classes, from(k))) << name_of(type);
    closure::repair_closure_pairs(by_pairs, k);
    EXPECT_LE(quality(by_classes).closure, 1e-13);
    EXPECT_LE(quality(by_classes).linear_exactness, 1e-13);
    const auto n_rows = [](const PairGraph& graph) {
      return scheme::classify_rows(graph).rows.representative.size();
    };
    EXPECT_LT(n_rows(by_classes), 0.4 * static_cast<double>(open.n_nodes()));
    EXPECT_GT(n_rows(by_pairs), 0.9 * static_cast<double>(open.n_nodes()));
    double change = 0, least = 0;
    for (size_t p = 0; p < k.size(); ++p) {
      change += (by_classes.C[p] - open.C[p]).squaredNorm() / k[p];
      least += (by_pairs.C[p] - open.C[p]).squaredNorm() / k[p];
    }
    EXPECT_GE(change, least);
    EXPECT_LE(change, 1.2 * least);
  }
}

TEST(ClosureRepair, ByClassesLeavesDisorderToTheRepairByPairs) {
  PairGraph graph = open_cloud(CellType::quadrilateral, 12, 0.2);
  const algebra::SharedVectors C = graph.C;
  const std::vector<double> k = sizes(graph);
  EXPECT_FALSE(closure::repair_closure_by_classes(graph, from(k)));
  EXPECT_EQ(graph.C, C);
}

/// A gap that no linear-exact change can close (its moment is not that of the volumes) is left and
/// told, not hidden.
TEST(ClosureRepair, TellsWhenTheClosureCannotBeReached) {
  PairGraph graph = open_cloud(CellType::quadrilateral, 6, 0.1);
  graph.boundary_area[0] *= 1.5;
  const auto repair = closure::repair_closure_pairs(graph, sizes(graph), {1e-13, 200});
  EXPECT_GT(repair.after, 1e-3);
  EXPECT_NEAR(repair.after, scheme::quality(graph).closure, 1e-12);
  EXPECT_LT(scheme::quality(graph).linear_exactness, 1e-12);
}

TEST(ClosureRepair, GivesTheSameBitsForEveryRun) {
  PairGraph first = open_cloud(CellType::hexahedron, 4, 0.2), second = first;
  closure::repair_closure_pairs(first, sizes(first));
  closure::repair_closure_pairs(second, sizes(second));
  EXPECT_EQ(first.C, second.C);
}

TEST(AffinePart, IsTakenOutWholeAndLeavesTheRest) {
  const PairGraph graph = open_cloud(CellType::hexahedron, 3, 0.2);
  const closure::AffinePart affine_part(graph.X);
  const Mat3 slope = Mat3::Random();
  closure::Field affine(graph.X.size()), field = random_field(graph, 8);
  for (size_t a = 0; a < affine.size(); ++a)
    affine[a] = Vec3(1, 2, 3) + slope * graph.X[a];
  affine_part.remove(field);
  closure::Field sum = field;
  for (size_t a = 0; a < sum.size(); ++a)
    sum[a] += affine[a];
  affine_part.remove(sum);
  for (size_t a = 0; a < sum.size(); ++a)
    EXPECT_NEAR((sum[a] - field[a]).norm(), 0, 1e-13);
}

}  // namespace
}  // namespace diptych::graphs
