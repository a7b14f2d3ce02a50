/// The call of the gmsh program. Its failures are played by small scripts of that name, so that
/// they are tested without gmsh too; what needs the true one is skipped where CMake found none.

#include "meshes/geo/child_program.hpp"
#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <set>

namespace diptych::meshes {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of its own and the PATH of this process, both put back at the end.
class MeshGeo : public testing::Test {
 protected:
  void SetUp() override {
    if (DIPTYCH_GMSH_ALLOWED == 0) GTEST_SKIP() << "configured with DIPTYCH_WITH_GMSH=OFF";
    std::string pattern = (fs::temp_directory_path() / "diptych_mesh_geo_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    path_ = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
    home_ = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  }
  void TearDown() override {
    if (folder_.empty()) return;
    setenv("PATH", path_.c_str(), 1);
    setenv("HOME", home_.c_str(), 1);
    fs::remove_all(folder_);
  }
  void play_gmsh(const std::string& script) {
    const fs::path program = folder_ / "gmsh";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    fs::permissions(program, fs::perms::owner_all);
    setenv("PATH", folder_.c_str(), 1);
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string work() const { return (folder_ / "work").string(); }
  std::string environment_error(const std::string& geo) {
    try {
      mesh_geo(geo, 3, 1, work());
    } catch (const base::EnvironmentError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
  std::string path_, home_;
  const std::string block_ = block_path("block.geo");
};

TEST_F(MeshGeo, WithoutGmshNamesTheDebianPackage) {
  for (const char* path : {"", ":", "/nowhere"}) {
    setenv("PATH", path, 1);
    EXPECT_THAT(environment_error(block_), HasSubstr("apt-get install gmsh")) << path;
  }
}

TEST_F(MeshGeo, GmshInTheCurrentFolderIsNotStarted) {
  play_gmsh("exit 0\n");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  setenv("PATH", "", 1);
  EXPECT_THAT(environment_error(block_), HasSubstr("apt-get install gmsh"));
  fs::current_path(before);
}

TEST_F(MeshGeo, FailureShowsWhatGmshSaidWithoutItsSummary) {
  play_gmsh(
      "echo 'Info    : Reading'\n"
      "echo \"Error   : 'x.geo', line 3: syntax error (;)\" >&2\n"
      "echo 'Error   : ------------------------------' >&2\n"
      "echo 'Error   : Mesh generation error summary' >&2\nexit 1\n");
  const std::string message = input_error_of([&] { mesh_geo(block_, 3, 1, work()); });
  EXPECT_EQ(message, "x.geo:3: gmsh: syntax error (;)");
  play_gmsh("echo 'Error   : Invalid boundary mesh' >&2\nexit 1\n");
  EXPECT_THAT(environment_error(block_),
              HasSubstr("gmsh failed (exit status 1): Invalid boundary"));
}

TEST_F(MeshGeo, KilledSilentAndMeshlessRunsAreErrors) {
  play_gmsh("kill -9 $$\n");
  EXPECT_THAT(environment_error(block_), HasSubstr("killed by signal 9"));
  fs::create_directories(work());
  fs::copy_file(block_path("block_41.msh"), fs::path(work()) / "block.msh");
  play_gmsh("exit 0\n");
  EXPECT_THAT(environment_error(block_), HasSubstr("wrote no mesh")) << "an old mesh must not pass";
  play_gmsh("exec /usr/bin/head -c 5000000 /dev/zero\n");  // more than a pipe holds
  EXPECT_THAT(environment_error(block_), HasSubstr("wrote no mesh"));
}

TEST_F(MeshGeo, WhatIsWrongWithTheMeshIsSaidOfTheGeometry) {
  play_gmsh("for word; do msh=$word; done\necho nonsense > \"$msh\"\n");
  const std::string message = input_error_of([&] { mesh_geo(block_, 3, 1, work()); });
  EXPECT_THAT(message, testing::StartsWith(block_ + ", the mesh that gmsh made of it:1:"));
  EXPECT_THAT(message, testing::Not(HasSubstr(work())));
}

TEST_F(MeshGeo, ArgumentsReachGmshWithoutAShell) {
  const std::string geo = write("a $(touch hurt) b.geo", "// empty\n");
  play_gmsh("for word; do echo \"Error : [$word]\"; done\nexit 1\n");
  try {
    mesh_geo(geo, 2, 0.125, work());
    FAIL() << "the script fails";
  } catch (const base::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("[" + geo + "]"));
    EXPECT_THAT(error.what(), HasSubstr("[-2]"));
  }
}

TEST_F(MeshGeo, BadArgumentsAreWrongInput) {
  const auto message = [&](const std::string& geo, int dimension, double size) {
    return input_error_of([&] { mesh_geo(geo, dimension, size, work()); });
  };
  EXPECT_THAT(message("no/such.geo", 3, 1), HasSubstr("no/such.geo"));
  EXPECT_THAT(message(block_, 1, 1), HasSubstr("dimension 1"));
  EXPECT_THAT(message(block_, 3, 0), HasSubstr("size 0"));
  EXPECT_THAT(message(block_, 3, NAN), HasSubstr("size nan"));
  EXPECT_THAT(message(write("evil.geo", "SystemCall \"touch hurt\";\n"), 3, 1),
              HasSubstr("starts another program"));
}

/// With the true program.
class MeshGeoWithGmsh : public MeshGeo {
 protected:
  void SetUp() override {
    MeshGeo::SetUp();
    if (IsSkipped()) return;
    if (DIPTYCH_GMSH_FOUND == 0) GTEST_SKIP() << "CMake found no gmsh (Debian package gmsh)";
    ASSERT_NE(program_in_path("gmsh"), "") << "CMake found gmsh, but PATH has none";
  }
};

TEST_F(MeshGeoWithGmsh, AllFourFormatsOfAGeometryGiveTheSameMesh) {
  const Mesh mesh = mesh_geo(block_, 3, 0.4, work());
  EXPECT_NEAR(sum_of_cell_volumes(mesh), 0.21, 1e-14);
  EXPECT_GT(mesh.n_cells(), 18);
  for (const char* format : {"msh41", "msh22"}) {
    for (const char* mode : {"-nt", "-bin"}) {
      SCOPED_TRACE(std::string(format) + mode);
      const std::string file = (folder_ / "other.msh").string();
      std::vector<std::string> words{block_, "-3",         "-format", format, "-o",
                                     file,   "-setnumber", "h",       "0.4",  mode};
      if (words.back() == "-nt") words.emplace_back("1");
      ASSERT_EQ(run_child(program_in_path("gmsh"), words, {}).exit_status, 0);
      const Mesh other = read_msh(file);
      EXPECT_EQ(other.cell_nodes, mesh.cell_nodes);
      ASSERT_EQ(other.n_nodes(), mesh.n_nodes());
      for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
        EXPECT_LT((other.nodes[a] - mesh.nodes[a]).norm(), 4e-16);  // 16 digits in ASCII
      }
      for (size_t g = 0; g < mesh.boundary_groups.size(); ++g) {
        EXPECT_EQ(other.boundary_groups.at(g).faces, mesh.boundary_groups[g].faces);
      }
    }
  }
}

TEST_F(MeshGeoWithGmsh, MeshesRepeatAlsoWhereTheFileAsksForHxt) {
  const std::string geo = write("hxt.geo", bytes_of_file(block_) + "Mesh.Algorithm3D = 10;\n");
  const Mesh first = mesh_geo(geo, 3, 0.1, work()), again = mesh_geo(geo, 3, 0.1, work());
  EXPECT_EQ(first.nodes, again.nodes);
  EXPECT_EQ(first.cell_nodes, again.cell_nodes);
  EXPECT_EQ(first.cell_nodes, mesh_geo(block_, 3, 0.1, work()).cell_nodes) << "Delaunay in both";
}

TEST_F(MeshGeoWithGmsh, PlaneRecombinedMeshHasQuadrilateralsAndAnArcGroup) {
  const std::string geo = write(
      "quarter.geo",
      "DefineConstant[ h = 1 ];\nPoint(1) = {0, 0, 0, h};\nPoint(2) = {1, 0, 0, h};\n"
      "Point(3) = {0, 1, 0, h};\nLine(1) = {1, 2};\nCircle(2) = {2, 1, 3};\nLine(3) = {3, 1};\n"
      "Curve Loop(1) = {1, 2, 3};\nPlane Surface(1) = {1};\nRecombine Surface {1};\n"
      "Physical Curve(\"arc\") = {2};\nPhysical Surface(\"body\") = {1};\n");
  const Mesh mesh = mesh_geo(geo, 2, 0.05, work());
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_TRUE(std::ranges::count(mesh.cell_types, CellType::quadrilateral) > 100);
  // Chords of length h leave segments of relative area h^2/6 = 4e-4.
  EXPECT_NEAR(sum_of_cell_volumes(mesh), M_PI / 4, 1e-3);
  EXPECT_LT((area_of_group(mesh, "arc") - Vec3(1, 1, 0)).norm(), 1e-12);
}

TEST_F(MeshGeoWithGmsh, ASizeWithoutEffectIsWrongInput) {
  const auto message = [&](const std::string& first, const std::string& size) {
    const std::string geo = write(
        "square.geo", first + "\nPoint(1) = {0, 0, 0, " + size +
                          "};\nExtrude {1, 0, 0} { Point{1}; }\n"
                          "Extrude {0, 1, 0} { Curve{1}; }\nPhysical Surface(\"body\") = {5};\n");
    return input_error_of([&] { mesh_geo(geo, 2, 0.25, work()); });
  };
  EXPECT_EQ(message("DefineConstant[ h = 0.5 ];", "h"), "");
  EXPECT_THAT(message("h = 0.5;", "h"), HasSubstr("the file sets h = 0.5 itself"));
  EXPECT_THAT(message("// h is not used", "0.5"), HasSubstr("the file does not use h"));
  EXPECT_THAT(message("DefineConstant[ h = 0.5 ];", "0.5"), HasSubstr("the file does not use h"));
  EXPECT_EQ(message("DefineConstant[ h = 0.5 ];\nn = h;", "n"), "");
  EXPECT_EQ(message("DefineConstant[ h = 0.5 ];\nIf (h == 0.25)\n  n = 1;\nEndIf", "0.5"), "");
}

TEST_F(MeshGeoWithGmsh, SyntaxErrorIsWrongInputWithItsLine) {
  const std::string bad = write("bad.geo", "\nPoint(1) = {0, 0;\n");
  EXPECT_THAT(input_error_of([&] { mesh_geo(bad, 3, 1, work()); }),
              testing::StartsWith(bad + ":2: gmsh: syntax error"));
}

TEST_F(MeshGeoWithGmsh, ItsFolderIsAllThatItWrites) {
  setenv("HOME", folder_.c_str(), 1);  // where gmsh leaves settings of its windows
  const std::string geo = write("b.geo", bytes_of_file(block_));
  mesh_geo(geo, 3, 1, work());
  std::set<fs::path> after;
  for (const auto& entry : fs::directory_iterator(folder_))
    after.insert(entry.path().filename());
  EXPECT_EQ(after, (std::set<fs::path>{"b.geo", "work"}));
}

#if DIPTYCH_GMSH_ALLOWED == 0
TEST(MeshGeoOff, SaysHowToConfigure) {
  try {
    mesh_geo(block_path("block.geo"), 3, 1, ".");
    FAIL() << "DIPTYCH_WITH_GMSH=OFF";
  } catch (const base::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("DIPTYCH_WITH_GMSH=OFF"));
  }
}
#endif

}  // namespace
}  // namespace diptych::meshes
