/// Which cells are alone between two free sides.

#include "meshes/single_cells.hpp"

#include "tests/meshes/box_without.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

std::int64_t n_free(const Mesh& mesh) {
  return n_single_cells(mesh, std::vector<char>(mesh.boundary_faces.size(), 0));
}

TEST(SingleCells, AreHexahedraAndQuadrilateralsBetweenTwoSides) {
  EXPECT_EQ(n_free(box(CellType::hexahedron, {0, 0, 0}, {3, 2, 1}, {3, 2, 1})), 6);
  EXPECT_EQ(n_free(box(CellType::hexahedron, {0, 0, 0}, {3, 2, 2}, {3, 2, 2})), 0);
  EXPECT_EQ(n_free(box(CellType::quadrilateral, {0, 0, 0}, {3, 1, 0}, {3, 1, 0})), 3);
  EXPECT_EQ(n_free(box(CellType::triangle, {0, 0, 0}, {3, 1, 0}, {3, 1, 0})), 0);
  EXPECT_EQ(n_free(box_without(CellType::quadrilateral, {3, 4, 6, 7})), 4) << "an angle";
}

TEST(SingleCells, AreNoneWhereASideIsHeld) {
  const Mesh mesh = box(CellType::quadrilateral, {0, 0, 0}, {3, 1, 0}, {3, 1, 0});
  std::vector<char> is_held(mesh.boundary_faces.size(), 0);
  for (const std::int32_t f : mesh.group("y_min").faces)
    is_held[static_cast<size_t>(f)] = 1;
  EXPECT_EQ(n_single_cells(mesh, is_held), 0);
}

}  // namespace
}  // namespace diptych::meshes
