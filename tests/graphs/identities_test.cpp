/// The exact identities of notes 3.2, from the C_ab alone, and the two approximation
/// conditions (linear exactness, closure) on every graph that the two factories make.

#include "common/scheme/graph/dissipation_area.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

namespace diptych::graphs {
namespace {

struct Scene {
  std::string name;
  scheme::PairGraph graph;
};

Scene fvm_scene(CellType type, const std::string& stencil, double fraction) {
  return {"fvm " + stencil + " " + name_of(type) + " moved by " + std::to_string(fraction),
          fvm::build_graph(test_box(type, is_flat(type) ? 9 : 6, fraction), {stencil})};
}

Scene sph_scene(CellType type, const std::string& kernel, double fraction) {
  sph::Options options;
  options.kernel = kernel;
  return {"sph " + kernel + " " + name_of(type) + " moved by " + std::to_string(fraction),
          sph::build_graph(test_box(type, is_flat(type) ? 9 : 6, fraction), options)};
}

/// 9 and 14 nodes to a line: the widest pairs; 7 cells on some, so that they fall back there.
Scene sbp_scene(CellType type, int order, const std::array<int, 3>& cells) {
  meshes::Mesh mesh = meshes::box(type, {-0.5, 0.1, 0}, {0.5, 1.3, is_flat(type) ? 0 : 0.8}, cells);
  for (Vec3& X : mesh.nodes)
    X[0] += 0.3 * X[1];  // any parallelepiped
  fvm::Options options{"sbp", order};
  return {"fvm sbp " + std::to_string(order) + " " + name_of(type),
          fvm::build_graph(mesh, options)};
}

Scene sph_sbp_scene(CellType type, const std::array<int, 3>& cells) {
  meshes::Mesh mesh = meshes::box(type, {-0.5, 0.1, 0}, {0.5, 1.3, is_flat(type) ? 0 : 0.8}, cells);
  for (Vec3& X : mesh.nodes)
    X[0] += 0.3 * X[1];
  sph::Options options;
  options.gradient = "sbp";
  return {"sph summing " + name_of(type), sph::build_graph(mesh, options)};
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = [] {
    std::vector<Scene> made;
    for (double fraction : {0.0, 0.1, 0.2, 0.3}) {
      for (CellType type : all_cells) {
        // thin tetrahedra fold at 30 %
        if (type == CellType::tetrahedron && fraction > 0.2) continue;
        for (const char* stencil : {"edge", "integral"}) {
          made.push_back(fvm_scene(type, stencil, fraction));
        }
        made.push_back(sph_scene(type, "cubic-spline", fraction));
      }
      for (const char* kernel : {"quintic-spline", "wendland-c2"}) {
        for (CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
          made.push_back(sph_scene(type, kernel, fraction));
        }
      }
    }
    for (const int order : {2, 4, 6}) {
      made.push_back(sbp_scene(CellType::hexahedron, order, {9, 7, 13}));
      made.push_back(sbp_scene(CellType::hexahedron, order, {3, 8, 1}));
      made.push_back(sbp_scene(CellType::quadrilateral, order, {13, 9, 1}));
    }
    made.push_back(sph_sbp_scene(CellType::hexahedron, {7, 4, 6}));
    made.push_back(sph_sbp_scene(CellType::quadrilateral, {8, 5, 1}));
    return made;
  }();
  return all;
}

/// 1e-12 is the promise; what is measured is 1e-14 (linear exactness) and the stop of the repair,
/// 2e-13 (closure).
TEST(EveryGraph, IsExactForLinearFieldsAndClosed) {
  for (const Scene& scene : scenes()) {
    const scheme::GraphQuality quality = scheme::quality(scene.graph);
    EXPECT_LE(quality.linear_exactness, 1e-12) << scene.name;
    EXPECT_LE(quality.closure, 1e-12) << scene.name;
    EXPECT_GE(quality.least_neighbours, scene.graph.dimension) << scene.name;
  }
}

/// Only wide derivatives have areas that point backwards, a tenth of all with the finite volumes;
/// those pairs dissipate nothing, nor do pairs of SPH that sums by parts but the nearest, a sixth
/// or more (common/scheme/graph/dissipation_area.hpp).
TEST(EveryGraph, HasAreasFromANodeToItsNeighbourButForWideDerivatives) {
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    double backwards = 0, all = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Vec3 S = 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]);
        const double area = scheme::dissipation_area(S, graph.X[graph.neighbour[p]] - graph.X[a],
                                                     graph.dissipation_metric);
        EXPECT_TRUE(area == 0 || area == S.norm()) << scene.name;
        all += S.norm();
        backwards += S.norm() - area;
      }
    }
    const bool is_wide = scene.name.find("sbp 4") != std::string::npos ||
                         scene.name.find("sbp 6") != std::string::npos;
    if (scene.name.find("sph summing") != std::string::npos) {
      EXPECT_GT(backwards, 0.1 * all) << scene.name;
      EXPECT_LT(backwards, 0.8 * all) << scene.name;
    } else if (is_wide) {
      EXPECT_GT(backwards, 0.05 * all) << scene.name;
      EXPECT_LT(backwards, 0.15 * all) << scene.name;
    } else {
      EXPECT_EQ(backwards, 0) << scene.name;
    }
  }
}

