/// The tree obeys the rules of its rooms, and the rules catch what they should.

#include "tests/folders.hpp"
#include "tests/style/source_tree.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <regex>
#include <sstream>

namespace diptych::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string listed(const std::vector<std::string>& complaints) {
  std::string text;
  for (const auto& complaint : complaints)
    text += "\n  " + complaint;
  return text;
}

class SourceTree : public testing::Test {
 protected:
  static void SetUpTestSuite() { files_ = read_source_tree(source_folder()); }
  template <class Check>
  static std::string complaints(Check check) {
    std::vector<std::string> all;
    for (const auto& file : files_) {
      for (auto& complaint : check(file))
        all.push_back(complaint);
    }
    return listed(all);
  }
  static std::vector<SourceFile> files_;
};
std::vector<SourceFile> SourceTree::files_;

TEST_F(SourceTree, IncludesPointLeftOrDownTheListOfRooms) {
  std::set<std::string> known;
  for (const auto& file : files_)
    known.insert(file.path);
  EXPECT_EQ(complaints([&](const auto& file) { return include_direction(file, known); }), "");
}
TEST_F(SourceTree, ThirdPartyHeadersStandInTheirRoom) {
  EXPECT_EQ(complaints(third_party_rooms), "");
}
TEST_F(SourceTree, FilesAreShortAndHeadersOpenWithADescription) {
  EXPECT_EQ(complaints(file_shape), "");
}
TEST_F(SourceTree, NothingIsLeftUnfinished) {
  EXPECT_EQ(complaints(unfinished_work), "");
}
TEST_F(SourceTree, CitesSectionsThatThePhysicsNotesHave) {
  std::ifstream page(source_folder() + "/common/physics/notes.md");
  const std::string text(std::istreambuf_iterator<char>(page), {});
  const std::set<std::string> sections = section_numbers(text);
  EXPECT_EQ(complaints([&](const auto& file) { return cited_notes(file, sections); }), "");
  // a rule that found no citation would pass for every page
  EXPECT_NE(complaints([](const auto& file) { return cited_notes(file, {}); }), "");
}

TEST_F(SourceTree, HeadersNameTestsThatAreThere) {
  std::set<std::string> known;
  for (const auto& file : files_)
    known.insert(file.path);
  known.insert("tests/bare");
  EXPECT_EQ(complaints([&](const auto& file) { return cited_tests(file, known); }), "");
}

/// The table of CONTRIBUTING.md that says where the formulas stand: each is where it says, and no
/// longer than a mechanician reads at once.
TEST_F(SourceTree, FormulasStandWhereThePageSaysInSixtyLines) {
  std::ifstream stream_of_page(source_folder() + "/CONTRIBUTING.md");
  const std::string page{std::istreambuf_iterator<char>(stream_of_page), {}};
  const std::regex row(R"(\| `(\w+)` \| `([^`]+)`, lines (\d+) to (\d+) \|)");
  int n = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), row), end; it != end; ++it, ++n) {
    const std::string name = (*it)[1], path = (*it)[2];
    const size_t first = std::stoul((*it)[3]), last = std::stoul((*it)[4]);
    const auto file = std::find_if(files_.begin(), files_.end(),
                                   [&](const SourceFile& f) { return f.path == path; });
    ASSERT_NE(file, files_.end()) << path;
    std::vector<std::string> lines{""};
    std::istringstream stream(file->text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    ASSERT_LT(last, lines.size()) << path;
    EXPECT_THAT(lines[first], HasSubstr(name + "(")) << path << ":" << first;
    EXPECT_EQ(lines[last], "}") << path << ":" << last;
    EXPECT_LE(last - first + 1, 60U) << name;
  }
  EXPECT_GE(n, 6);
}

// ---- the rules themselves
TEST(Rooms, AreFoundFromThePath) {
  EXPECT_EQ(room_of("common/physics/materials/x.hpp"), "common/physics");
  EXPECT_EQ(room_of("meshes/mesh.hpp"), "meshes");
  EXPECT_EQ(room_of("sph/kernels/cubic.hpp"), "sph");
  EXPECT_EQ(room_of("tests/common/physics/x_test.cpp"), "tests");
  EXPECT_EQ(room_of("common/x.hpp"), "");
  EXPECT_EQ(room_of("elsewhere/x.hpp"), "");
}

