/// Lines of nodes from the connectivity, and what is no block.

#include "meshes/structured_block.hpp"

#include "common/base/error.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/renumber.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>

namespace diptych::graphs {
namespace {

using testing::HasSubstr;

meshes::Mesh bricks(int nx, int ny, int nz) {
  return meshes::box(CellType::hexahedron, {0, 0, 0}, {1.0 * nx, 2.0 * ny, 0.5 * nz}, {nx, ny, nz});
}

/// The mesh without some of its cells; nodes that no cell uses any more go too.
template <class Keep>
meshes::Mesh part_of(const meshes::Mesh& whole, const Keep& keep) {
  meshes::Mesh part;
  part.dimension = whole.dimension;
  part.cell_offsets.push_back(0);
  std::vector<std::int32_t> number(whole.nodes.size(), -1);
  for (std::int64_t c = 0; c < whole.n_cells(); ++c) {
    if (!keep(c)) continue;
    part.cell_types.push_back(whole.cell_types[c]);
    for (const std::int32_t a : whole.cell(c)) {
      if (number[a] < 0) {
        number[a] = static_cast<std::int32_t>(part.nodes.size());
        part.nodes.push_back(whole.nodes[a]);
      }
      part.cell_nodes.push_back(number[a]);
    }
    part.cell_offsets.push_back(static_cast<std::int64_t>(part.cell_nodes.size()));
  }
  meshes::find_boundary_faces(part);
  return part;
}

const meshes::BlockUse use{"fvm.stencil = \"sbp\"", "fvm.stencil = \"edge\""};

/// What the mesh is refused with; empty where it is not.
std::string refusal(const meshes::Mesh& mesh) {
  try {
    const meshes::StructuredBlock block = meshes::structured_block(mesh, use);
    meshes::cell_edges(mesh, block, use);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StructuredBlock, FindsTheLinesOfABoxInAnyNumbering) {
  meshes::Mesh mesh = bricks(3, 4, 2);
  std::vector<std::int32_t> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  mesh = meshes::renumbered(mesh, order);
  const meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  std::array<int, 3> n = block.n_nodes;
  std::sort(n.begin(), n.end());
  EXPECT_EQ(n, (std::array<int, 3>{3, 4, 5}));
  const Mat3 edges = meshes::cell_edges(mesh, block, use);
  EXPECT_NEAR(edges.determinant(), 1.0 * 2.0 * 0.5, 1e-14);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    const auto& at = block.place[a];
    EXPECT_EQ(block.node_at(at), a);
    const Vec3 X = mesh.nodes[block.node_at({0, 0, 0})] + edges * Vec3(at[0], at[1], at[2]);
    EXPECT_NEAR((X - mesh.nodes[a]).norm(), 0, 1e-14);
  }
}

TEST(StructuredBlock, FindsTheLinesOfASquare) {
  const meshes::Mesh mesh = meshes::box(CellType::quadrilateral, {0, 0, 0}, {1, 2, 0}, {1, 5, 1});
  const meshes::StructuredBlock block = meshes::structured_block(mesh, use);
  EXPECT_EQ(block.n_nodes, (std::array<int, 3>{2, 6, 1}));
  EXPECT_NEAR(meshes::cell_edges(mesh, block, use).determinant(), 0.4, 1e-15);
}

TEST(StructuredBlock, RefusesSimplices) {
  EXPECT_THAT(refusal(test_box(CellType::tetrahedron, 2, 0)), HasSubstr("is a tetrahedron"));
  EXPECT_THAT(refusal(test_box(CellType::triangle, 2, 0)), HasSubstr("is a triangle"));
  EXPECT_THAT(refusal(test_box(CellType::prism, 2, 0)), HasSubstr("is a prism"));
}

TEST(StructuredBlock, RefusesMovedAndCurvedAndGradedNodes) {
  EXPECT_THAT(refusal(test_box(CellType::hexahedron, 3, 0.1)), HasSubstr("mesh.perturbation"));
  EXPECT_THAT(refusal(test_box(CellType::quadrilateral, 3, 0.1)), HasSubstr("mesh.perturbation"));
  meshes::Mesh curved = bricks(4, 4, 4);
  for (Vec3& X : curved.nodes)
    X[1] += 0.1 * X[0] * X[0];
  EXPECT_THAT(refusal(curved), HasSubstr("off the even lattice"));
  meshes::Mesh graded = bricks(4, 4, 4);
  for (Vec3& X : graded.nodes)
    X[0] = std::pow(X[0], 1.1);
  EXPECT_THAT(refusal(graded), HasSubstr("off the even lattice"));
  EXPECT_THAT(refusal(graded), HasSubstr("use fvm.stencil = \"edge\""));
}

TEST(StructuredBlock, TakesAShearedBlock) {
  meshes::Mesh sheared = bricks(4, 3, 2);
  for (Vec3& X : sheared.nodes)
    X = Vec3(X[0] + 0.3 * X[1], X[1] - 0.2 * X[2], X[2] + 0.1 * X[0]);
  EXPECT_EQ(refusal(sheared), "");
}

TEST(StructuredBlock, RefusesWhatIsMoreOrLessThanABlock) {
  const meshes::Mesh whole = bricks(4, 4, 1);
  const auto column = [](std::int64_t c) { return std::pair(c % 4, c / 4); };
  const meshes::Mesh l_shape = part_of(whole, [&](std::int64_t c) {
    const auto [i, j] = column(c);
    return i < 2 || j < 2;
  });
  EXPECT_THAT(refusal(l_shape), HasSubstr("do not fill"));
  const meshes::Mesh hollow = part_of(whole, [&](std::int64_t c) {
    return column(c) != std::pair<std::int64_t, std::int64_t>(1, 1);
  });
  EXPECT_THAT(refusal(hollow), HasSubstr("do not fill"));
  const meshes::Mesh two = part_of(whole, [&](std::int64_t c) { return column(c).first != 1; });
  EXPECT_THAT(refusal(two), HasSubstr("not connected to cell 0"));
}

/// A ring of quadrilaterals closes on itself: a box whose ends are the same nodes.
TEST(StructuredBlock, RefusesARing) {
  constexpr int around = 12, across = 3;
  meshes::Mesh ring;
  ring.dimension = 2;
  ring.cell_offsets.push_back(0);
  for (int j = 0; j <= across; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around, r = 2 - 0.3 * j;
      ring.nodes.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  }
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around;
      for (const int a :
           {j * around + i, j * around + next, (j + 1) * around + next, (j + 1) * around + i})
        ring.cell_nodes.push_back(a);
      ring.cell_types.push_back(CellType::quadrilateral);
      ring.cell_offsets.push_back(static_cast<std::int64_t>(ring.cell_nodes.size()));
    }
  }
  EXPECT_THAT(refusal(ring), HasSubstr("a ring"));
}

/// Three quadrilaterals around one inner node.
TEST(StructuredBlock, RefusesAnInnerNodeOfThreeCells) {
  meshes::Mesh star;
  star.dimension = 2;
  star.nodes = {{0, 0, 0},  {1, 0, 0},        {0.5, 0.87, 0}, {-0.5, 0.87, 0},
                {-1, 0, 0}, {-0.5, -0.87, 0}, {0.5, -0.87, 0}};
  star.cell_nodes = {0, 1, 2, 3, 0, 3, 4, 5, 0, 5, 6, 1};
  star.cell_types.assign(3, CellType::quadrilateral);
  star.cell_offsets = {0, 4, 8, 12};
  EXPECT_THAT(refusal(star), HasSubstr("other than four cells meet"));
}

}  // namespace
}  // namespace diptych::graphs
