#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/hanging_nodes.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

const std::vector<Vec3> two_cubes{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
const std::vector<std::int32_t> left_cube{0, 1, 4, 3, 6, 7, 10, 9};
const std::vector<std::int32_t> right_cube{1, 2, 5, 4, 7, 8, 11, 10};

std::string fault_in_faces(Mesh mesh) {
  return input_error_of([&] { find_boundary_faces(mesh); });
}

TEST(BoundaryFaces, SharedFaceIsNoneAndOrderIsThatOfCells) {
  Mesh mesh = mesh_of(3, two_cubes,
                      {{CellType::hexahedron, left_cube}, {CellType::hexahedron, right_cube}});
  find_boundary_faces(mesh);
  ASSERT_EQ(mesh.boundary_faces.size(), 10u);
  EXPECT_LT(area_of_boundary(mesh).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(volume_inside_boundary(mesh), 2);
  EXPECT_EQ(mesh.boundary_faces[0].nodes, (std::array<std::int32_t, 4>{0, 3, 4, 1}));
  EXPECT_EQ(mesh.boundary_faces[9].nodes, (std::array<std::int32_t, 4>{5, 4, 10, 11}));
}

TEST(BoundaryFaces, FaceOfThreeCellsIsRefused) {
  const Mesh mesh = mesh_of(2, {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}},
                            {{CellType::triangle, {0, 1, 2}},
                             {CellType::triangle, {1, 0, 3}},
                             {CellType::triangle, {0, 1, 4}}});
  EXPECT_NE(fault_in_faces(mesh).find("belongs to 3 cells (numbers 0, 1, 2)"), std::string::npos);
}

TEST(BoundaryFaces, OverlappingCellsAreRefused) {
  const Mesh twice =
      mesh_of(3, two_cubes, {{CellType::hexahedron, left_cube}, {CellType::hexahedron, left_cube}});
  EXPECT_NE(fault_in_faces(twice).find("same side"), std::string::npos);
  const Mesh plane = mesh_of(2, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                             {{CellType::triangle, {0, 1, 2}}, {CellType::triangle, {0, 1, 3}}});
  EXPECT_NE(fault_in_faces(plane).find("same side"), std::string::npos);
}

TEST(BoundaryFaces, TwistedQuadrilateralOfTheSameNodesIsRefused) {
  auto twisted = right_cube;
  std::swap(twisted[3], twisted[7]);  // the left face of the right cube becomes a bow tie
  const Mesh mesh =
      mesh_of(3, two_cubes, {{CellType::hexahedron, left_cube}, {CellType::hexahedron, twisted}});
  EXPECT_NE(fault_in_faces(mesh).find("same side"), std::string::npos);
}

TEST(BoundaryFaces, TetrahedraAgainstAHexahedronAreRefused) {
  const Mesh mesh = mesh_of(3, two_cubes,
                            {{CellType::hexahedron, left_cube},
                             {CellType::tetrahedron, {1, 2, 4, 7}},
                             {CellType::tetrahedron, {4, 2, 10, 7}}});
  EXPECT_NE(fault_in_faces(mesh).find("pyramids"), std::string::npos);
}

std::string fault_on_edges(Mesh mesh) {
  find_boundary_faces(mesh);
  return input_error_of([&] { refuse_hanging_nodes(mesh); });
}

TEST(HangingNodes, NodeOnAnEdgeOfACoarserCellIsRefused) {
  const Mesh mesh =
      mesh_of(2, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0.5, 0}, {2, 0, 0}, {2, 0.5, 0}},
              {{CellType::quadrilateral, {0, 1, 2, 3}}, {CellType::quadrilateral, {1, 5, 6, 4}}});
  EXPECT_NE(fault_on_edges(mesh).find("a node at (1, 0.5, 0)"), std::string::npos);
}

TEST(HangingNodes, PartsThatTouchWithoutSharedNodesAreRefused) {
  Mesh mesh = box(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const Mesh other = box(CellType::hexahedron, {1, 0, 0}, {2, 1, 1}, {1, 1, 1});
  for (const std::int32_t node : other.cell_nodes)
    mesh.cell_nodes.push_back(node + 8);
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  mesh.cell_types.push_back(CellType::hexahedron);
  mesh.cell_offsets.push_back(16);
  EXPECT_NE(fault_on_edges(mesh).find("without shared nodes"), std::string::npos);
  for (size_t a = 8; a < 16; ++a)
    mesh.nodes[a][0] += 1e-6;
  EXPECT_EQ(fault_on_edges(mesh), "") << "a gap of 1e-6 of the edge separates the parts";
}

TEST(HangingNodes, SoundMeshesOfVeryDifferentEdgesPass) {
  EXPECT_EQ(fault_on_edges(box(CellType::tetrahedron, {0, 0, 0}, {1, 1e-3, 1e3}, {3, 4, 5})), "");
  EXPECT_EQ(fault_on_edges(box(CellType::triangle, {-1, 0, 0}, {1, 1e-4, 0}, {9, 2, 0})), "");
  EXPECT_EQ(fault_on_edges(box(CellType::hexahedron, {1e6, 0, 0}, {1e6 + 1, 1, 1}, {8, 2, 2})), "");
}

}  // namespace
}  // namespace diptych::meshes