/// Complaints about one include of a file at `path`, with the included file present.
std::vector<std::string> including(const std::string& path, const std::string& included) {
  return include_direction({path, "#include \"" + included + "\"\n"}, {included});
}

TEST(IncludeDirection, AllowsLeftAndDown) {
  EXPECT_THAT(including("common/scheme/a.hpp", "common/physics/b.hpp"), IsEmpty());
  EXPECT_THAT(including("common/run/a.cpp", "common/io/b.hpp"), IsEmpty());
  EXPECT_THAT(including("sph/a.cpp", "meshes/b.hpp"), IsEmpty());
  EXPECT_THAT(including("fvm/a.cpp", "common/scheme/b.hpp"), IsEmpty());
  EXPECT_THAT(including("tests/sph/a_test.cpp", "fvm/b.hpp"), IsEmpty());
  EXPECT_THAT(including("meshes/a.cpp", "meshes/b.hpp"), IsEmpty());
}

TEST(IncludeDirection, RefusesUpwardAndSidewaysIncludes) {
  EXPECT_THAT(including("common/algebra/a.hpp", "common/physics/b.hpp"),
              ElementsAre(HasSubstr("common/algebra/a.hpp:1: common/algebra must not include "
                                    "common/physics")));
  EXPECT_EQ(including("sph/a.cpp", "fvm/b.hpp").size(), 1U);
  EXPECT_EQ(including("fvm/a.cpp", "sph/b.hpp").size(), 1U);
  EXPECT_EQ(including("meshes/a.cpp", "common/physics/b.hpp").size(), 1U);
  EXPECT_EQ(including("common/physics/a.hpp", "common/parallel/b.hpp").size(), 1U);
  EXPECT_EQ(including("common/io/a.hpp", "common/physics/b.hpp").size(), 1U);
  EXPECT_EQ(including("common/run/a.hpp", "sph/b.hpp").size(), 1U);
  EXPECT_EQ(including("postprocess/report/a.hpp", "common/run/b.hpp").size(), 1U);
  EXPECT_EQ(including("common/scheme/a.hpp", "tests/b.hpp").size(), 1U);
}

TEST(IncludeDirection, RefusesRelativeAndMissingFiles) {
  EXPECT_THAT(including("sph/a.cpp", "b.hpp"), ElementsAre(HasSubstr("from the top level")));
  EXPECT_THAT(including("sph/a.cpp", "../meshes/b.hpp"),
              ElementsAre(HasSubstr("from the top level")));
  EXPECT_THAT(include_direction({"sph/a.cpp", "\n#include \"sph/b.hpp\"\n"}, {}),
              ElementsAre(HasSubstr("sph/a.cpp:2: no file sph/b.hpp")));
}

TEST(ThirdParty, StandsInOneRoom) {
  const auto with = [](const std::string& path, const std::string& header) {
    return third_party_rooms({path, "#include <" + header + ">\n"});
  };
  EXPECT_THAT(with("common/algebra/vectors.hpp", "Eigen/Dense"), IsEmpty());
  EXPECT_THAT(with("fvm/a.cpp", "Eigen/Sparse"), IsEmpty());
  EXPECT_THAT(with("common/io/a.cpp", "hdf5.h"), IsEmpty());
  EXPECT_THAT(with("common/base/a.hpp", "fmt/format.h"), IsEmpty());
  EXPECT_THAT(with("meshes/a.cpp", "sys/wait.h"), IsEmpty());
  EXPECT_THAT(with("sph/a.cpp", "vector"), IsEmpty());
  EXPECT_EQ(with("common/physics/a.hpp", "Eigen/Dense").size(), 1U);
  EXPECT_EQ(with("fvm/a.hpp", "Eigen/Sparse").size(), 1U);
  EXPECT_EQ(with("common/scheme/other.cpp", "Eigen/Sparse").size(), 1U);
  EXPECT_EQ(with("common/run/a.cpp", "hdf5.h").size(), 1U);
  EXPECT_EQ(with("common/io/a.cpp", "toml++/toml.h").size(), 1U);
  EXPECT_EQ(with("sph/a.cpp", "gtest/gtest.h").size(), 1U);
  EXPECT_EQ(with("common/run/a.cpp", "nlohmann/json.hpp").size(), 1U);
  EXPECT_EQ(with("postprocess/report/a.cpp", "vtkActor.h").size(), 1U);
  EXPECT_EQ(with("common/scheme/a.cpp", "omp.h").size(), 1U);
  EXPECT_THAT(with("common/mpi/module.cpp", "mpi.h"), IsEmpty());
  EXPECT_EQ(with("common/parallel/a.cpp", "mpi.h").size(), 1U);
  EXPECT_EQ(with("meshes/a.cpp", "metis.h").size(), 1U);
  EXPECT_THAT(with("sph/a.cpp", "boost/any.hpp"), ElementsAre(HasSubstr("unknown library")));
}

