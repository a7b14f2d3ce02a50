#include "meshes/cell_checks.hpp"
#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

TEST(PerturbInterior, MovesEveryInteriorNodeWithinTheFractionAndNoOther) {
  for (const CellType type : {CellType::quadrilateral, CellType::tetrahedron}) {
    const Mesh original = box(type, {0, 0, 0}, {1, 1, 1}, {5, 5, 5});
    Mesh mesh = original;
    perturb_interior(mesh, 0.2, 7);
    double largest = 0;
    for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
      const Vec3& x = original.nodes[a];
      bool is_interior = true;
      for (int d = 0; d < mesh.dimension; ++d)
        is_interior &= x[d] > 0.1 && x[d] < 0.9;
      const Vec3 shift = mesh.nodes[a] - x;
      EXPECT_EQ(is_interior, shift.norm() > 0) << a;
      largest = std::max(largest, shift.cwiseAbs().maxCoeff());
    }
    // Least edge 0.2: at most 0.04 in each direction, and some shift comes near that.
    EXPECT_LE(largest, 0.04 * (1 + 1e-14));
    EXPECT_GT(largest, 0.03);
    EXPECT_NO_THROW(check_cells(mesh, "perturbed"));
    EXPECT_NEAR(sum_of_cell_volumes(mesh), 1, 1e-13);
  }
}

TEST(PerturbInterior, RepeatsWithItsSeedAndDiffersWithAnother) {
  const Mesh original = box(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  Mesh first = original, again = original, other = original;
  perturb_interior(first, 0.3, 1);
  perturb_interior(again, 0.3, 1);
  perturb_interior(other, 0.3, 2);
  EXPECT_EQ(first.nodes, again.nodes);
  EXPECT_NE(first.nodes, other.nodes);
}

TEST(PerturbInterior, GivesTheSameMeshOnEveryMachine) {
  Mesh mesh = box(CellType::quadrilateral, {0, 0, 0}, {2, 2, 0}, {2, 2, 0});
  perturb_interior(mesh, 0.25, 42);
  // Node 4 by an independent evaluation of SplitMix64 in exact integers.
  EXPECT_EQ(mesh.nodes[4][0], 0x1.346d54b83afcfp+0);
  EXPECT_EQ(mesh.nodes[4][1], 0x1.1f7171222784ap+0);
}

TEST(PerturbInterior, DrawsAgainWhereACellWouldFold) {
  Mesh mesh = box(CellType::tetrahedron, {0, 0, 0}, {1, 1, 1}, {10, 10, 10});
  perturb_interior(mesh, 0.35, 3);  // without new draws some of the 6000 cells fold
  EXPECT_NO_THROW(check_cells(mesh, "perturbed"));
}

TEST(PerturbInterior, NamesAFractionThatWorksWhereTheOneAskedDoesNot) {
  Mesh mesh = box(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {6, 6, 6});
  const Mesh original = mesh;
  const std::string advice = input_error_of([&] { perturb_interior(mesh, 0.45, 1); });
  const size_t at = advice.find("seed, ");
  ASSERT_NE(at, std::string::npos) << advice;
  EXPECT_EQ(mesh.nodes, original.nodes);
  const double fraction = std::stod(advice.substr(at + 6));
  EXPECT_GE(fraction, 0.3) << "which is known to work";
  EXPECT_NO_THROW(perturb_interior(mesh, fraction, 1));
  mesh.nodes = original.nodes;
  EXPECT_NE(input_error_of([&] { perturb_interior(mesh, fraction + 0.01, 1); }), "");
}

TEST(PerturbInterior, ImpossibleFractionsAreRefusedAndLeaveTheMesh) {
  Mesh mesh = box(CellType::quadrilateral, {0, 0, 0}, {1, 1, 0}, {12, 12, 0});
  const auto nodes = mesh.nodes;
  for (const double fraction : {-0.1, std::nan(""), HUGE_VAL, 50.0}) {
    EXPECT_NE(input_error_of([&] { perturb_interior(mesh, fraction, 1); }), "") << fraction;
    EXPECT_EQ(mesh.nodes, nodes);
  }
}

}  // namespace
}  // namespace diptych::meshes
