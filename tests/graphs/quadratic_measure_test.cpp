#include "meshes/quadratic_measure.hpp"

#include "common/algebra/monomials.hpp"
#include "common/base/error.hpp"
#include "meshes/moment_balance.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>

namespace diptych::graphs {
namespace {

/// Of int q dV over the box of test_box, by monomials up to degree 2.
Eigen::VectorXd integrals(int dimension) {
  const Vec3 lower(-0.5, 0.1, 0), upper(0.5, 1.3, dimension == 2 ? 0 : 0.8);
  const auto& all = algebra::exponents(dimension, 2);
  Eigen::VectorXd exact = Eigen::VectorXd::Ones(static_cast<int>(all.size()));
  for (size_t m = 0; m < all.size(); ++m) {
    for (int i = 0; i < dimension; ++i) {
      const int n = all[m][i] + 1;
      exact[static_cast<int>(m)] *= (std::pow(upper[i], n) - std::pow(lower[i], n)) / n;
    }
  }
  return exact;
}

TEST(QuadraticMeasure, IntegratesQuadraticsAndLeavesCornersTheirShare) {
  for (const CellType type : all_cells) {
    for (const double moved : {0.0, 0.2}) {
      const meshes::Mesh mesh = test_box(type, is_flat(type) ? 9 : 6, moved);
      const int d = mesh.dimension;
      const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
      const meshes::DualMeasure vertex = meshes::dual_measure(mesh, meshes::Quadrature::exact);
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(algebra::n_monomials(d, 2));
      for (size_t a = 0; a < mesh.nodes.size(); ++a) {
        sum += measure.Omega[a] * algebra::monomials(mesh.nodes[a], d, 2);
        EXPECT_GT(measure.Omega[a], 0.4 * vertex.Omega[a]) << name_of(type) << " node " << a;
      }
      const Eigen::VectorXd exact = integrals(d);
      EXPECT_LE((sum - exact).norm(), 1e-12 * exact.norm()) << name_of(type) << moved;
    }
  }
}

/// Where cells are few and corners sharp, others change in place of a node that would lose its
/// volume: prisms and wedges of tetrahedra were refused for one of them.
TEST(QuadraticMeasure, LeavesNodesOfSharpCornersAPart) {
  for (const CellType type : all_cells) {
    for (const int n : {3, 4}) {
      meshes::Mesh mesh = test_box(type, n, 0.25);
      for (Vec3& X : mesh.nodes)
        X[1] = 0.1 + (X[1] - 0.1) * (1 - 0.9 * (X[0] + 0.5));  // a tenth as high at one end
      const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
      const meshes::DualMeasure share = meshes::dual_measure(mesh, meshes::Quadrature::exact);
      for (size_t a = 0; a < mesh.nodes.size(); ++a)
        EXPECT_GE(measure.Omega[a], 0.15 * share.Omega[a]) << name_of(type) << n << " node " << a;
    }
  }
}

/// Each side by itself, a group that covers a part of a side too.
TEST(QuadraticMeasure, HasPatchesThatIntegrateCubicsOverTheirFaces) {
  meshes::Mesh mesh = test_box(CellType::tetrahedron, 6, 0.2);
  meshes::BoundaryGroup part{"part", {}};
  for (const std::int32_t f : mesh.group("z_max").faces) {
    const auto& nodes = mesh.boundary_faces[f].nodes;
    const auto is_left = [&](std::int32_t a) { return mesh.nodes[a][0] < 1e-9; };
    if (std::all_of(nodes.begin(), nodes.begin() + 3, is_left)) part.faces.push_back(f);
  }
  mesh.boundary_groups.push_back(part);
  const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
  for (const auto& [name, end] : {std::pair("z_max", 0.5), {"part", 0.0}}) {
    const auto patch = std::find_if(measure.patches.begin(), measure.patches.end(),
                                    [&](const auto& p) { return p.name == name; });
    double sum = 0;
    for (size_t i = 0; i < patch->nodes.size(); ++i) {
      const Vec3& X = mesh.nodes[patch->nodes[i]];
      sum += patch->area[i][2] * X[0] * X[0] * X[1];
      EXPECT_LE(X[0], end + 1e-9) << name;
    }
    const double exact = (std::pow(end, 3) + 0.125) / 3 * (1.3 * 1.3 - 0.1 * 0.1) / 2;
    EXPECT_NEAR(sum, exact, 1e-13) << name;
  }
}

/// What volumes integrate is the ring, not its facets, and they agree with the areas about cubics.
TEST(QuadraticMeasure, TakesCurvedSidesForWhatTheyStandFor) {
  for (const CellType type : all_cells) {
    for (const int n : {6, 12}) {
      const meshes::Mesh mesh = bent_box(type, n, 0.2);
      const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
      const meshes::DualMeasure facets = meshes::dual_measure(mesh, meshes::Quadrature::exact);
      const double exact = 0.4 * (2.2 * 2.2 - 1) * (is_flat(type) ? 1 : 0.8);
      const auto error = [&](const std::vector<double>& Omega) {
        return std::abs(std::accumulate(Omega.begin(), Omega.end(), 0.0) / exact - 1);
      };
      EXPECT_LE(error(measure.Omega), 0.1 * error(facets.Omega)) << name_of(type) << n;
      EXPECT_LE(meshes::moment_difference(mesh, measure.Omega, measure.boundary_area), 1e-13);
      double largest = 0;  // turn of a normal of the outer arc
      for (size_t a = 0; a < mesh.nodes.size(); ++a) {
        const Vec3& X = mesh.nodes[a];
        const bool is_inside = std::abs(std::atan2(X[1], X[0]) - 0.4) < 0.39;
        if (X.head<2>().norm() < 2.2 - 1e-9 || !is_inside) continue;
        if (!is_flat(type) && (X[2] < 1e-9 || X[2] > 0.8 - 1e-9)) continue;
        const Vec3 N = measure.boundary_area[a].normalized(), radial(X[0], X[1], 0);
        largest = std::max(largest, N.cross(radial.normalized()).norm());
      }
      EXPECT_LE(largest, 0.1 * std::pow(6.0 / n, 2)) << name_of(type) << n;
    }
  }
}

/// A group keeps its area however few faces it has.
TEST(QuadraticMeasure, LeavesSmallPatchesTheirArea) {
  for (const CellType type : {CellType::tetrahedron, CellType::hexahedron}) {
    for (const size_t n_faces : {1, 2, 6}) {
      meshes::Mesh mesh = test_box(type, 6, 0.2);
      meshes::BoundaryGroup small{"small", mesh.group("z_max").faces};
      small.faces.resize(n_faces);
      mesh.boundary_groups.push_back(small);
      Vec3 exact = Vec3::Zero();
      for (const std::int32_t f : small.faces) {
        for (const Vec3& share : meshes::face_area_shares(mesh.boundary_faces[f], mesh.nodes,
                                                          meshes::Quadrature::exact))
          exact += share;
      }
      Vec3 area = Vec3::Zero();
      const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
      for (const Vec3& A : measure.patches.back().area)
        area += A;
      EXPECT_LE((area - exact).norm(), 1e-12 * exact.norm()) << name_of(type) << n_faces;
    }
  }
}

/// Also at rims, where faces of plane sides are curved.
TEST(QuadraticMeasure, LeavesPlaneSidesTheirDirection) {
  const meshes::Mesh mesh = bent_box(CellType::tetrahedron, 6, 0.2);
  const meshes::DualMeasure measure = meshes::quadratic_measure(mesh);
  for (const meshes::PatchArea& patch : measure.patches) {
    if (patch.name.front() != 'z') continue;
    for (const Vec3& A : patch.area)
      EXPECT_LE(A.head<2>().norm(), 1e-14 * std::abs(A[2])) << patch.name;
  }
}

}  // namespace
}  // namespace diptych::graphs
