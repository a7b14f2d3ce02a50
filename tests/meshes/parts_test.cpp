/// Parts of meshes are found, whatever their number of cells.

#include "meshes/parts.hpp"

#include "tests/meshes/box_without.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

/// Of these, side by side.
Mesh together(const Mesh& one, const Mesh& other) {
  Mesh mesh = one;
  const auto n_nodes = static_cast<std::int32_t>(one.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (std::int64_t c = 0; c < other.n_cells(); ++c) {
    mesh.cell_types.push_back(other.cell_types[static_cast<size_t>(c)]);
    for (const std::int32_t a : other.cell(c))
      mesh.cell_nodes.push_back(a + n_nodes);
    mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
  }
  return mesh;
}

TEST(Parts, AreThoseThatShareNoNode) {
  for (const CellType type : {CellType::tetrahedron, CellType::hexahedron}) {
    const Mesh one = box(type, {0, 0, 0}, {1, 1, 1}, {5, 4, 3}),
               other = box(type, {2, 0, 0}, {3, 1, 1}, {1, 1, 1});
    EXPECT_EQ(n_parts(one), 1);
    EXPECT_EQ(n_parts(together(one, other)), 2);
    EXPECT_EQ(n_parts(together(together(other, one), other)), 3);
  }
}

TEST(Parts, AreThoseThatShareNoFace) {
  const Mesh whole = box(CellType::tetrahedron, {0, 0, 0}, {1, 1, 1}, {3, 2, 2});
  EXPECT_EQ(n_parts_by_faces(whole), 1);
  EXPECT_EQ(n_parts_by_faces(together(whole, whole)), 2);
  const Mesh hinged = box_without(CellType::quadrilateral, {0, 2, 3, 5, 6, 7, 8});  // 1 and 4
  EXPECT_EQ(n_parts_by_faces(hinged), 1);
  const Mesh corners = box_without(CellType::quadrilateral, {1, 3, 5, 7});
  EXPECT_EQ(n_parts_by_faces(corners), 5);
}

}  // namespace
}  // namespace diptych::meshes
