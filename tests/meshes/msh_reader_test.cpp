#include "common/base/error.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/msh/contents.hpp"
#include "tests/folders.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace diptych::meshes {
namespace {

Mesh read_text(const std::string& text) {
  return msh::read_msh_bytes(text, "text.msh");
}

/// A version 2.2 file of the given node and element lines.
std::string version_2(const std::string& names,
                      const std::vector<std::string>& nodes,
                      const std::vector<std::string>& elements) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names;
  text += "$Nodes\n" + std::to_string(nodes.size()) + "\n";
  for (const auto& line : nodes)
    text += line + "\n";
  text += "$EndNodes\n$Elements\n" + std::to_string(elements.size()) + "\n";
  for (const auto& line : elements)
    text += line + "\n";
  return text + "$EndElements\n";
}

const std::vector<std::string> square{"1 0 0 2", "2 1 0 2", "3 1 1 2", "4 0 1 2"};

TEST(MshReader, AllFourFormatsGiveTheSameMesh) {
  const Mesh first = read_msh(block_path(block_files[0]));
  for (const char* file : block_files) {
    SCOPED_TRACE(file);
    const Mesh mesh = read_msh(block_path(file));
    EXPECT_EQ(mesh.dimension, 3);
    EXPECT_EQ(mesh.cell_types, first.cell_types);
    EXPECT_EQ(mesh.cell_nodes, first.cell_nodes);
    ASSERT_EQ(mesh.n_nodes(), first.n_nodes());
    for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
      // ASCII files carry 16 digits: off by one unit in the last place at most.
      EXPECT_LT((mesh.nodes[a] - first.nodes[a]).norm(), 4e-16) << a;
    }
    ASSERT_EQ(mesh.boundary_groups.size(), first.boundary_groups.size());
    for (size_t g = 0; g < mesh.boundary_groups.size(); ++g) {
      EXPECT_EQ(mesh.boundary_groups[g].name, first.boundary_groups[g].name);
      EXPECT_EQ(mesh.boundary_groups[g].faces, first.boundary_groups[g].faces);
    }
  }
}

TEST(MshReader, BlockHasItsVolumeClosedSurfaceAndGroups) {
  for (const char* file : block_files) {
    SCOPED_TRACE(file);
    const Mesh mesh = read_msh(block_path(file));
    // A cell in two volume groups stands twice in version 2.2; taken twice it would double this.
    EXPECT_NEAR(sum_of_cell_volumes(mesh), 0.21, 1e-15);
    EXPECT_LT(area_of_boundary(mesh).norm(), 1e-15);
    EXPECT_LT((area_of_group(mesh, "bottom") - Vec3(0, 0, -0.7)).norm(), 1e-15);
    EXPECT_LT((area_of_group(mesh, "top") - Vec3(0, 0, 0.7)).norm(), 1e-15);
    EXPECT_EQ(mesh.group("ends").faces.size(),
              mesh.group("top").faces.size() + mesh.group("bottom").faces.size());
    EXPECT_LT((area_of_group(mesh, "9") - Vec3(0, -0.3, 0)).norm(), 1e-15) << "unnamed: its tag";
  }
}

TEST(MshReader, PlaneMeshOfTrianglesAndQuadrilateralsLosesItsConstantZ) {
  auto nodes = square;
  nodes.insert(nodes.end(), {"5 2 0.5 2", "99 7 7 7"});
  const Mesh mesh = read_text(
      version_2("$PhysicalNames\n1\n1 4 \"left\"\n$EndPhysicalNames\n", nodes,
                {"1 1 2 4 1 4 1", "2 3 2 1 1 1 2 3 4", "3 2 2 1 1 2 5 3", "4 15 2 8 1 2"}));
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.n_nodes(), 5) << "node 99 belongs to no cell";
  for (const Vec3& node : mesh.nodes)
    EXPECT_EQ(node[2], 0.0);
  EXPECT_DOUBLE_EQ(sum_of_cell_volumes(mesh), 1.5);
  EXPECT_EQ(area_of_group(mesh, "left"), Vec3(-1, 0, 0));
}

TEST(MshReader, PlaneSeenFromBelowIsTurnedAroundAsAWhole) {
  const Mesh mesh = read_text(version_2("", square, {"1 2 2 0 1 1 3 2", "2 2 2 0 1 1 4 3"}));
  EXPECT_NO_THROW(check_cells(mesh, "turned"));
  EXPECT_DOUBLE_EQ(sum_of_cell_volumes(mesh), 1);
  EXPECT_DOUBLE_EQ(volume_inside_boundary(mesh), 1);
}

TEST(MshReader, MirroredSolidsOfEveryTypeAreTurnedAround) {
  const std::vector<std::string> nodes{"1 0 0 0", "2 -1 0 0", "3 -1 1 0", "4 0 1 0",
                                       "5 0 0 1", "6 -1 0 1", "7 -1 1 1", "8 0 1 1"};
  const auto volume = [&](const std::string& element) {
    const Mesh mesh = read_text(version_2("", nodes, {element}));
    check_cells(mesh, "turned");
    return volume_inside_boundary(mesh);
  };
  EXPECT_DOUBLE_EQ(volume("1 5 2 0 1 1 2 3 4 5 6 7 8"), 1);
  EXPECT_DOUBLE_EQ(volume("1 6 2 0 1 1 2 4 5 6 8"), 0.5);
  EXPECT_DOUBLE_EQ(volume("1 4 2 0 1 1 2 4 5"), 1. / 6);
}

