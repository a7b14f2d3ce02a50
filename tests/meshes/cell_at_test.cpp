/// Places in and beside boxes of every type of cell.

#include "meshes/cell_at.hpp"

#include "meshes/generators.hpp"

#include <gmock/gmock.h>

namespace diptych::meshes {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(CellAt, HoldsAllPlacesInABoxAndAFewBesideIt) {
  for (const CellType type :
       {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron}) {
    const bool is_flat = dimension_of(type) == 2;
    const Mesh mesh = box(type, {0, 0, 0}, {4, 1, is_flat ? 0.0 : 1.0}, {4, 4, 4});
    const double z = is_flat ? 0 : 0.3;
    for (const double x : {0.0, 0.5, 1.3, 2.0, 3.99, 4.05}) {
      for (const double y : {0.0, 0.125, 0.3, 0.5, 1.0, 1.01})
        EXPECT_THAT(nodes_of_cells_at(mesh, {x, y, z}), testing::Not(IsEmpty())) << x << " " << y;
    }
    EXPECT_THAT(nodes_of_cells_at(mesh, {4.2, 0.5, z}), IsEmpty());
    EXPECT_THAT(nodes_of_cells_at(mesh, {0.5, 1.05, z}), IsEmpty());
    EXPECT_THAT(nodes_of_cells_at(mesh, {0.5, -0.12, z}), IsEmpty());
  }
}

TEST(CellAt, HasTheNodesOfAllCellsThatHoldAPlace) {
  const Mesh mesh = box(CellType::quadrilateral, {0, 0, 0}, {3, 3, 0}, {3, 3, 0});
  EXPECT_THAT(nodes_of_cells_at(mesh, {0.5, 0.4, 0}), ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(nodes_of_cells_at(mesh, {1, 0.4, 0}), ElementsAre(0, 1, 2, 4, 5, 6));
  EXPECT_THAT(nodes_of_cells_at(mesh, {1, 1, 0}), SizeIs(9));
}

}  // namespace
}  // namespace diptych::meshes
