/// Operators that sum by parts on curved blocks, alone and glued: identities, exactness, order,
/// what D_ab takes, boundary groups, what is refused.

#include "common/base/error.hpp"
#include "fvm/block_metrics.hpp"
#include "fvm/fvm_graph.hpp"
#include "fvm/sbp_blocks_graph.hpp"
#include "meshes/renumber.hpp"
#include "tests/graphs/curved_meshes.hpp"
#include "tests/graphs/sbp_checks.hpp"

#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

scheme::PairGraph graph_of(const meshes::Mesh& mesh, int order = 4) {
  return fvm::sbp_blocks_graph(mesh, fvm::smooth_blocks(mesh), order);
}

std::vector<meshes::Mesh> scenes() {
  return {curved_block(9, 0), bent_l(8, 0),       ring(18, 5, 0),
          disc(9, 8),         curved_block(8, 7), bent_l(5, 4, bent_in_space),
          ring(14, 3, 5)};
}

TEST(SbpBlocks, AreExactForLinearFieldsAndClosed) {
  for (const int order : {2, 4}) {
    for (const meshes::Mesh& mesh : scenes()) {
      const scheme::PairGraph graph = graph_of(mesh, order);
      const scheme::GraphQuality quality = scheme::quality(graph);
      EXPECT_LE(quality.linear_exactness, 1e-12) << mesh.n_nodes() << " nodes";
      EXPECT_LE(quality.closure, 1e-12) << mesh.n_nodes() << " nodes";
      EXPECT_FALSE(graph.commutes);
    }
  }
}

TEST(SbpBlocks, KeepMomentumAndTheDualityOfForceAndRate) {
  for (const meshes::Mesh& mesh : scenes()) {
    const scheme::PairGraph graph = graph_of(mesh);
    const std::vector<Vec3> v = random_field(graph, 1);
    std::vector<Mat3> P(graph.X.size());
    for (Mat3& of_node : P)
      of_node = Mat3::Random();
    Vec3 sum = Vec3::Zero();
    double power = 0, stress_power = 0, scale = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Vec3 T = force(graph, P, a);
      sum += T;
      power += v[a].dot(T);
      stress_power += graph.Omega[a] * P[a].cwiseProduct(gradient(graph, v, a)).sum();
      scale += v[a].norm() * T.norm();
    }
    EXPECT_LE(sum.norm(), 1e-12 * scale);
    EXPECT_NEAR(power, -stress_power, 1e-12 * scale);
  }
}

/// Without repair: S_ab is Q_ij (M_a + M_b) H_t, and the rest is the same both ways.
TEST(SbpBlocks, AreTheSplitFormAndASymmetricPart) {
  const meshes::Mesh mesh = curved_block(9, 0);
  const scheme::PairGraph graph = graph_of(mesh);
  const meshes::LatticeBlock block = meshes::lattice_blocks(mesh)[0];
  const fvm::BlockMetrics metrics(mesh, block, 4);
  std::vector<std::int64_t> at(graph.X.size());
  for (std::int64_t p = 0; p < block.n_places(); ++p)
    at[block.node[p]] = p;
  for (std::int32_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const auto place = block.place(at[a]), other = block.place(at[b]);
      const int d = place[0] == other[0] ? 1 : 0;
      double Q_ij = 0;
      for (const auto& [j, Q] : metrics.along(d).row(place[d]))
        if (j == other[d]) Q_ij = Q;
      const Vec3 S = 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]),
                 R = 0.5 * (graph.C[p] + graph.C[graph.reverse(p)]);
      EXPECT_LE((S - Q_ij * (metrics.area(at[a], d) + metrics.area(at[b], d))).norm(), 1e-15);
      EXPECT_LE((R - Q_ij * (metrics.area(at[a], d) - metrics.area(at[b], d))).norm(), 1e-15);
    }
  }
}

/// Largest error of the gradient of a smooth field.
double smooth_error(const scheme::PairGraph& graph) {
  std::vector<Vec3> v;
  for (const Vec3& X : graph.X)
    v.emplace_back(std::sin(2 * X[0] + X[1] - X[2]), 0, 0);
  double worst = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const Vec3& X = graph.X[a];
    Vec3 exact = std::cos(2 * X[0] + X[1] - X[2]) * Vec3(2, 1, -1);
    if (graph.dimension == 2) exact[2] = 0;
    worst = std::max(worst, (gradient(graph, v, a).row(0).transpose() - exact).norm());
  }
  return worst;
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Rows at the ends of lines are of second order, glued ones too; volumes of order three and more.
TEST(SbpBlocks, AreOfSecondOrderAtTheirEnds) {
  EXPECT_GE(
      smooth_error(graph_of(curved_block(16, 0))) / smooth_error(graph_of(curved_block(32, 0))),
      3.6);
  EXPECT_GE(smooth_error(graph_of(bent_l(16, 0))) / smooth_error(graph_of(bent_l(32, 0))), 3.6);
  EXPECT_GE(smooth_error(graph_of(disc(16, 12))) / smooth_error(graph_of(disc(32, 24))), 3.6);
  EXPECT_GE(
      smooth_error(graph_of(curved_block(8, 8))) / smooth_error(graph_of(curved_block(16, 16))),
      3.4);
  const auto off = [](int n) {
    return std::abs(total(graph_of(disc(n, n)).Omega) - std::numbers::pi);
  };
  EXPECT_LE(off(16), 2e-4);
  EXPECT_GE(off(16) / off(32), 7.5);
}

