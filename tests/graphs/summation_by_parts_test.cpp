/// Operators that sum by parts on any nodes, of both methods: exactness for quadratics, of the
/// adjoint for linear stresses, volumes and areas, the identities of every graph, what the solve
/// takes, what is refused.

#include "common/closure/summation_by_parts.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/quadratic_measure.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/sbp_checks.hpp"

#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;

/// Of the adjoint, in units of its areas, where the solve stops.
constexpr double residual = closure::SummationLimits{}.residual;

struct Scene {
  std::string name;
  scheme::PairGraph graph;
};

scheme::PairGraph sph_graph(const meshes::Mesh& mesh, double kappa) {
  sph::Options options;
  options.kappa = kappa;
  options.gradient = "sbp";
  return sph::build_graph(mesh, options);
}

std::vector<Scene> make_scenes() {
  std::vector<Scene> all;
  for (const CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, is_flat(type) ? 10 : 5, 0.2);
    all.push_back({"sph " + name_of(type), sph_graph(mesh, 1.6)});
    all.push_back({"fvm " + name_of(type), fvm::build_graph(mesh, {"sbp"})});
  }
  for (const CellType type : {CellType::tetrahedron, CellType::hexahedron}) {
    meshes::Mesh plate = meshes::box(type, {0, 0, 0}, {1, 1, 0.4}, {5, 5, 2});
    meshes::perturb_interior(plate, 0.1, 11);
    all.push_back({"sph on a plate of " + name_of(type), sph_graph(plate, 1.6)});
    all.push_back({"fvm on a plate of " + name_of(type), fvm::build_graph(plate, {"sbp"})});
  }
  for (const CellType type : {CellType::triangle, CellType::tetrahedron}) {
    const meshes::Mesh mesh = bent_box(type, is_flat(type) ? 10 : 6, 0.2);
    all.push_back({"sph on a ring of " + name_of(type), sph_graph(mesh, 1.6)});
    all.push_back({"fvm on a ring of " + name_of(type), fvm::build_graph(mesh, {"sbp"})});
  }
  return all;
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = make_scenes();
  return all;
}

TEST(SummationByParts, IsExactForQuadraticsAndItsAdjointForLinearStresses) {
  for (const Scene& scene : scenes()) {
    const scheme::GraphQuality quality = scheme::quality(scene.graph);
    EXPECT_LE(quality.closure, 1e-12) << scene.name;
    EXPECT_LE(quality.linear_exactness, 1e-12) << scene.name;
    // the repair of the closure in the end leaves quadratics as exact as the adjoint
    EXPECT_LE(gradient_error(scene.graph, 2), 10 * residual) << scene.name;
    EXPECT_GE(gradient_error(scene.graph, 3), 1e-4) << scene.name;
    EXPECT_LE(divergence_error(scene.graph), 30 * residual) << scene.name;
  }
}

/// The edge stencil has neither.
TEST(SummationByParts, IsWhatOtherGraphsAreNot) {
  const scheme::PairGraph edge =
      fvm::build_graph(test_box(CellType::tetrahedron, 6, 0.2), {"edge"});
  EXPECT_GE(gradient_error(edge, 2), 0.02);
  EXPECT_GE(divergence_error(edge), 0.3);
}

TEST(SummationByParts, KeepsMomentumAndTheDualityOfForceAndRate) {
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    const std::vector<Vec3> v = random_field(graph, 1);
    std::vector<Mat3> P(graph.X.size());
    std::mt19937 engine(2);
    std::normal_distribution<double> normal;
    for (Mat3& of_node : P) {
      for (int i = 0; i < 9; ++i)
        of_node(i / 3, i % 3) = normal(engine);
    }
    Vec3 sum = Vec3::Zero();
    double work = 0, rate = 0, size = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Vec3 T = force(graph, P, a);
      sum += T;
      work += T.dot(v[a]);
      rate += graph.Omega[a] * P[a].cwiseProduct(gradient(graph, v, a)).sum();
      size += T.norm();
    }
    EXPECT_LE(sum.norm(), 1e-13 * size) << scene.name;
    EXPECT_NEAR(work, -rate, 1e-12 * size) << scene.name;
  }
}

