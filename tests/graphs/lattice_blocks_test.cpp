/// Blocks that meshes of hexahedra and quadrilaterals fall into.

#include "meshes/lattice_blocks.hpp"

#include "meshes/renumber.hpp"
#include "tests/graphs/curved_meshes.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <random>

namespace diptych::graphs {
namespace {

using meshes::LatticeBlock;
using testing::ElementsAre;
using testing::IsEmpty;
using Sizes = std::vector<std::vector<int>>;

/// Cells of each block along its directions, ascending, those of rings negative.
Sizes sizes_of(const std::vector<LatticeBlock>& blocks) {
  Sizes sizes;
  for (const LatticeBlock& block : blocks) {
    auto& of_block = sizes.emplace_back();
    for (int d = 0; d < block.dimension; ++d)
      of_block.push_back(block.is_closed[d] ? -block.n_cells[d] : block.n_cells[d]);
    std::sort(of_block.begin(), of_block.end());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

Sizes sizes_of(const meshes::Mesh& mesh) {
  return sizes_of(meshes::lattice_blocks(mesh));
}

TEST(LatticeBlocks, AreWhatMeshesAreMadeOf) {
  using V = std::vector<int>;
  EXPECT_THAT(sizes_of(curved_block(7, 0)), ElementsAre(V{7, 7}));
  EXPECT_THAT(sizes_of(curved_block(5, 4)), ElementsAre(V{4, 5, 5}));
  EXPECT_THAT(sizes_of(bent_l(5, 0)), ElementsAre(V{5, 5}, V{5, 5}, V{5, 5}));
  EXPECT_THAT(sizes_of(bent_l(4, 3)), ElementsAre(V{3, 4, 4}, V{3, 4, 4}, V{3, 4, 4}));
  EXPECT_THAT(sizes_of(ring(17, 4, 0)), ElementsAre(V{-17, 4}));
  EXPECT_THAT(sizes_of(ring(16, 3, 5)), ElementsAre(V{-16, 3, 5}));
  EXPECT_THAT(sizes_of(disc(6, 4)), ElementsAre(V{4, 6}, V{4, 6}, V{4, 6}, V{4, 6}, V{6, 6}));
}

/// Every cell stands once, and neighbours on a lattice are neighbours in a cell.
TEST(LatticeBlocks, HoldEveryCellOnceWithItsNodes) {
  for (const meshes::Mesh& mesh : {disc(5, 4), ring(12, 3, 4), bent_l(4, 3)}) {
    std::vector<int> times(mesh.cell_types.size(), 0);
    for (const LatticeBlock& block : meshes::lattice_blocks(mesh)) {
      std::array<int, 3> at{};
      for (at[2] = 0; at[2] < block.n_cells[2]; ++at[2]) {
        for (at[1] = 0; at[1] < block.n_cells[1]; ++at[1]) {
          for (at[0] = 0; at[0] < block.n_cells[0]; ++at[0]) {
            const std::int64_t c = block.cell_at(at);
            ++times[c];
            const auto nodes = mesh.cell(c);
            for (size_t i = 0; i < nodes.size(); ++i) {
              const int bits = static_cast<int>(i);
              const std::int32_t node = block.node[block.index(
                  {at[0] + (bits & 1), at[1] + (bits >> 1 & 1), at[2] + (bits >> 2)})];
              EXPECT_NE(std::find(nodes.begin(), nodes.end(), node), nodes.end());
            }
          }
        }
      }
    }
    EXPECT_THAT(times, testing::Each(1));
  }
}

TEST(LatticeBlocks, DoNotDependOnTheNumberingOfNodesAndCells) {
  for (const meshes::Mesh& mesh : {disc(5, 4), ring(12, 3, 4), bent_l(4, 3)}) {
    std::vector<std::int32_t> order(mesh.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    EXPECT_EQ(sizes_of(meshes::renumbered(mesh, order)), sizes_of(mesh));
  }
}

TEST(LatticeBlocks, EndWhereBoundaryGroupsEnd) {
  meshes::Mesh mesh = curved_block(8, 0);
  meshes::BoundaryGroup& group = mesh.boundary_groups.emplace_back();
  group.name = "part";
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const auto& face = mesh.boundary_faces[f];
    const bool is_low = face.nodes[0] < 4 && face.nodes[1] < 4;  // three edges of y_min
    if (is_low) group.faces.push_back(static_cast<std::int32_t>(f));
  }
  ASSERT_EQ(group.faces.size(), 3U);
  EXPECT_THAT(sizes_of(mesh), ElementsAre(std::vector{3, 8}, std::vector{5, 8}));
}

/// Cells of half the length from x = 0 on, and a wedge: both have a kink there.
TEST(LatticeBlocks, EndAtKinksOfLines) {
  const auto graded = [](const Vec3& X) { return X[0] < 0 ? X : Vec3(X[0] / 2, X[1], X[2]); };
  const auto folded = [](const Vec3& X) { return Vec3(X[0], X[1] + std::abs(X[0]) / 4, X[2]); };
  for (const Map& map : {Map(graded), Map(folded)}) {
    const meshes::Mesh mesh = mapped_box({-1, 0, 0}, {1, 1, 1}, {10, 4, 3}, map);
    EXPECT_THAT(sizes_of(mesh), ElementsAre(std::vector{3, 4, 5}, std::vector{3, 4, 5}));
  }
  const auto smooth = [](const Vec3& X) { return Vec3(std::exp(X[0]), X[1], X[2]); };
  EXPECT_EQ(sizes_of(mapped_box({-1, 0, 0}, {1, 1, 1}, {10, 4, 3}, smooth)).size(), 1U);
}

TEST(LatticeBlocks, AreNoneOfOtherCellsAndOfRingsThatTurn) {
  EXPECT_THAT(
      meshes::lattice_blocks(meshes::box(CellType::tetrahedron, {0, 0, 0}, {1, 1, 1}, {2, 2, 2})),
      IsEmpty());
  // a bar closed after a quarter of a turn about its axis
  const meshes::Mesh turned =
      glued({mapped_box({0, -0.5, -0.5}, {1, 0.5, 0.5}, {24, 2, 2}, [](const Vec3& X) {
        const double angle = 2 * std::numbers::pi * X[0], turn = angle / 4;
        const double r = 2 + X[1] * std::cos(turn) - X[2] * std::sin(turn),
                     z = X[1] * std::sin(turn) + X[2] * std::cos(turn);
        return Vec3(r * std::cos(angle), r * std::sin(angle), z);
      })});
  EXPECT_THAT(meshes::lattice_blocks(turned), IsEmpty());
}

TEST(LatticeBlocks, AreSmoothUnlessNodesAreMovedAtRandom) {
  for (const meshes::Mesh& mesh :
       {curved_block(8, 0), curved_block(6, 6), disc(8, 4), ring(10, 3, 4), bent_l(8, 0)})
    EXPECT_TRUE(meshes::is_smooth(mesh, meshes::lattice_blocks(mesh)));
  EXPECT_TRUE(meshes::is_smooth(ring(16, 1, 8), meshes::lattice_blocks(ring(16, 1, 8))));
  const meshes::Mesh patches = disc(1, 1);
  EXPECT_FALSE(meshes::is_smooth(patches, meshes::lattice_blocks(patches)));
  for (const double share : {0.01, 0.1, 0.3}) {
    for (const int n_z : {0, 8}) {
      meshes::Mesh mesh =
          mapped_box({0, 0, 0}, {1, 1, 1}, {8, 8, n_z}, [](const Vec3& X) { return X; });
      meshes::perturb_interior(mesh, share, 1);
      EXPECT_FALSE(meshes::is_smooth(mesh, meshes::lattice_blocks(mesh))) << share;
    }
  }
}

}  // namespace
}  // namespace diptych::graphs
