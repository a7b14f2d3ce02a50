/// The mesh as VTK reads it: node order and orientation by VTK's definitions of its cell types.

#include "benchmarks/run/case_mesh.hpp"

#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace diptych::harness {
namespace {

using meshes::CellType;
using meshes::Vec3;

/// Points of cell c in VTK's order.
std::vector<Vec3> points_of(const io::VisualMesh& mesh, size_t c) {
  std::vector<Vec3> points;
  for (std::int64_t i = mesh.offsets[c]; i < mesh.offsets[c + 1]; ++i) {
    const double* x = &mesh.points[3 * mesh.connectivity[i]];
    points.emplace_back(x[0], x[1], x[2]);
  }
  return points;
}

/// A box of 2 x 2 x 2 blocks whose nodes the user counts backwards.
CaseMesh renumbered_box(CellType type) {
  CaseMesh mesh;
  mesh.mesh = meshes::box(type, {0, 0, 0}, {2, 4, 6}, {2, 2, 2});
  mesh.order.resize(mesh.mesh.nodes.size());
  std::iota(mesh.order.rbegin(), mesh.order.rend(), 0);
  return mesh;
}

TEST(VisualMesh, TheBaseOfAWedgeLooksAwayFromItsOtherTriangle) {
  // vtkWedge: the normal of (0, 1, 2) by the right-hand rule points away from (3, 4, 5), which VTK
  // 9.1 counts as a positive volume; 3 lies above 0, 4 above 1, 5 above 2
  const io::VisualMesh mesh = visual_mesh(renumbered_box(CellType::prism));
  ASSERT_EQ(mesh.types.size(), 16u);
  for (size_t c = 0; c < mesh.types.size(); ++c) {
    EXPECT_EQ(mesh.types[c], 13);
    const std::vector<Vec3> x = points_of(mesh, c);
    ASSERT_EQ(x.size(), 6u);
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
    EXPECT_NEAR(normal.dot(x[3] - x[0]), -6, 1e-12) << "twice the volume of half a block";
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR((x[3 + i] - x[i] - (x[3] - x[0])).norm(), 0, 1e-12) << "an edge of the prism";
  }
}

TEST(VisualMesh, OtherSolidsLookFromTheirFirstFaceInwards) {
  // vtkHexahedron: the normal of (0, 1, 2, 3) points towards (4, 5, 6, 7); vtkTetra: that of
  // (0, 1, 2) towards 3
  const io::VisualMesh hexahedra = visual_mesh(renumbered_box(CellType::hexahedron));
  for (size_t c = 0; c < hexahedra.types.size(); ++c) {
    const std::vector<Vec3> x = points_of(hexahedra, c);
    EXPECT_EQ(hexahedra.types[c], 12);
    EXPECT_NEAR((x[1] - x[0]).cross(x[3] - x[0]).dot(x[4] - x[0]), 6, 1e-12);
  }
  const io::VisualMesh tetrahedra = visual_mesh(renumbered_box(CellType::tetrahedron));
  for (size_t c = 0; c < tetrahedra.types.size(); ++c) {
    const std::vector<Vec3> x = points_of(tetrahedra, c);
    EXPECT_EQ(tetrahedra.types[c], 10);
    EXPECT_NEAR((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]), 6, 1e-12);
  }
}

TEST(VisualMesh, FlatCellsTurnCounterClockwise) {
  for (const CellType type : {CellType::triangle, CellType::quadrilateral}) {
    const io::VisualMesh mesh = visual_mesh(renumbered_box(type));
    for (size_t c = 0; c < mesh.types.size(); ++c) {
      const std::vector<Vec3> x = points_of(mesh, c);
      EXPECT_GT((x[1] - x[0]).cross(x.back() - x[0])[2], 0);
    }
  }
}

}  // namespace
}  // namespace diptych::harness
