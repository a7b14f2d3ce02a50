/// Neighbours through the body alone: a slot narrower than the support parts its two sides, and a
/// convex body keeps all pairs.

#include "sph/gaps.hpp"

#include "meshes/generators.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace diptych::sph {
namespace {

using meshes::CellType;

/// Of equal radii.
Rows neighbours_of(const meshes::Mesh& mesh, double radius) {
  return find_neighbours(mesh.nodes, std::vector<double>(mesh.nodes.size(), radius));
}

TEST(Gaps, AConvexBodyKeepsAllPairs) {
  for (const CellType type : {CellType::triangle, CellType::tetrahedron, CellType::hexahedron}) {
    meshes::Mesh mesh = meshes::box(type, {0, 0, 0}, {1, 1, 1}, {6, 6, 6});
    meshes::perturb_interior(mesh, 0.2, 3);
    Rows rows = neighbours_of(mesh, 2.4 / 6);
    const Rows all = rows;
    drop_pairs_across_gaps(mesh, rows);
    EXPECT_EQ(rows.neighbour, all.neighbour);
    EXPECT_EQ(rows.row, all.row);
  }
}

/// A square of 12 x 12 cells without the cells of column 6 above the third row: two tines.
meshes::Mesh fork() {
  const meshes::Mesh whole =
      meshes::box(CellType::quadrilateral, {0, 0, 0}, {12, 12, 0}, {12, 12, 1});
  meshes::Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = whole.nodes;
  mesh.cell_offsets.assign(1, 0);
  for (std::int64_t c = 0; c < whole.n_cells(); ++c) {
    meshes::Vec3 middle = meshes::Vec3::Zero();
    for (const std::int32_t a : whole.cell(c))
      middle += whole.nodes[a] / 4;
    if (middle[0] > 6 && middle[0] < 7 && middle[1] > 3) continue;
    mesh.cell_types.push_back(whole.cell_types[c]);
    for (const std::int32_t a : whole.cell(c))
      mesh.cell_nodes.push_back(a);
    mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
  }
  return mesh;
}

TEST(Gaps, ASlotOfOneCellPartsItsSides) {
  const meshes::Mesh mesh = fork();
  Rows rows = neighbours_of(mesh, 2.4);
  const std::int64_t n_all = static_cast<std::int64_t>(rows.neighbour.size());
  drop_pairs_across_gaps(mesh, rows);
  EXPECT_LT(static_cast<std::int64_t>(rows.neighbour.size()), n_all);
  for (std::int32_t a = 0; a < mesh.n_nodes(); ++a) {
    const meshes::Vec3& X = mesh.nodes[a];
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const std::int32_t b = rows.neighbour[p];
      const auto begin = rows.neighbour.begin();
      EXPECT_TRUE(std::binary_search(begin + rows.row[b], begin + rows.row[b + 1], a));
      const bool is_across = (X[0] - 6.5) * (mesh.nodes[b][0] - 6.5) < 0;
      // around the end of the slot at height 3, not along it
      EXPECT_FALSE(is_across && X[1] > 4 && mesh.nodes[b][1] > 4) << X.transpose();
    }
  }
}

/// Two sides of a slit whose nodes stand at the same place, as Gmsh leaves a crack, but for a part
/// of their spacing.
TEST(Gaps, TheEndOfASlitJoinsOnlyWhatIsBesideIt) {
  meshes::Mesh mesh = fork();
  for (meshes::Vec3& X : mesh.nodes) {  // the slot becomes a fifth as wide, the right side follows
    if (X[0] > 6.5) X[0] -= 0.8;
  }
  Rows rows = neighbours_of(mesh, 2.4);
  const meshes::Vec3 end(6.1, 3, 0);
  const auto n_across = [&](const auto& look) {
    int n = 0;
    for (std::int32_t a = 0; a < mesh.n_nodes(); ++a) {
      const meshes::Vec3& X = mesh.nodes[a];
      for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
        const meshes::Vec3& Y = mesh.nodes[rows.neighbour[p]];
        if ((X[0] < end[0]) == (Y[0] < end[0]) || X[1] < 3.5 || Y[1] < 3.5) continue;
        ++n;
        look(X, Y);
      }
    }
    return n;
  };
  const int n_before = n_across([](const auto&, const auto&) {});
  drop_pairs_across_gaps(mesh, rows);
  const int n_left = n_across([&](const meshes::Vec3& X, const meshes::Vec3& Y) {
    EXPECT_LT((X - end).norm() + (Y - end).norm(), 2.2 * (X - Y).norm())
        << X.transpose() << " and " << Y.transpose();
  });
  EXPECT_LT(10 * n_left, n_before);
}

}  // namespace
}  // namespace diptych::sph
