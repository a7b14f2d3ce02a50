/// What is said of meshes that may not have been meant to be as they are.

#include "benchmarks/run/mesh_notices.hpp"

#include "common/cases/reader.hpp"
#include "tests/meshes/box_without.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using meshes::CellType;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// As of a file, with the left end fixed.
std::vector<std::string> notices_of(const meshes::Mesh& mesh, const std::string& held = "x_min") {
  cases::Case setup = cases::case_from_text(R"([mesh]
element = "quadrilateral"
upper = [1, 1]
cells = [3, 3]
[material]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[boundary]]
group = ")" + held + R"("
type = "fixed"
[time]
end = 1
)",
                                            "mesh_notices", {});
  setup.mesh.file = "body.msh";
  std::vector<std::string> notices;
  note_mesh(setup, mesh, 0, notices);
  return notices;
}

TEST(MeshNotices, TellOfBodiesOfOneCellAcross) {
  const auto strip = [](int across) {
    return meshes::box(CellType::quadrilateral, {0, 0, 0}, {4, 1, 0}, {4, across, 1});
  };
  EXPECT_THAT(notices_of(strip(1)), ElementsAre(HasSubstr("4 of 4 cells are alone")));
  EXPECT_THAT(notices_of(strip(1), "y_min"), IsEmpty());
  EXPECT_THAT(notices_of(strip(2)), IsEmpty());
}

TEST(MeshNotices, TellOfCellsThatHangTogetherByLessThanAFace) {
  EXPECT_THAT(notices_of(meshes::box_without(CellType::hexahedron, {0, 13})),
              Contains(HasSubstr("touches itself at 1 node, the first at (0.333333, 0.333333")));
  const meshes::Mesh corners = meshes::box_without(CellType::quadrilateral, {1, 3, 5, 7});
  EXPECT_THAT(notices_of(corners), Contains(HasSubstr("5 parts of cells hang together")));
  EXPECT_THAT(notices_of(meshes::box_without(CellType::hexahedron, {13})),
              Each(Not(HasSubstr("less than a face"))));
}

}  // namespace
}  // namespace diptych::harness