/// Least eigenvalue of what the jumps of linear reconstructions take, in c over the least spacing.
double least_of(const meshes::Mesh& mesh) {
  const scheme::PairGraph graph = graph_of(mesh);
  double h = HUGE_VAL;
  for (std::int32_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
      h = std::min(h, (graph.X[graph.neighbour[p]] - graph.X[a]).norm());
  }
  return h * least_dissipation(graph);
}

/// Straight: -0.027 in the plane, -0.047 in space. Gluing costs nothing, bending twice that on few
/// cells. Lines of six nodes are apart: Q_14 > 0 there.
TEST(SbpBlocks, GiveBackLittleOfWhatDissipationTakes) {
  const auto straight = [](const Vec3& X) { return X; };
  const double box = least_of(mapped_box({0, 0, 0}, {1, 1, 0}, {8, 8, 0}, straight));
  EXPECT_GE(box, -0.035);
  EXPECT_GE(least_of(bent_l(8, 0, straight)), box);
  EXPECT_GE(least_of(disc(8, 8)), -0.05);
  EXPECT_GE(least_of(curved_block(8, 0)), -0.08);
  EXPECT_GE(least_of(curved_block(24, 0)), -0.05);
  EXPECT_GE(least_of(curved_block(8, 8)), -0.1);
  EXPECT_LE(least_of(curved_block(5, 0)), -0.2);
}

