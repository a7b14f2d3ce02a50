/// Cells taken out of boxes: which surfaces are cavities, and how large they are.

#include "meshes/cavities.hpp"

#include "tests/meshes/box_without.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

TEST(Cavities, OneCellInTheMiddleIsMissing) {
  const struct {
    CellType type;
    std::int64_t middle, n_faces;
    double volume;
  } cases[] = {{CellType::hexahedron, 13, 6, 1.0 / 27}, {CellType::quadrilateral, 4, 4, 1.0 / 9}};
  for (const auto& [type, middle, n_faces, volume] : cases) {
    const auto found = cavities_of(box_without(type, {middle}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].n_faces, n_faces);
    EXPECT_NEAR(found[0].volume, volume, 1e-15);
    const bool is_flat = type == CellType::quadrilateral;
    EXPECT_LT((found[0].centre - Vec3(0.5, 0.5, is_flat ? 0.0 : 0.5)).norm(), 1e-15);
    EXPECT_FALSE(found[0].is_grouped);
  }
}

TEST(Cavities, ABodyThatIsWholeOrOpenHasNone) {
  EXPECT_TRUE(cavities_of(box_without(CellType::hexahedron, {})).empty());
  EXPECT_TRUE(cavities_of(box_without(CellType::hexahedron, {12})).empty());  // open to a side
  EXPECT_TRUE(cavities_of(box_without(CellType::hexahedron, {9, 10, 11, 12, 13, 14, 15, 16, 17}))
                  .empty());  // two bodies
}

TEST(Cavities, AGroupOnItIsSeen) {
  Mesh mesh = box_without(CellType::hexahedron, {13});
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.boundary_faces.size()); ++f) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t a : mesh.boundary_faces[f].nodes)
      centre += mesh.nodes[a] / 4;
    if ((centre - Vec3(0.5, 0.5, 1.0 / 3)).norm() < 1e-9)
      mesh.boundary_groups.push_back({"hole", {f}});
  }
  const auto found = cavities_of(mesh);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].is_grouped);
}

}  // namespace
}  // namespace diptych::meshes
