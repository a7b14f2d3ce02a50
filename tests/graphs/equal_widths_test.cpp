/// Graphs of bodies whose cells are long.

#include "common/scheme/graph/equal_widths.hpp"

#include "fvm/sbp_cells_graph.hpp"
#include "meshes/cell_widths.hpp"
#include "meshes/generators.hpp"
#include "sph/sph_graph.hpp"
#include "tests/graphs/graph_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace diptych::graphs {
namespace {

Vec3 stretch_of(CellType type, double aspect) {
  return is_flat(type) ? Vec3(1, aspect, 1) : Vec3(1, 1, aspect);
}

/// A box whose interior nodes are moved, stretched until its cells are as long as wide in the mean.
meshes::Mesh moved(CellType type) {
  const int n = is_flat(type) ? 6 : 5;
  meshes::Mesh mesh = meshes::box(type, Vec3::Zero(), Vec3::Ones(), {n, n, n});
  meshes::perturb_interior(mesh, 0.2, 3);
  const Mat3 B = meshes::to_equal_widths(meshes::mean_shape(mesh));
  for (Vec3& X : mesh.nodes)
    X = B * X;
  return mesh;
}

meshes::Mesh stretched(meshes::Mesh mesh, const Vec3& by) {
  for (Vec3& X : mesh.nodes)
    X = X.cwiseProduct(by);
  return mesh;
}

TEST(MeanShape, IsTheIdentityOfEqualWidths) {
  for (const CellType type : all_cells) {
    if (type == CellType::prism) continue;  // half a cube is none
    meshes::Mesh mesh = meshes::box(type, Vec3::Zero(), Vec3::Ones(), {4, 4, 4});
    EXPECT_LT((meshes::mean_shape(mesh) - Mat3::Identity()).norm(), 1e-12) << name_of(type);
  }
}

TEST(MeanShape, HasTheAspectOfTheCells) {
  for (const CellType type : {CellType::hexahedron, CellType::quadrilateral}) {
    const auto mesh = meshes::box(type, Vec3::Zero(), stretch_of(type, 4), {3, 3, 3});
    EXPECT_NEAR(meshes::aspect_of(meshes::mean_shape(mesh)), 4, 1e-12);
  }
}

TEST(ShortCells, AreThoseOfEveryCellForItself) {
  for (const CellType type : all_cells) {
    if (type == CellType::prism) continue;  // half a cube is none
    const auto is_short = [type](double stretch) {
      return meshes::has_short_cells(
          meshes::box(type, Vec3::Zero(), stretch_of(type, stretch), {3, 3, 3}));
    };
    EXPECT_TRUE(is_short(1)) << name_of(type);
    EXPECT_TRUE(is_short(1.499)) << name_of(type);
    EXPECT_FALSE(is_short(1.501)) << name_of(type);
  }
  // around a ring, whose mean shape is round
  auto ring = meshes::box(CellType::quadrilateral, Vec3(1, 0, 0), Vec3(1.1, 6.28, 0), {1, 12, 0});
  for (Vec3& X : ring.nodes)
    X = Vec3(X[0] * std::cos(X[1]), X[0] * std::sin(X[1]), 0);
  EXPECT_LT(meshes::aspect_of(meshes::mean_shape(ring)), 1.1);
  EXPECT_FALSE(meshes::has_short_cells(ring));
}

/// By how much, at most, C_ab differ from those of the mesh before it was stretched, as images of
/// them, and volumes from those times the determinant.
double difference(const scheme::PairGraph& before, const scheme::PairGraph& after, const Vec3& by) {
  EXPECT_EQ(before.neighbour, after.neighbour);
  if (before.neighbour != after.neighbour) return 1;
  double largest = 0, most = 0;
  for (size_t p = 0; p < before.C.size(); ++p) {
    const Vec3 back = after.C[p].cwiseProduct(by) / by.prod();
    largest = std::max(largest, before.C[p].norm());
    most = std::max(most, (back - before.C[p]).norm());
  }
  double volumes = 0;
  for (size_t a = 0; a < before.Omega.size(); ++a)
    volumes = std::max(volumes, std::abs(after.Omega[a] / by.prod() / before.Omega[a] - 1));
  return std::max(most / largest, volumes);
}

class EqualWidths : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Aspects, EqualWidths, testing::Values(0.25, 1.5, 4.0, 10.0));

// To the residual with which adjoints are solved for.
TEST_P(EqualWidths, MakeStretchedOperators) {
  for (const CellType type : {CellType::hexahedron, CellType::quadrilateral}) {
    const Vec3 by = stretch_of(type, GetParam());
    const meshes::Mesh mesh = moved(type), longer = stretched(mesh, by);
    EXPECT_LT(difference(fvm::sbp_graph_of_cells(mesh), fvm::sbp_graph_of_cells(longer), by), 1e-3);
    for (const char* gradient : {"corrected", "sbp"}) {
      sph::Options options;
      options.gradient = gradient;
      EXPECT_LT(difference(sph::build_graph(mesh, options), sph::build_graph(longer, options), by),
                1e-3)
          << gradient;
    }
  }
}

TEST_P(EqualWidths, KeepsRowsExactAndClosed) {
  for (const CellType type : all_cells) {
    const meshes::Mesh longer = stretched(moved(type), stretch_of(type, GetParam()));
    const auto quality = scheme::quality(sph::build_graph(longer, {}));
    EXPECT_LT(quality.linear_exactness, 1e-10) << name_of(type);
    EXPECT_LT(quality.closure, 1e-10) << name_of(type);
  }
}

TEST(EqualWidths, LeaveRoundCellsAsTheyAre) {
  int asked = 0;
  const auto mesh = stretched(moved(CellType::hexahedron), {1, 1, 1.08});
  scheme::on_equal_widths(mesh, [&](const meshes::Mesh& given) {
    EXPECT_EQ(given.nodes, mesh.nodes);
    ++asked;
    return scheme::PairGraph{};
  });
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace diptych::graphs