TEST(MshReader, HexahedraAndPrismsShareFaces) {
  const Mesh mesh = read_text(
      version_2("",
                {"10 0 0 0", "20 1 0 0", "30 1 1 0", "40 0 1 0", "50 0 0 1", "60 1 0 1", "70 1 1 1",
                 "80 0 1 1", "900000000 2 0 0", "1000000000 2 0 1"},
                {"1 5 0 10 20 30 40 50 60 70 80", "7 6 0 20 900000000 30 60 1000000000 70"}));
  EXPECT_EQ(mesh.boundary_faces.size(), 9u);
  EXPECT_DOUBLE_EQ(sum_of_cell_volumes(mesh), 1.5);
  EXPECT_DOUBLE_EQ(volume_inside_boundary(mesh), 1.5);
}

TEST(MshReader, NodesAreOrderedByTagWhateverTheirOrderInTheFile) {
  const std::vector<std::string> elements{"1 3 2 0 1 1 2 3 4"};
  const Mesh mesh = read_text(version_2("", square, elements));
  const Mesh other =
      read_text(version_2("", {square[2], square[0], square[3], square[1]}, elements));
  EXPECT_EQ(mesh.nodes, other.nodes);
  EXPECT_EQ(mesh.cell_nodes, other.cell_nodes);
}

TEST(MshReader, NamesMayHoldQuotesBlanksAndUtf8AndLinesMayEndInCrLf) {
  const std::string text = version_2(
      "$Comments\n$Nodes\n$EndComments\n$PhysicalNames\n2\n1 4 \"../a \"b\"\"\n1 5 \"groß\"\n"
      "$EndPhysicalNames\n",
      square, {"1 1 2 4 1 4 1", "2 1 2 5 1 1 2", "3 3 2 1 1 1 2 3 4"});
  std::string with_cr;
  for (const char c : text) {
    if (c == '\n') with_cr += '\r';
    with_cr += c;
  }
  for (const auto& variant : {text, with_cr}) {
    const Mesh mesh = read_text(variant);
    EXPECT_EQ(area_of_group(mesh, "../a \"b\""), Vec3(-1, 0, 0));
    EXPECT_EQ(area_of_group(mesh, "groß"), Vec3(0, -1, 0));
  }
}

TEST(MshReader, Version4WithoutEntitiesAndWithParametricNodesIsRead) {
  const Mesh mesh = read_text(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 1 4\n0 1 0 1\n1\n0 0 0\n2 1 1 3\n2\n3\n4\n"
      "1 0 0 0.5 0.5\n1 1 0 0.5 0.5\n0 1 0 0.5 0.5\n$EndNodes\n$Elements\n1 1 1 1\n2 1 3 1\n"
      "1 1 2 3 4\n$EndElements\n$Periodic\n0\n$EndPeriodic\n");
  EXPECT_DOUBLE_EQ(sum_of_cell_volumes(mesh), 1);
  EXPECT_TRUE(mesh.boundary_groups.empty());
}

TEST(MshReader, HangingNodeIsRefused) {
  auto nodes = square;
  nodes.insert(nodes.end(), {"5 1 0.5 2", "6 2 0 2"});
  const std::string text = version_2("", nodes, {"1 3 2 0 1 1 2 3 4", "2 2 2 0 1 2 6 5"});
  const std::string message = input_error_of([&] { read_text(text); });
  EXPECT_NE(message.find("text.msh: a node at (1, 0.5, 0) lies on the edge"), std::string::npos)
      << message;
}

TEST(MshReader, MissingFileAndFolderAreNamed) {
  const auto message = [](const std::string& path) {
    return input_error_of([&] { read_msh(path); });
  };
  EXPECT_NE(message("no/such.msh").find("no/such.msh: the mesh file cannot be opened"),
            std::string::npos);
  EXPECT_NE(message(tests::tests_folder()).find("not a regular file"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("not a regular file"), std::string::npos);
  // a file as a folder, and a name that no file system takes
  const std::string file = tests::tests_folder() + "/meshes/block_41.msh";
  EXPECT_NE(message(file + "/a.msh").find("cannot be opened: Not a directory"), std::string::npos);
  EXPECT_NE(message(std::string(5000, 'a')).find("File name too long"), std::string::npos);
}

/// One with nothing but a size: what it says is not read.
TEST(MshReader, AFileThatLeavesNoMemoryForTheMeshIsRefusedUnread) {
  const std::string path = testing::TempDir() + "diptych_large.msh";
  std::ofstream(path) << "$MeshFormat\n";
  std::filesystem::resize_file(path, std::uintmax_t{1} << 42);
  try {
    read_msh(path);
    ADD_FAILURE() << "accepted";
  } catch (const base::EnvironmentError& error) {
    EXPECT_NE(
        std::string(error.what()).find("4398046511104 bytes; a mesh file of more than a quarter"),
        std::string::npos)
        << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace diptych::meshes
