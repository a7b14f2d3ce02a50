#include "meshes/generators.hpp"

#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

constexpr CellType all_types[] = {CellType::triangle, CellType::quadrilateral,
                                  CellType::tetrahedron, CellType::hexahedron, CellType::prism};
const Vec3 lower{-0.3, 0.1, 0.2}, upper{0.9, 1.7, 0.9};

/// Cells per block, and faces per block side across x, y and z.
struct Split {
  int n_cells;
  std::array<int, 3> n_faces;
};

Split split_of(CellType type) {
  switch (type) {
    case CellType::triangle:
      return {2, {1, 1, 0}};
    case CellType::quadrilateral:
      return {1, {1, 1, 0}};
    case CellType::tetrahedron:
      return {6, {2, 2, 2}};
    case CellType::hexahedron:
      return {1, {1, 1, 1}};
    case CellType::prism:
      return {2, {1, 1, 2}};
  }
  return {};
}

TEST(Box, CellsFillItExactlyOnce) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = box(type, lower, upper, {3, 4, 5});
    const bool is_solid = dimension_of(type) == 3;
    const double volume = 1.2 * 1.6 * (is_solid ? 0.7 : 1);
    EXPECT_EQ(mesh.n_cells(), split_of(type).n_cells * 12 * (is_solid ? 5 : 1));
    EXPECT_EQ(mesh.n_nodes(), 20 * (is_solid ? 6 : 1));
    // Sums of some hundred terms of order one: round-off well below 1e-13.
    EXPECT_NEAR(sum_of_cell_volumes(mesh), volume, 1e-13);
    EXPECT_NEAR(volume_inside_boundary(mesh), volume, 1e-13);
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
      EXPECT_NEAR(cell_volume(mesh, c) * static_cast<double>(mesh.n_cells()), volume, 1e-13);
    }
  }
}

TEST(Box, ConformsSoThatTheBoundaryIsClosedAndHasNoFaceInside) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = box(type, lower, upper, {3, 4, 5});
    const auto n = split_of(type).n_faces;
    const size_t expected =
        dimension_of(type) == 2 ? 2 * (3 + 4) : 2 * (n[0] * 4 * 5 + n[1] * 3 * 5 + n[2] * 3 * 4);
    EXPECT_EQ(mesh.boundary_faces.size(), expected);
    EXPECT_LT(area_of_boundary(mesh).norm(), 1e-14);  // cancels in pairs up to round-off
  }
}

TEST(Box, GroupsAreItsSidesAndCoverTheBoundaryOnce) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = box(type, lower, upper, {3, 1, 2});
    Vec3 extent = upper - lower;
    if (mesh.dimension == 2) extent[2] = 1;
    size_t n_faces = 0;
    ASSERT_EQ(mesh.boundary_groups.size(), 2u * mesh.dimension);
    for (int d = 0; d < mesh.dimension; ++d) {
      for (const bool far : {false, true}) {
        const std::string name = std::string(1, "xyz"[d]) + (far ? "_max" : "_min");
        Vec3 area = Vec3::Zero();
        area[d] = (far ? 1 : -1) * extent[(d + 1) % 3] * extent[(d + 2) % 3];
        EXPECT_LT((area_of_group(mesh, name) - area).norm(), 1e-14) << name;
        EXPECT_TRUE(std::ranges::is_sorted(mesh.group(name).faces));
        n_faces += mesh.group(name).faces.size();
      }
    }
    EXPECT_EQ(n_faces, mesh.boundary_faces.size());
  }
}

TEST(Box, NodesRunFastestInXAndMirrorExactly) {
  const Mesh mesh = box(CellType::quadrilateral, {-0.3, 0, 0}, {0.3, 1, 0}, {7, 2, 0});
  for (int i = 0; i <= 7; ++i) {
    EXPECT_EQ(mesh.nodes[i][1], 0.0);
    EXPECT_EQ(mesh.nodes[i][0], -mesh.nodes[7 - i][0]) << i;
  }
  EXPECT_EQ(mesh.nodes[0][0], -0.3);
  EXPECT_EQ(mesh.nodes[7][0], 0.3);
}

TEST(Box, BadArgumentsAreRefusedWithTheirValue) {
  const auto message = [](const Vec3& low, const Vec3& high, const std::array<int, 3>& cells) {
    return input_error_of([&] { box(CellType::hexahedron, low, high, cells); });
  };
  const Vec3 zero = Vec3::Zero(), one = Vec3::Ones();
  EXPECT_NE(message(zero, one, {2, 0, 2}).find("0 cells in direction y"), std::string::npos);
  EXPECT_NE(message(zero, {1, 1, 0}, {2, 2, 2}).find("lower z"), std::string::npos);
  EXPECT_NE(message(zero, {NAN, 1, 1}, {2, 2, 2}).find("lower x"), std::string::npos);
  EXPECT_NE(message(zero, one, {INT_MAX, INT_MAX, INT_MAX}).find("32-bit"), std::string::npos);
  EXPECT_NE(message(zero, one, {1290, 1290, 1290}).find("32-bit"), std::string::npos);
  const Vec3 far{1e17, 0, 0};  // spacing of doubles there is 16
  EXPECT_NE(message(far, far + Vec3(16, 1, 1), {4, 1, 1}).find("degenerate"), std::string::npos);
}

}  // namespace
}  // namespace diptych::meshes
