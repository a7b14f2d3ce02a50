#include "meshes/dual_measure.hpp"

#include "common/base/error.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

using meshes::dual_measure;
using meshes::Quadrature;

TEST(DualMeasure, IsThatOfALatticeOnRectangularCells) {
  for (Quadrature rule : {Quadrature::vertex, Quadrature::exact}) {
    const meshes::Mesh mesh = meshes::box(CellType::hexahedron, {0, 0, 0}, {2, 3, 4}, {2, 3, 4});
    const auto measure = dual_measure(mesh, rule);
    EXPECT_NEAR(measure.Omega[0], 1. / 8, 1e-15);
    EXPECT_NEAR(measure.Omega[1], 1. / 4, 1e-15);
    EXPECT_NEAR(measure.Omega[1 + 3 * 1], 1. / 2, 1e-15);
    EXPECT_NEAR(measure.Omega[1 + 3 * (1 + 4)], 1, 1e-15);
    EXPECT_NEAR((measure.boundary_area[0] + 0.25 * Vec3(1, 1, 1)).norm(), 0, 1e-15);
    EXPECT_NEAR(measure.boundary_area[1 + 3 * (1 + 4)].norm(), 0, 1e-15);
  }
}

/// What an exact closure of linear-exact C_ab needs (closure_repair.hpp).
TEST(DualMeasure, SatisfiesTheMomentIdentityOnDistortedMeshes) {
  for (CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, 4, type == CellType::tetrahedron ? 0.2 : 0.3);
    for (Quadrature rule : {Quadrature::vertex, Quadrature::exact}) {
      const auto measure = dual_measure(mesh, rule);
      Mat3 moment = Mat3::Zero();
      double volume = 0;
      for (size_t a = 0; a < mesh.nodes.size(); ++a) {
        moment += mesh.nodes[a] * measure.boundary_area[a].transpose();
        volume += measure.Omega[a];
      }
      Mat3 expected = volume * Mat3::Identity();
      if (is_flat(type)) expected(2, 2) = 0;
      EXPECT_NEAR((moment - expected).norm(), 0, 1e-14) << name_of(type);
      EXPECT_NEAR(volume, is_flat(type) ? 1.2 : 0.96, 1e-14) << name_of(type);
    }
  }
}

/// A wavy plate of hexahedra: warped faces, where the vertex rule needs its balance.
TEST(DualMeasure, SatisfiesTheMomentIdentityOnCurvedBoundaries) {
  meshes::Mesh mesh = test_box(CellType::hexahedron, 5, 0);
  double volume[2] = {};
  for (Vec3& X : mesh.nodes)
    X[2] *= 1 + 0.4 * std::sin(4 * X[0]) * std::cos(3 * X[1]);
  for (Quadrature rule : {Quadrature::vertex, Quadrature::exact}) {
    const auto measure = dual_measure(mesh, rule);
    Mat3 moment = Mat3::Zero();
    double sum = 0;
    for (size_t a = 0; a < mesh.nodes.size(); ++a) {
      moment += mesh.nodes[a] * measure.boundary_area[a].transpose();
      sum += measure.Omega[a];
    }
    EXPECT_NEAR((moment - sum * Mat3::Identity()).norm(), 0, 1e-14);
    volume[rule == Quadrature::exact ? 1 : 0] = sum;
  }
  EXPECT_NEAR(volume[0], volume[1], 1e-14);
}

TEST(DualMeasure, GivesEachPatchItsOwnShareAtEdgesAndCorners) {
  for (CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, 3, 0.2);
    const auto measure = dual_measure(mesh, Quadrature::exact);
    ASSERT_EQ(measure.patches.size(), mesh.boundary_groups.size());
    std::vector<Vec3> sum(mesh.nodes.size(), Vec3::Zero());
    for (const auto& patch : measure.patches) {
      EXPECT_TRUE(std::is_sorted(patch.nodes.begin(), patch.nodes.end()));
      Vec3 total = Vec3::Zero();
      for (size_t i = 0; i < patch.nodes.size(); ++i) {
        sum[patch.nodes[i]] += patch.area[i];
        total += patch.area[i];
      }
      if (patch.name == "x_max") {
        EXPECT_NEAR((total - Vec3(is_flat(type) ? 1.2 : 0.96, 0, 0)).norm(), 0, 1e-14);
      }
    }
    for (size_t a = 0; a < sum.size(); ++a) {
      EXPECT_NEAR((sum[a] - measure.boundary_area[a]).norm(), 0, 1e-15) << name_of(type);
    }
  }
}

TEST(FilledAngle, IsOneInsideAndTheAngleOfTheBoxOutside) {
  for (CellType type : all_cells) {
    const meshes::Mesh mesh = test_box(type, 4, 0.2);
    const auto angle = meshes::filled_angle(mesh);
    EXPECT_NEAR(angle[0], is_flat(type) ? 1. / 4 : 1. / 8, 1e-14) << name_of(type);
    EXPECT_NEAR(angle[2], is_flat(type) ? 1. / 2 : 1. / 4, 1e-14) << name_of(type);
    const size_t inside = is_flat(type) ? 2 + 5 * 2 : 2 + 5 * (2 + 5 * 2);
    EXPECT_NEAR(angle[inside], 1, 1e-14) << name_of(type);
  }
}

TEST(DualMeasure, NamesAnInvertedCellAndAnOpenBoundary) {
  meshes::Mesh inverted = test_box(CellType::tetrahedron, 2, 0);
  std::swap(inverted.cell_nodes[4 * 7], inverted.cell_nodes[4 * 7 + 1]);
  try {
    dual_measure(inverted, Quadrature::exact);
    FAIL() << "an inverted cell went through";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("cell 7 at"));
  }
  meshes::Mesh open = test_box(CellType::hexahedron, 2, 0);
  open.boundary_faces.pop_back();
  for (auto& group : open.boundary_groups)
    group.faces.clear();
  EXPECT_THROW(dual_measure(open, Quadrature::exact), base::InputError);
}

}  // namespace
}  // namespace diptych::graphs
