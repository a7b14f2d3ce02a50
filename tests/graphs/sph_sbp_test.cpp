/// What SPH that sums by parts adds to the identities of every graph (identities_test.cpp):
/// exactness for quadratics and, of the adjoint, for linear stresses, on lattices of any shape and
/// number of nodes; rows that are translates of each other; refusals.

#include "common/base/error.hpp"
#include "meshes/renumber.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"
#include "tests/graphs/sbp_checks.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;

sph::Options summing(double kappa) {
  sph::Options options;
  options.kappa = kappa;
  options.gradient = "sbp";
  return options;
}

meshes::Mesh block(CellType type, const std::array<int, 3>& cells) {
  return meshes::box(type, {-0.5, 0.1, 0}, {0.5, 1.3, is_flat(type) ? 0 : 0.8}, cells);
}

/// Edges that are neither equal nor at right angles.
meshes::Mesh sheared(const std::array<int, 3>& cells) {
  meshes::Mesh mesh = block(CellType::hexahedron, cells);
  const Mat3 map = (Mat3() << 1, 0.4, -0.2, 0, 1.5, 0.3, 0, 0, 0.7).finished();
  for (Vec3& X : mesh.nodes)
    X = map * X;
  return mesh;
}

using NamedGraphs = std::vector<std::pair<std::string, scheme::PairGraph>>;

NamedGraphs make_graphs() {
  NamedGraphs all;
  for (const double kappa : {1.2, 1.35, 1.6}) {
    const std::string name = " kappa " + std::to_string(kappa);
    all.emplace_back("cube" + name,
                     sph::build_graph(block(CellType::hexahedron, {8, 8, 8}), summing(kappa)));
    all.emplace_back("sheared" + name, sph::build_graph(sheared({7, 5, 9}), summing(kappa)));
    all.emplace_back("thin" + name, sph::build_graph(sheared({2, 3, 12}), summing(kappa)));
    all.emplace_back("small" + name, sph::build_graph(sheared({4, 4, 4}), summing(kappa)));
    all.emplace_back("plane" + name,
                     sph::build_graph(block(CellType::quadrilateral, {11, 6, 1}), summing(kappa)));
    all.emplace_back("strip" + name,
                     sph::build_graph(block(CellType::quadrilateral, {2, 20, 1}), summing(kappa)));
  }
  return all;
}

const NamedGraphs& graphs() {
  static const NamedGraphs all = make_graphs();
  return all;
}

TEST(SphSbp, IsExactForQuadraticsUpToTheBoundaryAndItsAdjointForLinearStresses) {
  for (const auto& [name, graph] : graphs()) {
    const scheme::GraphQuality quality = scheme::quality(graph);
    EXPECT_LE(quality.closure, 1e-13) << name;
    EXPECT_LE(gradient_error(graph, 1), 1e-12) << name;
    EXPECT_LE(gradient_error(graph, 2), 1e-11) << name;
    EXPECT_GE(gradient_error(graph, 3), 1e-6) << name;  // the boundary has order 2
    EXPECT_LE(divergence_error(graph), 1e-11) << name;
  }
}

/// What the closure and the exactness of rows and adjoint need of volumes and areas.
TEST(SphSbp, HasVolumesAndAreasThatAreExactForQuadratics) {
  for (const auto& [name, graph] : graphs()) {
    Mat3 of_volume = Mat3::Zero(), of_area = Mat3::Zero();
    double volume = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      EXPECT_GT(graph.Omega[a], 0) << name;
      volume += graph.Omega[a];
      // d(x_i^3)/dx_i = 3 x_i^2 and its flux
      for (int i = 0; i < graph.dimension; ++i) {
        of_volume(i, i) += 3 * graph.Omega[a] * graph.X[a][i] * graph.X[a][i];
        of_area(i, i) += graph.boundary_area[a][i] * std::pow(graph.X[a][i], 3);
      }
    }
    EXPECT_LE((of_volume - of_area).norm(), 1e-12 * of_volume.norm()) << name;
  }
}

