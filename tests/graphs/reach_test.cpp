/// Supports of particles that do not reach from layer to layer, or hardly do: rings of cells that
/// are longer through the wall than around.

#include "sph/reach.hpp"

#include "common/base/error.hpp"
#include "meshes/gmsh.hpp"
#include "sph/sph_graph.hpp"
#include "tests/folders.hpp"
#include "tests/graphs/curved_meshes.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;

/// Wall 0.5 of a ring of mean radius 0.75, n cells through it.
meshes::Mesh wall(int n_around, int n) {
  return ring(n_around, n, 0);
}

TEST(Reach, LayersWithoutPairsAreRefused) {
  // without it they move by themselves: a ring under pressure had 1.48 of its displacement inside
  // and none outside, status "done"
  try {
    (void)sph::operators_on(wall(284, 5), {});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("do not reach from layer to layer"));
  }
}

TEST(Reach, LayersThatAreHardlySeenHaveANotice) {
  EXPECT_THAT(sph::operators_on(wall(140, 5), {}).notices,
              testing::Contains(HasSubstr("the tail of the kernel")));
  for (const meshes::Mesh& mesh : {wall(48, 5), disc(4, 3)})
    EXPECT_TRUE(sph::operators_on(mesh, {}).notices.empty());
}

TEST(Reach, OfLongCellsOfABoxEllipsoidsSee) {
  const meshes::Mesh mesh =
      meshes::box(meshes::CellType::quadrilateral, {0, 0, 0}, {1, 10, 0}, {10, 10, 0});
  EXPECT_TRUE(sph::operators_on(mesh, {}).notices.empty());
}

// The wall of a ring is one triangle thick, with a node inside here and there: rows that reach far
// enough to have no large weights did not see it bend, a pinched ring was 4.3 times too stiff.
TEST(Reach, OfRowsThatNoLongerSeeAWallBendIsRefused) {
  const meshes::Mesh mesh =
      meshes::read_msh(tests::source_folder() + "/tests/meshes/thin_ring.msh");
  sph::Options options;
  options.gradient = "auto";
  const scheme::Operators chosen = sph::operators_on(mesh, options);
  EXPECT_THAT(chosen.text, HasSubstr("corrected gradient"));
  EXPECT_THAT(chosen.notices, testing::Contains(HasSubstr("one cell thick there: refine them")));
  options.gradient = "sbp";
  EXPECT_THROW((void)sph::operators_on(mesh, options), base::InputError);
}

}  // namespace
}  // namespace diptych::graphs
