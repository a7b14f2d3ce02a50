/// Cells of a deformed mesh: their J under affine motions, and that an inverted one is seen.

#include "meshes/deformed_cells.hpp"

#include "meshes/cell_checks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/generators.hpp"
#include "meshes/shape_integrals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::meshes {
namespace {

const CellType all_types[] = {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron,
                              CellType::hexahedron, CellType::prism};

DeformedCells::Least least_of(const DeformedCells& cells, const std::vector<Vec3>& u) {
  return cells.outlook(u, {}, 0).now;
}

Mesh moved_box(CellType type) {
  Mesh mesh = box(type, {-1, 0, 2}, {1, 1, 3}, {3, 3, 3});
  perturb_interior(mesh, 0.2, 5);
  return mesh;
}

/// An interior node of the box of three cells a side.
std::int32_t inner_node(const Mesh& mesh) {
  return mesh.dimension == 2 ? 5 : 21;
}

/// The integral of the Jacobian of its shape functions, by Gauss points.
double volume_by_shape_functions(const Mesh& mesh, std::int64_t c) {
  const ReferenceCell& cell = reference_cell(mesh.cell_types[c]);
  double volume = 0;
  for (const QuadraturePoint& point : cell.exact)
    volume += point.weight * jacobian(cell, point, mesh.cell(c), mesh.nodes).determinant();
  return volume;
}

TEST(DeformedCells, SignedVolumeIsThatOfTheShapeFunctions) {
  // sums of some hundred products
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = moved_box(type);
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
      EXPECT_NEAR(signed_volume(mesh, c, mesh.nodes), volume_by_shape_functions(mesh, c), 1e-13);
  }
}

TEST(DeformedCells, AnAffineMotionGivesEveryCellItsDeterminant) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = moved_box(type);
    algebra::Mat3 F;
    F << 1.2, 0.7, 0, -0.3, 0.5, 0, 0, 0, 1;
    if (mesh.dimension == 3) F(2, 0) = 0.4, F(2, 2) = 1.5;
    std::vector<Vec3> u;
    for (const Vec3& X : mesh.nodes)
      u.push_back(F * X - X + Vec3(1, -2, 0));
    const auto least = least_of(DeformedCells(mesh), u);
    EXPECT_NEAR(least.J, F.determinant(), 1e-12);  // cells of 1e-2, some ten roundings of 1e-16
    EXPECT_EQ(least.n_inverted, 0);
    for (size_t a = 0; a < u.size(); ++a)  // mirrored: every cell is inside out
      u[a] = Vec3(-2 * mesh.nodes[a][0], 0, 0);
    const auto mirrored = least_of(DeformedCells(mesh), u);
    EXPECT_NEAR(mirrored.J, -1, 1e-12);
    EXPECT_EQ(mirrored.n_inverted, mesh.n_cells());
  }
}

TEST(DeformedCells, TheOutlookCountsTheStepsThatTheFirstCellHasLeft) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = moved_box(type);
    const std::vector<Vec3> u(mesh.nodes.size(), Vec3::Zero());
    std::vector<Vec3> v;
    for (const Vec3& X : mesh.nodes)
      v.emplace_back(-2 * X[0], 0, 0);
    const auto outlook = DeformedCells(mesh).outlook(u, v, 0.01);
    EXPECT_NEAR(outlook.steps_left, 50, 1e-6) << "a fiftieth of each is lost in a step";
    EXPECT_EQ(outlook.now.J, least_of(DeformedCells(mesh), u).J);
    for (Vec3& of_node : v)
      of_node[0] *= -1;
    EXPECT_GT(DeformedCells(mesh).outlook(u, v, 0.01).steps_left, 1e300) << "all grow";
  }
}

TEST(DeformedCells, EightTogetherHaveTheBitsOfOne) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = moved_box(type);
    std::vector<Vec3> u;
    for (const Vec3& X : mesh.nodes)
      u.emplace_back(0.1 * X[1] * X[0], -0.2 * X[0] * X[0], mesh.dimension == 3 ? 0.1 * X[1] : 0);
    std::vector<Vec3> x(mesh.nodes);
    for (size_t a = 0; a < x.size(); ++a)
      x[a] += u[a];
    double least = 1e300;
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
      least = std::min(least, signed_volume(mesh, c, x) / signed_volume(mesh, c, mesh.nodes));
    EXPECT_EQ(least_of(DeformedCells(mesh), u).J, least);
  }
}

TEST(DeformedCells, OneNodeThatPassesThroughALayerIsSeen) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = box(type, {0, 0, 0}, {3, 3, 3}, {3, 3, 3});
    std::vector<Vec3> u(mesh.nodes.size(), Vec3::Zero());
    const DeformedCells cells(mesh);
    u[inner_node(mesh)] = {0.5, 0, 0};
    EXPECT_GT(least_of(cells, u).J, 0);
    u[inner_node(mesh)] = {9, 0, 0};  // far enough for the mean over eight nodes as well
    EXPECT_LT(least_of(cells, u).J, 0);
    EXPECT_GT(least_of(cells, u).n_inverted, 0);
    EXPECT_LT(least_of(cells, u).n_inverted, mesh.n_cells());
    const auto worst = mesh.cell(least_of(cells, u).cell);
    EXPECT_NE(std::find(worst.begin(), worst.end(), inner_node(mesh)), worst.end());
  }
}

TEST(DeformedCells, ACornerThatIsPushedThroughTheCellIsAFold) {
  for (const CellType type : all_types) {
    SCOPED_TRACE(name_of(type));
    const Mesh mesh = moved_box(type);
    std::vector<Vec3> u(mesh.nodes.size(), Vec3::Zero());
    const DeformedCells cells(mesh);
    EXPECT_EQ(least_of(cells, u).n_folded, 0);
    EXPECT_EQ(least_of(cells, u).folded, -1);
    // most of the way to the other end of a diagonal: the volume of what is no simplex stays above
    // 0
    for (const std::int64_t c : {std::int64_t{0}, mesh.n_cells() - 1}) {
      const auto nodes = mesh.cell(c);
      const std::int32_t corner = nodes[0];
      const Vec3 way = centre_of(mesh, c) - mesh.nodes[static_cast<size_t>(corner)];
      u[static_cast<size_t>(corner)] = 1.2 * way;
    }
    std::vector<Vec3> x(mesh.nodes);
    for (size_t a = 0; a < x.size(); ++a)
      x[a] += u[a];
    std::int64_t n_folded = 0, first = -1;
    for (std::int64_t c = mesh.n_cells() - 1; c >= 0; --c) {
      if (signed_volume(mesh, c, x) <= 0 || least_corner_jacobian(mesh, c, x) > 0) continue;
      ++n_folded;
      first = c;
    }
    EXPECT_EQ(least_of(cells, u).n_folded, n_folded);
    EXPECT_EQ(least_of(cells, u).folded, first);
    if (is_simplex(type)) {
      EXPECT_EQ(n_folded, 0) << "it has the same Jacobian at all corners";
    } else {
      EXPECT_GE(n_folded, 2);
    }
  }
}

TEST(DeformedCells, ADisplacementThatIsNotANumberIsNoSoundCell) {
  const Mesh mesh = box(CellType::hexahedron, {0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  std::vector<Vec3> u(mesh.nodes.size(), Vec3::Zero());
  u[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(least_of(DeformedCells(mesh), u).J));
  EXPECT_EQ(least_of(DeformedCells(mesh), u).n_inverted, 1);
  EXPECT_EQ(least_of(DeformedCells(mesh), u).cell, 0) << "the only one at that corner";
}

}  // namespace
}  // namespace diptych::meshes
