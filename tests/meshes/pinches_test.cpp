/// Cells taken out of boxes of 3 x 3 x 3: where their surfaces touch themselves.

#include "meshes/pinches.hpp"

#include "tests/meshes/box_without.hpp"

#include <gmock/gmock.h>

namespace diptych::meshes {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Pinches, AreNodesWithMoreThanTwoEdgesInThePlane) {
  EXPECT_THAT(pinched_nodes(box_without(CellType::quadrilateral, {})), IsEmpty());
  EXPECT_THAT(pinched_nodes(box_without(CellType::quadrilateral, {4})), IsEmpty());
  EXPECT_THAT(pinched_nodes(box_without(CellType::quadrilateral, {0, 4})), ElementsAre(5));
}

// 5 and 21 are the ends of the first inner edge along z, of lines of 4 nodes.
TEST(Pinches, AreEdgesWithMoreThanTwoFacesAndNodesWithMoreThanOneSheet) {
  constexpr CellType type = CellType::hexahedron;
  EXPECT_THAT(pinched_nodes(box_without(type, {})), IsEmpty());
  EXPECT_THAT(pinched_nodes(box_without(type, {13})), IsEmpty()) << "a cavity";
  EXPECT_THAT(pinched_nodes(box_without(type, {0, 1})), IsEmpty()) << "a notch";
  EXPECT_THAT(pinched_nodes(box_without(type, {0, 4})), ElementsAre(5, 21)) << "an edge";
  EXPECT_THAT(pinched_nodes(box_without(type, {0, 13})), ElementsAre(21)) << "a node";
}

}  // namespace
}  // namespace diptych::meshes
