/// The shipped data is found beside the program, wherever both have gone.

#include "benchmarks/run/data_folder.hpp"

#include "common/base/error.hpp"
#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Folder;

/// The folder of cases for a program at `program`, both within `folder`.
std::string cases_for(const Folder& folder, const std::string& program) {
  return data_folder("cases", data_places(folder.path() / program));
}

TEST(DataFolder, IsThatOfTheInstallationBeforeAnyOther) {
  const Folder folder;
  fs::create_directories(folder.path() / "usr/share/diptych/cases");
  fs::create_directories(folder.path() / "benchmarks/cases");
  EXPECT_EQ(cases_for(folder, "usr/bin/diptych"), folder.path() / "usr/share/diptych/cases");
}

TEST(DataFolder, IsThatOfTheTreeAroundTheBuildWhereverItHasGone) {
  const Folder folder;
  fs::create_directories(folder.path() / "moved/benchmarks/cases");
  EXPECT_EQ(cases_for(folder, "moved/build/release/diptych"),
            folder.path() / "moved/benchmarks/cases");
}

TEST(DataFolder, IsThatOfTheSourcesForAProgramThatWasCopiedAlone) {
  const Folder folder;
  EXPECT_EQ(cases_for(folder, "bin/diptych"),
            fs::path(tests::source_folder()) / "benchmarks/cases");
}

TEST(DataFolder, IsTheCopyBesideTheProgramWhereTheSourcesAreGone) {
  const Folder folder;
  fs::create_directories(folder.path() / "b/share/diptych/cases");
  auto places = data_places(folder.path() / "b/diptych");
  places[2] = folder.path() / "gone";
  EXPECT_EQ(data_folder("cases", places), folder.path() / "b/share/diptych/cases");
}

TEST(DataFolder, ThatIsNowhereNamesWhereItWasLookedFor) {
  const Folder folder;
  try {
    data_folder("cases", {folder.path() / "a", folder.path() / "b"});
    FAIL() << "found";
  } catch (const base::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder.path() / "a/cases").string()));
    EXPECT_THAT(error.what(), HasSubstr((folder.path() / "b/cases").string()));
  }
}

TEST(DataFolder, OfTheProgramIsServedByAProgramWhoseTreeHasMoved) {
  const Folder folder;  // the program alone with the data that a tree has
  const fs::path tree = folder.path() / "tree";
  fs::create_directories(tree / "build/release");
  fs::create_directories(tree / "benchmarks/cases");
  fs::copy_file(tests::build_folder() + "/diptych", tree / "build/release/diptych");
  fs::copy(fs::path(tests::source_folder()) / "benchmarks/cases/impact",
           tree / "benchmarks/cases/here", fs::copy_options::recursive);
  const auto listed = tests::run_program(folder, (tree / "build/release/diptych").string(), "list");
  EXPECT_EQ(listed.exit_code, 0) << listed.text;
  EXPECT_THAT(listed.text, HasSubstr("here "));
  EXPECT_THAT(listed.text, testing::Not(HasSubstr("swinging-cube")));
}

}  // namespace
}  // namespace diptych::harness