TEST(SbpBlocks, DoNotDependOnTheNumberingOfTheMesh) {
  for (const meshes::Mesh& mesh : {disc(8, 5), ring(12, 4, 0), bent_l(5, 4, bent_in_space)}) {
    std::vector<std::int32_t> order(mesh.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    const scheme::PairGraph graph = graph_of(mesh),
                            other = graph_of(meshes::renumbered(mesh, order));
    ASSERT_EQ(graph.n_pairs(), other.n_pairs());
    std::vector<Vec3> v = random_field(graph, 2), w(v.size());
    for (size_t b = 0; b < order.size(); ++b)
      w[b] = v[order[b]];
    for (size_t b = 0; b < order.size(); ++b) {
      const std::int32_t a = order[b];
      EXPECT_NEAR(graph.Omega[a], other.Omega[b], 1e-13 * graph.Omega[a]);
      const Mat3 own = gradient(graph, v, a), same = gradient(other, w, static_cast<int>(b));
      EXPECT_LE((own - same).norm(), 1e-10 * own.norm());  // the repair stops at 2e-13
    }
  }
}

TEST(SbpBlocks, GiveGroupsTheAreaOfTheirSides) {
  const meshes::Mesh mesh = curved_block(16, 0);
  const scheme::PairGraph graph = graph_of(mesh);
  ASSERT_EQ(graph.patches.size(), mesh.boundary_groups.size());
  Vec3 all = Vec3::Zero();
  std::vector<Vec3> left = graph.boundary_area;
  for (const auto& patch : graph.patches) {
    EXPECT_EQ(patch.nodes.size(), 17U) << patch.name;
    for (size_t i = 0; i < patch.nodes.size(); ++i) {
      all += patch.area[i];
      left[patch.nodes[i]] -= patch.area[i];
    }
  }
  EXPECT_LE(all.norm(), 1e-13);
  for (const Vec3& area : left)
    EXPECT_LE(area.norm(), 1e-15);
}

TEST(SbpBlocks, AreTakenWhereLinesAreSmooth) {
  const auto text = [](const meshes::Mesh& mesh, const char* stencil = "sbp") {
    return fvm::operators_on(mesh, {stencil, 4}).text;
  };
  EXPECT_EQ(text(curved_block(9, 0)), "sbp: one curved block, order 4 on lines of 10 nodes");
  EXPECT_EQ(
      text(ring(18, 5, 0)),
      "sbp: one curved block, order 4 on lines of 18 nodes, order 2 on lines of 6 nodes, some "
      "of them rings");
  EXPECT_EQ(text(bent_l(8, 0)), "sbp: 3 blocks glued at their nodes, order 4 on lines of 9 nodes");
  EXPECT_THAT(text(test_box(CellType::hexahedron, 6, 0.2)), HasSubstr("on the cells around"));
  EXPECT_EQ(text(bent_l(8, 0), "auto"), text(bent_l(8, 0)));
  EXPECT_THAT(text(curved_block(5, 0), "auto"), HasSubstr("edge stencil: curved lines of six"));
  const fvm::Options symmetric{"auto", 4, "", "", true};
  EXPECT_THAT(fvm::operators_on(curved_block(5, 0), symmetric).text, HasSubstr("sbp"));
  EXPECT_THAT(fvm::operators_on(bent_l(4, 0), {"sbp", 4}).notices,
              ElementsAre("order 2 instead of 4 on lines of 5 nodes, order 4 takes 8"));
  EXPECT_THAT(fvm::operators_on(ring(4, 8, 0), {"sbp", 4}).notices,
              ElementsAre("order 2 instead of 4 on rings of 4 nodes, order 4 takes 5"));
  EXPECT_THAT(fvm::operators_on(curved_block(16, 0), {"sbp", 6}).notices,
              ElementsAre(HasSubstr("order 4 instead of 6")));
  EXPECT_THAT(fvm::operators_on(curved_block(5, 0), {"sbp", 4}).notices,
              testing::Contains(HasSubstr("lines of six nodes")));
  EXPECT_THAT(fvm::operators_on(curved_block(5, 0), symmetric).notices,
              testing::Not(testing::Contains(HasSubstr("lines of six nodes"))));
  EXPECT_TRUE(fvm::operators_on(curved_block(8, 0), {"sbp", 4}).loses_sign);
}

// On which strips and plates bend too little.
TEST(SbpBlocks, AreLeftForCellsByDefaultWhereShortLinesAreUneven) {
  const auto strip = [](int across, double ratio) {  // of neighbouring cells
    return mapped_box({0, 0, 0}, {2, 1, 0}, {20, across, 0}, [=](const Vec3& X) {
      const double all = std::pow(ratio, across) - 1;
      return Vec3(X[0], 0.2 * (std::pow(ratio, across * X[1]) - 1) / all * (1 + 1e-3 * X[0]), 0);
    });
  };
  const auto chosen = [](const meshes::Mesh& mesh, const char* stencil = "auto") {
    return fvm::operators_on(mesh, {stencil, 4, "", "", true});
  };
  EXPECT_NEAR(fvm::unevenness_of_short_lines(strip(2, 1.3), fvm::smooth_blocks(strip(2, 1.3))), 1.3,
              1e-3);
  for (const int across : {2, 3, 6}) {
    EXPECT_THAT(chosen(strip(across, 1.2)).text, HasSubstr("on the cells around"));
    EXPECT_THAT(chosen(strip(across, 1.2)).notices, ElementsAre(HasSubstr("uneven")));
    EXPECT_THAT(chosen(strip(across, 1.05)).text, HasSubstr("one curved block"));
    EXPECT_THAT(chosen(strip(across, 1.2), "sbp").text, HasSubstr("one curved block"));
  }
  EXPECT_THAT(chosen(strip(8, 1.2)).text, HasSubstr("one curved block"));
  const scheme::Operators refused = chosen(strip(2, 2));  // by those over cells
  EXPECT_THAT(refused.text, HasSubstr("one curved block"));
  EXPECT_THAT(refused.notices, testing::Contains(HasSubstr("do not go with this mesh")));
}

// An O-grid twists by a fifth to a fourth too little.
TEST(SbpBlocks, AreLeftForCellsByDefaultWhereLinesHaveTwoNodes) {
  const auto chosen = [](const meshes::Mesh& mesh) {
    return fvm::operators_on(mesh, {"auto", 4, "", "", true});
  };
  EXPECT_THAT(chosen(disc(3, 1)).text, HasSubstr("on the cells around"));
  EXPECT_THAT(chosen(disc(3, 1)).notices, ElementsAre(HasSubstr("two nodes")));
  EXPECT_THAT(chosen(disc(3, 2)).text, HasSubstr("5 blocks glued"));
  const scheme::Operators of_arch = chosen(ring(18, 1, 0));  // which those over cells refuse
  EXPECT_THAT(of_arch.text, HasSubstr("one curved block"));
  EXPECT_THAT(of_arch.notices, testing::Contains(HasSubstr("give these lines three nodes")));
}

TEST(SbpBlocks, RefuseLinesThatBendTooMuch) {
  const meshes::Mesh mesh = mapped_box({0, 0, 0}, {1, 1, 0}, {9, 9, 0}, [](const Vec3& X) {
    const double in = X[0] > 0.99 && X[1] > 0.99 ? 0.16 : 0;
    return Vec3(X[0] - in, X[1] + 0.6 * X[0] * X[0] - in, 0);
  });
  try {
    fvm::sbp_blocks_graph(mesh, meshes::lattice_blocks(mesh), 4);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bend too much for fvm.stencil = \"sbp\""));
  }
}

}  // namespace
}  // namespace diptych::graphs
