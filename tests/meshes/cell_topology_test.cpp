#include "meshes/cell_topology.hpp"

#include "meshes/cell_checks.hpp"
#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

namespace diptych::meshes {
namespace {

struct Reference {
  CellType type;
  int dimension;
  double volume;
  std::vector<Vec3> nodes;
};

const std::vector<Reference> references{
    {CellType::triangle, 2, 0.5, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
    {CellType::quadrilateral, 2, 1, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
    {CellType::tetrahedron, 3, 1. / 6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {CellType::hexahedron,
     3,
     1,
     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
    {CellType::prism, 3, 0.5, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}};

Mesh single_cell(const Reference& reference) {
  std::vector<std::int32_t> nodes(reference.nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = static_cast<std::int32_t>(i);
  return mesh_of(reference.dimension, reference.nodes, {{reference.type, nodes}});
}

TEST(CellTopology, FacesCloseTheReferenceCellAndPointOutwards) {
  for (const auto& reference : references) {
    SCOPED_TRACE(name_of(reference.type));
    Mesh mesh = single_cell(reference);
    find_boundary_faces(mesh);
    ASSERT_EQ(mesh.boundary_faces.size(), faces_of(reference.type).size());
    EXPECT_LT(area_of_boundary(mesh).norm(), 1e-15);  // sums of a few zeros, ones and halves
    EXPECT_NEAR(cell_volume(mesh, 0), reference.volume, 1e-15);
    const Vec3 centre = centre_of(mesh, 0);
    for (const auto& face : mesh.boundary_faces) {
      EXPECT_GT(area_vector(mesh, face).dot(mesh.nodes[face.nodes[0]] - centre), 0.1);
    }
  }
}

TEST(CellTopology, EdgesFacesAndNodesObeyEuler) {
  for (const auto& reference : references) {
    SCOPED_TRACE(name_of(reference.type));
    const int n_nodes = n_nodes_of(reference.type);
    const int n_edges = static_cast<int>(edges_of(reference.type).size());
    const int n_faces = static_cast<int>(faces_of(reference.type).size());
    EXPECT_EQ(n_nodes, static_cast<int>(reference.nodes.size()));
    EXPECT_EQ(dimension_of(reference.type), reference.dimension);
    if (reference.dimension == 3) {
      EXPECT_EQ(n_nodes - n_edges + n_faces, 2);
    } else {
      EXPECT_EQ(n_nodes, n_edges);
    }
  }
}

TEST(CellChecks, ReferenceCellsAreSoundAndMirroredOnesReversed) {
  for (const auto& reference : references) {
    SCOPED_TRACE(name_of(reference.type));
    Mesh mesh = single_cell(reference);
    EXPECT_EQ(fault_of(mesh, 0), CellFault::none);
    for (Vec3& node : mesh.nodes)
      node[0] = -node[0];
    EXPECT_EQ(fault_of(mesh, 0), CellFault::reversed);
  }
}

TEST(CellChecks, EachFaultIsNamedWithCellAndPlace) {
  const auto message = [](auto&& change) {
    Mesh mesh = single_cell(references[3]);
    change(mesh);
    return input_error_of([&] { check_cells(mesh, "block"); });
  };
  EXPECT_EQ(message([](Mesh&) {}), "");
  const std::string repeated = message([](Mesh& m) { m.cell_nodes[7] = 0; });
  EXPECT_NE(repeated.find("block: cell 0 (hexahedron) at ("), std::string::npos) << repeated;
  EXPECT_NE(repeated.find("same node twice"), std::string::npos) << repeated;
  EXPECT_NE(message([](Mesh& m) { m.cell_nodes[7] = 8; }).find("does not exist"),
            std::string::npos);
  EXPECT_NE(message([](Mesh& m) { m.nodes[3][1] = NAN; }).find("not finite"), std::string::npos);
  EXPECT_NE(message([](Mesh& m) { m.nodes[3] *= 1e200; }).find("far too large"), std::string::npos);
  EXPECT_NE(message([](Mesh& m) { m.nodes[7] = {0, 1, 0}; }).find("degenerate"), std::string::npos);
  EXPECT_NE(message([](Mesh& m) { m.nodes[6] = {0.2, 0.2, 1}; }).find("folded"), std::string::npos);
}

TEST(CellChecks, SliversOfTinyDihedralAnglesAreAccepted) {
  const double height = std::tan(0.1 * M_PI / 180);  // dihedral angle of 0.1 degrees
  Mesh mesh = mesh_of(3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 1, height}},
                      {{CellType::tetrahedron, {0, 1, 2, 3}}});
  EXPECT_EQ(fault_of(mesh, 0), CellFault::none);
}

TEST(MeshGroup, WrongNameAnswersWithTheNearest) {
  Mesh mesh = single_cell(references[3]);
  const auto ask = [&] { return input_error_of([&] { mesh.group("x_mn"); }); };
  EXPECT_NE(ask().find("none at all"), std::string::npos);
  mesh.boundary_groups = {{"x_min", {0}}, {"top", {1}}};
  EXPECT_NE(ask().find("did you mean 'x_min'?"), std::string::npos);
  EXPECT_EQ(mesh.group("top").faces, std::vector<std::int32_t>{1});
}

}  // namespace
}  // namespace diptych::meshes
