#include "meshes/shape_integrals.hpp"

#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

namespace diptych::graphs {
namespace {

using meshes::Quadrature;
using meshes::reference_cell;

TEST(ShapeFunctions, AreOneAtTheirNodeAndReproduceLinearFields) {
  for (CellType type : all_cells) {
    const auto& cell = reference_cell(type);
    for (const auto* rule : {&cell.vertex, &cell.exact}) {
      for (size_t q = 0; q < rule->size(); ++q) {
        const auto& point = (*rule)[q];
        double sum = 0;
        Vec3 slope = Vec3::Zero();
        Mat3 identity = Mat3::Zero();
        for (int a = 0; a < cell.n_nodes; ++a) {
          sum += point.N[a];
          slope += point.dN[a];
          identity += cell.nodes[a] * point.dN[a].transpose();
          if (rule == &cell.vertex) {
            EXPECT_EQ(point.N[a], a == static_cast<int>(q) ? 1 : 0);
          }
        }
        if (cell.dimension == 2) identity(2, 2) = 1;
        EXPECT_NEAR(sum, 1, 1e-15) << name_of(type);
        EXPECT_NEAR(slope.norm(), 0, 1e-15) << name_of(type);
        EXPECT_NEAR((identity - Mat3::Identity()).norm(), 0, 1e-15) << name_of(type);
      }
    }
  }
}

TEST(ShapeFunctions, HaveTheGradientsOfFiniteDifferences) {
  // values at the Gauss points along x: linear in x between two points of equal y, z
  const auto& hexahedron = reference_cell(CellType::hexahedron).exact;
  const double spacing = 2 / std::sqrt(3.0);
  for (int a = 0; a < 8; ++a) {
    EXPECT_NEAR((hexahedron[1].N[a] - hexahedron[0].N[a]) / spacing, hexahedron[0].dN[a][0], 1e-15);
    EXPECT_NEAR((hexahedron[2].N[a] - hexahedron[0].N[a]) / spacing, hexahedron[0].dN[a][1], 1e-15);
    EXPECT_NEAR((hexahedron[4].N[a] - hexahedron[0].N[a]) / spacing, hexahedron[0].dN[a][2], 1e-15);
  }
}

/// int N_a grad N_b dV summed over b, and its divergence theorem per cell, need the full degree of
/// the integrand: they fail with fewer points.
TEST(ExactRule, SatisfiesTheDivergenceTheoremOnDistortedCells) {
  for (CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, 3, 0.25);
    std::vector<Vec3> flux(mesh.nodes.size(), Vec3::Zero());
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
      const auto& cell = reference_cell(mesh.cell_types[c]);
      for (const auto& point : cell.exact) {
        const Mat3 cof =
            point.weight * meshes::cofactor(jacobian(cell, point, mesh.cell(c), mesh.nodes));
        for (int a = 0; a < cell.n_nodes; ++a)
          flux[mesh.cell(c)[a]] += cof * point.dN[a];
      }
    }
    for (const auto& face : mesh.boundary_faces) {
      const auto shares = face_area_shares(face, mesh.nodes, Quadrature::exact);
      for (int i = 0; i < face.n_nodes; ++i)
        flux[face.nodes[i]] -= shares[i];
    }
    for (const Vec3& f : flux)
      EXPECT_NEAR(f.norm(), 0, 1e-15) << name_of(type);
  }
}

TEST(FaceAreas, OfATwistedFaceSumToTheSameVectorInBothRules) {
  const std::vector<Vec3> X = {{0, 0, 0}, {1, 0, 0.2}, {1.3, 1, -0.1}, {0, 0.8, 0.3}};
  const meshes::BoundaryFace face{4, {0, 1, 2, 3}};
  Vec3 exact = Vec3::Zero(), vertex = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    exact += face_area_shares(face, X, Quadrature::exact)[i];
    vertex += face_area_shares(face, X, Quadrature::vertex)[i];
  }
  const Vec3 diagonals = 0.5 * (X[2] - X[0]).cross(X[3] - X[1]);
  EXPECT_NEAR((exact - diagonals).norm(), 0, 1e-15);
  EXPECT_NEAR((vertex - diagonals).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace diptych::graphs
