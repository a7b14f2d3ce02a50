/// What `cmake --install` leaves is whole: the program with its cases, man page and completion, and
/// the three tell of the same verbs.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <sstream>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::run_program;
using tests::text_of;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// First words of the lines behind "Subcommands:".
std::vector<std::string> verbs(const Folder& folder) {
  std::istringstream help(diptych(folder, "--help").text);
  std::vector<std::string> verbs;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (listed && !line.empty()) verbs.push_back(words_of(line).at(0));
    if (line == "Subcommands:") listed = true;
  }
  return verbs;
}

TEST(Installation, HasAProgramThatFindsItsCases) {
  const Folder folder;
  const auto installed = run_program(
      folder, "cmake",
      "--install " + tests::build_folder() + " --prefix " + folder.path().string() + "/usr");
  ASSERT_EQ(installed.exit_code, 0) << installed.text;
  const fs::path usr = folder.path() / "usr";
  for (const char* file :
       {"bin/diptych", "share/diptych/cases/impact/case.toml",
        "share/diptych/baselines/impact.json", "share/man/man1/diptych.1.gz",
        "share/bash-completion/completions/diptych", "share/doc/diptych/copyright"})
    EXPECT_TRUE(fs::exists(usr / file)) << file;
  fs::remove_all(usr / "share/diptych/cases/impact");  // then it is this folder that is read
  const auto listed = run_program(folder, (usr / "bin/diptych").string(), "list");
  EXPECT_EQ(listed.exit_code, 0) << listed.text;
  EXPECT_THAT(listed.text, AllOf(HasSubstr("punch "), Not(HasSubstr("\nimpact "))));
}

TEST(Installation, ManPageTellsOfEveryVerb) {
  const Folder folder;
  const std::string page = text_of(tests::source_folder() + "/benchmarks/setup/diptych.1");
  const auto all = verbs(folder);
  EXPECT_GE(all.size(), 11u);
  for (const std::string& verb : all)
    EXPECT_THAT(page, HasSubstr("\n.B " + verb + "\n"));
}

/// What completion offers behind these words, the last of which has been begun.
std::vector<std::string> offered(const Folder& folder, const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words)
    list += "'" + word + "' ";
  const std::string script =
      folder.write("complete.sh", ". " + tests::source_folder() +
                                      "/benchmarks/setup/diptych.bash\n"
                                      "COMP_WORDS=(" +
                                      tests::build_folder() + "/diptych " + list +
                                      ")\nCOMP_CWORD=" + std::to_string(words.size()) +
                                      "\n_diptych\necho \"${COMPREPLY[@]}\"\n");
  return words_of(run_program(folder, "bash", script).text);
}

TEST(Completion, OffersVerbsOptionsCasesAndKeys) {
  const Folder folder;
  EXPECT_THAT(offered(folder, {"co"}), testing::ElementsAre("compare", "converge", "cost"));
  EXPECT_THAT(offered(folder, {"run", "twisting"}), Contains("twisting-column-ve"));
  EXPECT_THAT(offered(folder, {"run", "impact", "--met"}), testing::ElementsAre("--method"));
  EXPECT_THAT(offered(folder, {"run", "impact", "--method", ""}),
              testing::ElementsAre("sph", "fvm", "both"));
  EXPECT_THAT(offered(folder, {"explain", "mesh.ce"}), testing::ElementsAre("mesh.cells"));
}

}  // namespace
}  // namespace diptych