TEST(FileShape, WantsShortFilesAndDescribedHeaders) {
  EXPECT_THAT(file_shape({"sph/a.hpp", "#pragma once\n/// What it is.\n"}), IsEmpty());
  EXPECT_THAT(file_shape({"sph/a.hpp", "#pragma once\n\n/// What it is.\n"}), IsEmpty());
  EXPECT_THAT(file_shape({"sph/a.cpp", "int a;\n"}), IsEmpty());
  EXPECT_THAT(file_shape({"sph/a.hpp", "/// What it is.\n"}), ElementsAre(HasSubstr("#pragma")));
  EXPECT_THAT(file_shape({"sph/a.hpp", "#pragma once\nint a;\n"}), ElementsAre(HasSubstr("///")));
  EXPECT_THAT(file_shape({"sph/a.hpp", ""}), ElementsAre(HasSubstr("#pragma"), HasSubstr("///")));
  std::string lines;
  for (int n = 0; n < 450; ++n)
    lines += "int a;\n";
  EXPECT_THAT(file_shape({"sph/a.cpp", lines}), IsEmpty());
  EXPECT_THAT(file_shape({"sph/a.cpp", lines + "int a;\n"}), ElementsAre(HasSubstr("451 lines")));
}

TEST(UnfinishedWork, IsFoundAsAWord) {
  const std::string to_do = std::string("TO") + "DO", fix_me = std::string("FIX") + "ME";
  EXPECT_THAT(unfinished_work({"sph/a.cpp", "int a;  // " + to_do + ": more\n"}),
              ElementsAre(HasSubstr("sph/a.cpp:1")));
  EXPECT_EQ(unfinished_work({"sph/a.cpp", "\n// " + fix_me + "\n"}).size(), 1U);
  EXPECT_THAT(unfinished_work({"sph/a.cpp", "int " + to_do + "S_of_others;\n"}), IsEmpty());
}

TEST(CitedTests, AreFilesOrFolders) {
  const auto citing = [](const std::string& text) {
    return cited_tests({"sph/a.hpp", "#pragma once\n/// Test: " + text + ".\n\nint a;\n"},
                       {"tests/sph/a_test.cpp", "tests/ranks/b_test.cpp"});
  };
  EXPECT_THAT(citing("tests/sph/a_test.cpp, tests/ranks"), IsEmpty());
  EXPECT_THAT(citing("tests/sph/c_test.cpp"), ElementsAre(HasSubstr("tests/sph/c_test.cpp")));
  EXPECT_THAT(citing("tests/rank"), ElementsAre(HasSubstr("tests/rank")));
}

TEST(CitedNotes, AreTheNumbersOfHeadings) {
  EXPECT_THAT(section_numbers("# Notes\n\n## 3 Scheme\n\n3.2 of text\n\n### 3.10 Closure\n#4\n"),
              ElementsAre("3", "3.10"));
}

TEST(CitedNotes, AreFoundWithTheirLine) {
  const std::string cite = std::string("no") + "tes";  // this file cites nothing
  const auto citing = [](const std::string& text) {
    return cited_notes({"sph/a.cpp", text}, {"3", "3.10"});
  };
  EXPECT_THAT(citing("/// As in " + cite + " 3.10 (and " + cite + " 3).\n"), IsEmpty());
  EXPECT_THAT(citing("\n// " + cite + " 3.1.\n"),
              ElementsAre(HasSubstr("sph/a.cpp:2: common/physics/notes.md has no section 3.1")));
  EXPECT_THAT(citing("// (" + cite + " 3.10, 3.2 and 3.4)\n"),
              ElementsAre(HasSubstr("section 3.2"), HasSubstr("section 3.4")));
  EXPECT_THAT(citing("/// (" + cite + "\n/// 4.1)\n"), ElementsAre(HasSubstr("section 4.1")));
  EXPECT_THAT(citing("/// foot" + cite + " 9, " + cite + " of 9 cells\n"), IsEmpty());
}

}  // namespace
}  // namespace diptych::tests
