/// .geo files that run, write or read what a mesh has no need of: each is refused with its line,
/// before gmsh sees it. What gmsh 4.8 does with those marked "it does" was tried: it obeys.

#include "meshes/geo/geo_scan.hpp"

#include "meshes/gmsh.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/stat.h>

namespace diptych::meshes {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A folder with a folder "case" in it, where .geo files are written.
class GeoScan : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "diptych_geo_scan_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::create_directories(folder_ / "case");
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / "case" / name, std::ios::binary) << text;
    return (folder_ / "case" / name).string();
  }
  /// @return what is wrong with a .geo file, or nothing
  std::string offence(const std::string& text) const {
    const std::string path = write("a.geo", text);
    try {
      check_geo(path);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

struct Trick {
  const char* name;
  int line;          ///< of the offence
  const char* text;  ///< HURT stands for a file outside
};

const Trick tricks[] = {
    {"System", 1, "System \"touch HURT\";\n"},
    {"SystemCall", 2, "// a block\nSystemCall \"touch HURT\";\n"},
    {"NonBlocking", 1, "NonBlockingSystemCall \"touch HURT\";\n"},
    {"StringBuilt", 1, "System StrCat(\"touch \", \"HURT\");\n"},
    {"StringVariable", 2, "command = Str(\"touch HURT\");\nSystem command;\n"},
    {"SpreadOverLines", 1, "System // now\n /* then */\n \"touch HURT\";\n"},
    {"PrintfRedirected", 1, "Printf(\"x\") > \"HURT\";\n"},
    {"PrintfAppended", 2,
     "Printf(\"a; b\",\n1); Printf(\"x (%g)\", (1)) // \n >> Str(\"HURT\");\n"},
    {"Save", 1, "Save \"HURT\";\n"},
    {"SaveView", 1, "Save View[0] \"HURT\";\n"},
    {"Print", 1, "Print Sprintf(\"HURT\");\n"},
    {"InBranchNotTaken", 2, "If(0)\nSystem \"touch HURT\";\nEndIf\n"},
    {"BehindEndIfInAString", 2,  // it does
     "If(0)\nPrintf(\"EndIf System 'touch HURT'; //\");\nEndIf\n"},
    {"InACommentBehindACall", 5,  // gmsh comes back to the next line, comment or not
     "Macro M\nx = 1;\nReturn\nCall M; /*\nSystem \"touch HURT\";\n*/\n"},
    {"BehindALongString", 1, ""},  // see below: gmsh ends strings at 1023 characters
    {"InAMacro", 2, "Macro M\nSystem \"touch HURT\";\nReturn\nCall M;\n"},
    {"ExternalField", 1, "Field[1] = ExternalProcess;\nField[1].CommandLine = \"touch HURT\";\n"},
    {"FieldByString", 1, "Field[1] = StringToName[\"ExternalProcess\"];\n"},
    {"Onelab", 1, "OnelabRun(\"touch\", \"HURT\");\n"},
    {"Plugin", 1, "Plugin(NewView).Run;\n"},
    {"CreateDir", 1, "CreateDir \"HURT\";\n"},
    {"MergeFromOutside", 1, "Merge \"../outside.geo\";\n"},
    {"IncludeFromOutside", 1, "Include \"/etc/hostname\";\n"},
    {"IncludeBuilt", 1, "Include StrCat(\"../\", \"outside.geo\");\n"},
    {"MergeVariable", 2, "name = \"inside.geo\";\nMerge name;\n"},
    {"MergeSprintf", 1, "Merge Sprintf(\"%g.geo\", 1);\n"},
    {"MergeThroughALink", 1, "Merge \"link.geo\";\n"},
    {"MergePython", 1, "Merge \"inside.py\";\n"},
    {"MergeCompressed", 1, "Merge \"inside.geo.gz\";\n"},
    {"MergeScriptAsMesh", 1, "Merge \"inside.msh\";\n"},
    {"ListFromDevice", 1, "x() = ListFromFile[\"/dev/zero\"];\n"},
    {"FieldFromDevice", 1, "Field[1].FileName = \"/dev/zero\";\n"},
    {"OptionFile", 1, "General.ErrorFileName = \"HURT\";\n"},
    {"Sleep", 1, "Sleep 1e9;\n"},
    {"CarriageReturn", 1, "x = 1; // \r System \"touch HURT\";\n"},
};

TEST_F(GeoScan, TricksAreRefusedWithTheirLineAndDoNothing) {
  const std::string hurt = (folder_ / "hurt").string();
  std::ofstream(folder_ / "outside.geo") << "SystemCall \"touch " << hurt << "\";\n";
  for (const char* inside : {"inside.py", "inside.geo.gz", "inside.msh", "inside.geo"})
    write(inside, "x = 1;\n");
  fs::create_symlink(folder_ / "outside.geo", folder_ / "case" / "link.geo");
  for (const Trick& trick : tricks) {
    SCOPED_TRACE(trick.name);
    std::string text = trick.text;
    if (text.empty()) text = "x = \"" + std::string(1023, 'a') + "; System 'touch HURT'; //\";\n";
    for (size_t at = text.find("HURT"); at != std::string::npos; at = text.find("HURT"))
      text.replace(at, 4, hurt);
    EXPECT_THAT(offence(text), HasSubstr("a.geo:" + std::to_string(trick.line) + ": "));
    EXPECT_THROW(mesh_geo((folder_ / "case/a.geo").string(), 3, 1, (folder_ / "work").string()),
                 base::InputError);
    EXPECT_FALSE(fs::exists(hurt));
    EXPECT_FALSE(fs::exists(folder_ / "work"));
  }
}

TEST_F(GeoScan, FilesTakenInAreSearchedToo) {
  write("b.geo", "x = 1;\nInclude \"sub/c.pos\";\n");
  fs::create_directories(folder_ / "case/sub");
  write("sub/c.pos", "\n\nSave \"x\";\n");
  EXPECT_THAT(offence("Merge \"b.geo\";\n"), HasSubstr("sub/c.pos:3: Save"));
  write("sub/c.pos", "Include \"../a.geo\"; y = 2;\n");  // in a circle
  EXPECT_EQ(offence("Merge \"b.geo\";\n"), "");
  EXPECT_THAT(offence("x = 1;\nMerge \"none.stl\";\n"),
              HasSubstr("a.geo:2: Merge \"none.stl\": there is no"));
}

TEST_F(GeoScan, TellsOfAllFilesThatAMeshHangsOn) {
  write("b.geo", "x = 1;\nInclude \"sub/c.pos\";\n");
  fs::create_directories(folder_ / "case/sub");
  write("sub/c.pos", "Include \"../a.geo\"; y = 2;\n");
  write("d.stl", "solid\n");
  write("d.stl.opt", "z = 1;\n");
  write("not.geo", "x = 1;\n");
  write("a.geo", "Merge \"b.geo\";\nMerge \"d.stl\";\n");
  std::vector<std::string> names;
  for (const std::string& path : files_read((folder_ / "case/a.geo").string()))
    names.push_back(fs::path(path).filename().string());
  EXPECT_THAT(names,
              testing::UnorderedElementsAre("a.geo", "b.geo", "c.pos", "d.stl", "d.stl.opt"));
}

TEST_F(GeoScan, OptionFilesThatGmshTakesInUnaskedAreSearched) {
  write("a.geo.opt", "SystemCall \"touch hurt\";\n");  // it does
  EXPECT_THAT(offence("x = 1;\n"), HasSubstr("a.geo.opt:1: SystemCall"));
  fs::remove(folder_ / "case/a.geo.opt");
  write("b.stl", "solid\n");
  write("b.stl.opt", "System \"touch hurt\";\n");
  EXPECT_THAT(offence("Merge \"b.stl\";\n"), HasSubstr("b.stl.opt:1: System"));
}

TEST_F(GeoScan, WhatIsNoTextOrNoFileIsRefused) {
  EXPECT_THAT(offence(std::string("x = 1;\n\0", 8)), HasSubstr("a.geo:2: a NUL"));
  const std::string pipe = (folder_ / "case/p.geo").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(offence("Include \"p.geo\";\n"), HasSubstr("there is no such file"));
  EXPECT_THROW(check_geo(pipe), base::InputError);
  EXPECT_THROW(check_geo((folder_ / "case").string()), base::InputError);
}

TEST_F(GeoScan, OrdinaryFilesPass) {
  write("part.geo", "Point(1) = {0, 0, 0};\n");
  write("mesh.msh", "$MeshFormat\n4.1 0 8\n");
  write("cad.step", "ISO-10303-21;\n");
  EXPECT_EQ(
      offence("/* Include the notch. Then Save it. Merge both (System of the paper).\n"
              " Print at 1:1 */\r\n"
              "// Open ends, Save the mesh with File > Save\n"
              "Include \"part.geo\";\nMerge './mesh.msh';\nMerge \"cad.step\";\n"
              "DefineConstant[ h = {0.1, Name \"Printf > x\"} ];\n"
              "Printf(\"h = %g > 0; (2)\", h);\nIf ((h) > 0.5)\n  Error(\"too coarse\");\nEndIf\n"
              "Print.Background = 1; Mesh.SaveAll = 1; Save = 2; System = 3;\n"
              "Macro Hole\n  x = 1;\nReturn\nCall Hole;\n"
              "Field[1] = MathEval;\nField[1].F = \"0.1 + x\";\nBackground Field = 1;\n"
              "Physical Surface(\"Save \") = {1};\n"),
      "");
  EXPECT_EQ(offence(bytes_of_file(block_path("block.geo"))), "");
}

/// Gmsh 4.8 reads of such a line what stands before the first end of a statement (it does).
TEST_F(GeoScan, AsksForAnEndOfTheLastLine) {
  const std::string text = "Point(1) = {0, 0, 0};\nMeshSize{1} = h/8; MeshSize{2, 3} = h;";
  EXPECT_THAT(offence(text), HasSubstr("a.geo:2: the last line has several statements"));
  EXPECT_EQ(offence(text + "\n"), "");
  EXPECT_EQ(offence("Point(1) = {0, 0, 0};\nMeshSize{1} = h;"), "");
  EXPECT_EQ(offence("MeshSize{1} = h; // a comment; of words;"), "");
}

}  // namespace
}  // namespace diptych::meshes
