/// What SPH that sums by parts adds to the identities of every graph (identities_test.cpp):
/// exactness for quadratics and, of the adjoint, for linear stresses, on lattices of any shape and
/// number of nodes; rows that are translates of each other; refusals.

#include "common/base/error.hpp"
#include "common/scheme/graph/dissipation_area.hpp"
#include "meshes/renumber.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <Eigen/Dense>

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

/// Largest error of the gradient of a polynomial of this degree with random coefficients, over its
/// largest value.
double gradient_error(const scheme::PairGraph& graph, int degree) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  Vec3 direction(normal(engine), normal(engine), graph.dimension == 3 ? normal(engine) : 0);
  Vec3 other(normal(engine), normal(engine), graph.dimension == 3 ? normal(engine) : 0);
  std::vector<Vec3> v(graph.X.size(), Vec3::Zero());
  for (size_t a = 0; a < v.size(); ++a)
    v[a][0] = std::pow(direction.dot(graph.X[a]), degree - 1) * other.dot(graph.X[a]);
  double worst = 0, largest = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const double s = direction.dot(graph.X[a]), t = other.dot(graph.X[a]);
    Vec3 exact = std::pow(s, degree - 1) * other;
    if (degree > 1) exact += (degree - 1) * std::pow(s, degree - 2) * t * direction;
    largest = std::max(largest, exact.norm());
    worst = std::max(worst, (gradient(graph, v, a).row(0).transpose() - exact).norm());
  }
  return worst / largest;
}

/// Largest error of the force of a stress that is linear in X, over its divergence.
double divergence_error(const scheme::PairGraph& graph) {
  const Mat3 by[3] = {Mat3::Random(), Mat3::Random(),
                      graph.dimension == 3 ? Mat3(Mat3::Random()) : Mat3(Mat3::Zero())};
  std::vector<Mat3> P(graph.X.size());
  Vec3 divergence = Vec3::Zero();
  for (int i = 0; i < graph.dimension; ++i)
    divergence += by[i].col(i);
  for (size_t a = 0; a < P.size(); ++a) {
    P[a] = Mat3::Zero();
    for (int i = 0; i < 3; ++i)
      P[a] += graph.X[a][i] * by[i];
  }
  // 1/2 sum_b (P_a C_ab - P_b C_ba) is Omega_a Div P - P_a A_aN_a with the sign of (18a) turned
  double worst = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const Vec3 T = -force(graph, P, a) + P[a] * -graph.boundary_area[a];
    worst = std::max(worst, (-T - graph.Omega[a] * divergence).norm() / graph.Omega[a]);
  }
  return worst / divergence.norm();
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

/// Least eigenvalue, in c/h, of the symmetric part of what the jumps of linear reconstructions
/// dissipate (notes 4.4): with areas s_ab sum_b s_ab (v_b - v_a - 1/2 (G_a + G_b) X_ab)/Omega_a.
double least_dissipation(const scheme::PairGraph& graph) {
  const auto n = static_cast<int>(graph.n_nodes());
  Eigen::MatrixXd G[3], D = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::MatrixXd& by : G)
    by = Eigen::MatrixXd::Zero(n, n);
  for (int a = 0; a < n; ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      for (int i = 0; i < 3; ++i) {
        const double weight = 0.5 * graph.C[p][i] / graph.Omega[a];
        G[i](a, graph.neighbour[p]) += weight;
        G[i](a, a) -= weight;
      }
    }
  }
  for (int a = 0; a < n; ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const Vec3 X_ab = graph.X[b] - graph.X[a], S = 0.5 * (graph.C[p] - graph.C[graph.reverse[p]]);
      const double area = scheme::dissipation_area(S, X_ab, graph.dissipation_metric);
      D(a, a) += area;
      D(a, b) -= area;
      for (int i = 0; i < 3; ++i)
        D.row(a) += 0.5 * area * X_ab[i] * (G[i].row(a) + G[i].row(b));
    }
  }
  Eigen::VectorXd scale(n);
  for (int a = 0; a < n; ++a)
    scale[a] = 1 / std::sqrt(graph.Omega[a]);
  const Eigen::MatrixXd symmetric =
      0.5 * scale.asDiagonal() * (D + D.transpose()) * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
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
  EXPECT_THAT(refusal(test_box(CellType::tetrahedron, 3, 0), summing(1.2)),
              AllOf(HasSubstr("sph.gradient = \"sbp\""), HasSubstr("is a tetrahedron"),
                    HasSubstr("sph.gradient = \"corrected\"")));
  EXPECT_THAT(refusal(test_box(CellType::hexahedron, 5, 0.2), summing(1.2)),
              HasSubstr("of a spacing off"));
}

}  // namespace
}  // namespace diptych::graphs