TEST(SphSbp, IsTheWidestOrderInside) {
  const scheme::PairGraph graph =
      sph::build_graph(block(CellType::quadrilateral, {20, 20, 1}), summing(1.2));
  std::vector<Vec3> v(graph.X.size(), Vec3::Zero());
  for (size_t a = 0; a < v.size(); ++a)
    v[a][0] = std::pow(graph.X[a][0], 3) + graph.X[a][0] * std::pow(graph.X[a][1], 2);
  const std::int64_t middle = 10 * 21 + 10;
  const Vec3 X = graph.X[middle];
  const Mat3 G = gradient(graph, v, middle);
  EXPECT_NEAR(G(0, 0), 3 * X[0] * X[0] + X[1] * X[1], 1e-12);
  EXPECT_NEAR(G(0, 1), 2 * X[0] * X[1], 1e-12);
}

/// Near each end of a line three rows of their own, whatever the number of nodes.
TEST(SphSbp, HasRowsThatAreTranslatesOfEachOther) {
  for (const int n : {12, 20}) {
    const scheme::PairGraph graph =
        sph::build_graph(block(CellType::hexahedron, {n, n, n}), summing(1.2));
    EXPECT_EQ(graph.classes.rows.representative.size(), 7U * 7 * 7) << n;
  }
}

TEST(SphSbp, DoesNotDependOnTheNumberingOfTheMesh) {
  const meshes::Mesh mesh = block(CellType::hexahedron, {6, 7, 4});
  std::vector<std::int32_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const scheme::PairGraph graph = sph::build_graph(mesh, summing(1.2));
  const scheme::PairGraph other = sph::build_graph(meshes::renumbered(mesh, order), summing(1.2));
  ASSERT_EQ(graph.n_pairs(), other.n_pairs());
  const std::vector<Vec3> v = random_field(graph, 3);
  std::vector<Vec3> w(v.size());
  for (size_t b = 0; b < v.size(); ++b)
    w[b] = v[order[b]];
  for (size_t b = 0; b < v.size(); ++b) {
    const Mat3 G = gradient(graph, v, order[b]);
    EXPECT_LE((gradient(other, w, static_cast<std::int64_t>(b)) - G).norm(), 1e-11 * G.norm());
  }
}

/// Why only nearest neighbours dissipate.
TEST(SphSbp, DissipatesBetweenNearestNeighboursWhereItsSignIsNearlyKnown) {
  scheme::PairGraph graph = sph::build_graph(
      meshes::box(CellType::hexahedron, {0, 0, 0}, {6, 6, 6}, {6, 6, 6}), summing(1.2));
  const double nearest = least_dissipation(graph);
  graph.dissipation_metric.setZero();
  const double all = least_dissipation(graph);
  EXPECT_LT(all, -0.15);
  EXPECT_GT(nearest, -0.04);
  EXPECT_LT(nearest, 0);
}

// Areas of pairs are not all the same near the ends of lines.
TEST(SphSbp, LosesWithSlopesAlongLinesWhereItsSignIsNearlyKnown) {
  for (const int cells : {4, 6}) {
    const double side = cells;
    const scheme::PairGraph graph = sph::build_graph(
        meshes::box(CellType::hexahedron, {0, 0, 0}, {side, side, side}, {cells, cells, cells}),
        summing(1.2));
    EXPECT_GT(least_dissipation(graph, true), -0.002) << cells;
  }
}

std::string refusal(const meshes::Mesh& mesh, const sph::Options& options) {
  try {
    sph::build_graph(mesh, options);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SphSbp, SaysWhatItTakesAndWhatToUseInstead) {
  const meshes::Mesh cube = block(CellType::hexahedron, {6, 6, 6});
  EXPECT_EQ(refusal(cube, summing(1.2)), "accepted");
  EXPECT_THAT(refusal(cube, summing(0.75)), AllOf(HasSubstr("kappa = 0.75"), HasSubstr("1.2")));
  EXPECT_THAT(refusal(block(CellType::hexahedron, {1, 6, 6}), summing(1.2)),
              AllOf(HasSubstr("refine"), HasSubstr("corrected")));
}

}  // namespace
}  // namespace diptych::graphs