TEST(SummationByParts, HasTheSameBitsForEveryNumberOfThreads) {
  const meshes::Mesh mesh = test_box(CellType::hexahedron, 7, 0.2);
  parallel::set_threads(1);
  const scheme::PairGraph one = sph_graph(mesh, 1.2);
  parallel::set_threads(3);
  const scheme::PairGraph three = sph_graph(mesh, 1.2);
  parallel::set_threads(0);
  EXPECT_EQ(one.Omega, three.Omega);
  EXPECT_TRUE(one.C == three.C);
}

/// What a graph of SPH without its closure becomes with weights exp(-(r/length)^2).
closure::SummationByParts sum_by_parts(const meshes::Mesh& mesh,
                                       double length,
                                       scheme::PairGraph& graph) {
  meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
  graph.Omega = measure.Omega;
  graph.boundary_area = measure.boundary_area;
  std::vector<double> k(graph.C.size());
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const double q = (graph.X[b] - graph.X[a]).norm() / length;
      k[p] = graph.Omega[a] * graph.Omega[b] * std::exp(-q * q);
    }
  }
  return closure::make_sum_by_parts(graph, k);
}

/// With the diagonal alone steps grow eightfold from one row to the next, with splines that leave
/// out the gradients fourfold.
TEST(SummationByParts, TakesFewIterations) {
  for (const auto& [n, most] : {std::pair(6, 95), {12, 105}, {15, 85}}) {
    const meshes::Mesh mesh = test_box(CellType::hexahedron, n, 0.2);
    sph::Options options;
    options.closure = false;
    scheme::PairGraph graph = sph::build_graph(mesh, options);
    const auto took = sum_by_parts(mesh, 1.0 / n, graph);
    EXPECT_GT(took.before, 0.1) << n;
    EXPECT_LE(took.after, residual) << n;
    EXPECT_LE(took.iterations, most) << n;
  }
}

/// Where few neighbours stand badly, weights, and with them the rates of the fastest waves, were up
/// to a hundred times those of other nodes. Supports grow there.
TEST(SummationByParts, WidensSupportsWhereRowsAreSteep) {
  meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  meshes::perturb_interior(mesh, 0.45, 2);
  const auto V = meshes::dual_measure(mesh, meshes::Quadrature::vertex).Omega;
  sph::Options options;
  options.kappa = 1.02;
  options.closure = false;
  scheme::PairGraph narrow = sph::build_graph(mesh, options);
  sum_by_parts(mesh, 1, narrow);
  EXPECT_FALSE(closure::steep_rows(narrow, V).empty());
  try {
    closure::require_no_steep_rows(narrow, V);
    ADD_FAILURE() << "was taken";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("times those of a lattice"));
  }
  const scheme::PairGraph wide = sph_graph(mesh, 1.02);
  EXPECT_TRUE(closure::steep_rows(wide, V).empty());
  EXPECT_GT(wide.n_pairs(), narrow.n_pairs());
}

/// As nearly as on lattices (sph_sbp_test.cpp), with all pairs whose area points forward.
TEST(SummationByParts, HasADissipationWhoseSignIsNearlyKnown) {
  meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {6, 6, 6}, {6, 6, 6});
  meshes::perturb_interior(mesh, 0.2, 3);
  EXPECT_GT(least_dissipation(sph_graph(mesh, 1.2)), -0.1);
  EXPECT_GT(least_dissipation(fvm::build_graph(mesh, {"sbp"})), -0.1);
}

std::string refusal(const meshes::Mesh& mesh) {
  try {
    sph_graph(mesh, 1.2);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SummationByParts, SaysWhatItTakesAndWhatToUseInstead) {
  meshes::Mesh coarse = test_box(CellType::tetrahedron, 4, 0);
  for (Vec3& X : coarse.nodes) {
    const double r = 0.6 + X[2], angle = -3 * X[1];
    X = Vec3(X[0], r * std::cos(angle), r * std::sin(angle));
  }
  EXPECT_THAT(refusal(coarse), AllOf(HasSubstr("too coarse"), HasSubstr("corrected")));
  const meshes::Mesh wall = meshes::box(CellType::tetrahedron, {0, 0, 0}, {5, 5, 1}, {5, 5, 1});
  EXPECT_THAT(refusal(wall), AllOf(HasSubstr("one cell thick"), HasSubstr("corrected")));
}

}  // namespace
}  // namespace diptych::graphs
