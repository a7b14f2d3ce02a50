#include "meshes/renumber.hpp"

#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace diptych::meshes {
namespace {

/// A fixed disorder: steps of a number without common divisor.
Mesh disordered(const Mesh& mesh) {
  const std::int64_t n = mesh.n_nodes(), step = 10007;
  EXPECT_EQ(std::gcd(n, step), 1);
  std::vector<std::int32_t> order(n);
  for (std::int64_t i = 0; i < n; ++i)
    order[i] = static_cast<std::int32_t>(i * step % n);
  return renumbered(mesh, order);
}

TEST(RcmOrder, BringsADisorderedBarToTheBandwidthOfItsLayers) {
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = disordered(box(type, {0, 0, 0}, {40, 3, 3}, {40, 3, 3}));
    ASSERT_GT(bandwidth(mesh), 300);
    const Mesh ordered = renumbered(mesh, rcm_order(mesh));
    // Walking along the bar, a level is about a layer of 16 nodes; neighbours are one level apart.
    EXPECT_LE(bandwidth(ordered), 3 * 16);
  }
}

TEST(RcmOrder, IsAPermutationAlsoOfSeparatePartsAndLoneNodes) {
  Mesh mesh =
      mesh_of(2, {{9, 9, 0}, {0, 0, 0}, {5, 0, 0}, {1, 0, 0}, {6, 0, 0}, {0, 1, 0}, {5, 1, 0}},
              {{CellType::triangle, {1, 3, 5}}, {CellType::triangle, {2, 4, 6}}});
  auto order = rcm_order(mesh);
  EXPECT_EQ(order, rcm_order(mesh));
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> all(7);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

TEST(Renumbered, IsTheSameBodyWithTheSameGroups) {
  const Mesh mesh = box(CellType::prism, {0, 0, 0}, {1, 2, 3}, {3, 4, 5});
  const Mesh other = disordered(mesh);
  ASSERT_NE(other.nodes, mesh.nodes);
  EXPECT_NO_THROW(check_cells(other, "renumbered"));
  EXPECT_NEAR(sum_of_cell_volumes(other), 6, 1e-13);
  for (const auto& group : mesh.boundary_groups) {
    EXPECT_EQ(area_of_group(other, group.name), area_of_group(mesh, group.name));
  }
  Mesh found = other;
  find_boundary_faces(found);
  for (size_t f = 0; f < found.boundary_faces.size(); ++f) {
    EXPECT_EQ(found.boundary_faces[f].nodes, other.boundary_faces[f].nodes);
  }
}

}  // namespace
}  // namespace diptych::meshes