TEST(EveryGraph, IsInBalanceUnderConstantStressAndItsTractions) {
  const Mat3 P = (Mat3() << 3, 1, -2, 0.5, -4, 1, 2, 1, 5).finished();
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    const std::vector<Mat3> constant(graph.X.size(), P);
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      // T_a = -P A_a^eff + P A_aN_a; relative to |P| h^(d-1)
      const Vec3 T = force(graph, constant, a) + P * graph.boundary_area[a];
      const double area = std::pow(graph.Omega[a], (graph.dimension - 1.0) / graph.dimension);
      EXPECT_LE(T.norm(), 1e-11 * area) << scene.name << " node " << a;
    }
  }
}

TEST(EveryGraph, KeepsLinearMomentumAndTheDualityOfForceAndRate) {
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    const std::vector<Vec3> v = random_field(graph, 1);
    const std::vector<Vec3> columns[3] = {random_field(graph, 2), random_field(graph, 3),
                                          random_field(graph, 4)};
    std::vector<Mat3> P(graph.X.size());
    for (size_t a = 0; a < P.size(); ++a)
      P[a] << columns[0][a], columns[1][a], columns[2][a];
    Vec3 sum = Vec3::Zero();
    double power = 0, rate = 0, size = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Vec3 T = force(graph, P, a);
      const Mat3 F_rate = gradient(graph, v, a);
      sum += T;
      power += v[a].dot(T);
      rate += graph.Omega[a] * P[a].cwiseProduct(F_rate).sum();
      size += T.norm() + graph.Omega[a] * P[a].norm() * F_rate.norm();
    }
    EXPECT_LE(sum.norm(), 1e-12 * size) << scene.name;
    EXPECT_LE(std::abs(power + rate), 1e-12 * size) << scene.name;
  }
}

TEST(EveryGraph, HasNoInternalTorqueWhereFIsTheGradientOfXAndPFtIsSymmetric) {
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    const double h = std::pow(graph.Omega.back(), 1.0 / graph.dimension);
    std::vector<Vec3> x = random_field(graph, 5);
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a)
      x[a] = graph.X[a] + 0.1 * h * x[a];
    std::vector<Mat3> P(graph.X.size());
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      Mat3 F = gradient(graph, x, a);
      if (graph.dimension == 2) F(2, 2) = 1;
      const Mat3 S = F.transpose() * F + 0.3 * Mat3::Identity();  // any symmetric matrix
      P[a] = F * S;
    }
    Vec3 torque = Vec3::Zero();
    double size = 0;
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      const Vec3 T = force(graph, P, a);
      torque += x[a].cross(T);
      size += x[a].norm() * T.norm();
    }
    EXPECT_LE(torque.norm(), 1e-12 * size) << scene.name;
  }
}

Mat3 cross_product(const Mat3& A, const Mat3& B) {
  Mat3 result;
  for (int i = 0; i < 3; ++i) {
    for (int I = 0; I < 3; ++I) {
      const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
      result(i, I) = A(j, J) * B(k, K) - A(j, K) * B(k, J) - A(k, J) * B(j, K) + A(k, K) * B(j, J);
    }
  }
  return result;
}

/// (18c,d) summed over the pairs are the time derivatives of cof F and det F: compared with central
/// differences of exact polynomials of degree 2 and 3 in t (error: round-off / step).
TEST(EveryGraph, MovesHAndJAsTheCofactorAndDeterminantOfF) {
  for (const Scene& scene : scenes()) {
    const auto& graph = scene.graph;
    const std::vector<Vec3> v = random_field(graph, 6);
    for (std::int64_t a = 0; a < graph.n_nodes(); a += 7) {
      Mat3 F = Mat3::Identity() + 0.1 * gradient(graph, graph.X, a) * (a % 3);
      const Mat3 F_rate = gradient(graph, v, a);
      const Mat3 H = 0.5 * cross_product(F, F);
      Mat3 H_rate = Mat3::Zero();
      double J_rate = 0;
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Vec3 jump = 0.5 * (v[graph.neighbour[p]] - v[a]);
        H_rate += cross_product(F, jump * graph.C[p].transpose()) / graph.Omega[a];
        J_rate += H.cwiseProduct(jump * graph.C[p].transpose()).sum() / graph.Omega[a];
      }
      const double t = 1 / (1 + F_rate.norm()), unit = 1 / t;
      const auto cofactor = [&](double s) -> Mat3 {
        return 0.5 * cross_product(F + s * F_rate, F + s * F_rate);
      };
      const auto J = [&](double s) { return (F + s * F_rate).determinant(); };
      const Mat3 H_difference = (cofactor(t) - cofactor(-t)) / (2 * t);
      // Richardson: exact for the cubic det F
      const double wide = (J(t) - J(-t)) / (2 * t), narrow = (J(t / 2) - J(-t / 2)) / t;
      EXPECT_LE((H_rate - H_difference).norm(), 1e-12 * unit) << scene.name;
      EXPECT_LE(std::abs(J_rate - (4 * narrow - wide) / 3), 1e-12 * unit) << scene.name;
    }
  }
}

}  // namespace
}  // namespace diptych::graphs
