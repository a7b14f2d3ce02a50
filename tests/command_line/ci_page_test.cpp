/// The page for other people's CI says what works: its commands run in an empty folder, and its
/// files of GitHub and GitLab run the same commands.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <vector>
#include <yaml-cpp/yaml.h>

namespace diptych {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::SizeIs;
using tests::text_of;

/// A fenced block, and the exit code that the comment before it states; -1 where it is not run.
struct Block {
  std::string language, text;
  int exit_code = -1;
};

std::vector<Block> blocks_of_page() {
  std::istringstream page(text_of(tests::source_folder() + "/benchmarks/CI.md"));
  const std::string marker = "<!-- run: ends with code ";
  std::vector<Block> blocks;
  bool inside = false;
  int exit_code = -1;
  for (std::string line; std::getline(page, line);) {
    if (inside && line == "```") {
      inside = false;
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (line.rfind("```", 0) == 0) {
      blocks.push_back({line.substr(3), "", exit_code});
      inside = true;
      exit_code = -1;
    } else if (line.rfind(marker, 0) == 0) {
      exit_code = std::stoi(line.substr(marker.size()));
    }
  }
  return blocks;
}

std::vector<Block> runnable() {
  std::vector<Block> blocks;
  for (const Block& block : blocks_of_page()) {
    if (block.exit_code >= 0) blocks.push_back(block);
  }
  return blocks;
}

/// Lines that call the program.
std::set<std::string> calls_of(const std::string& script) {
  std::set<std::string> calls;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("diptych ", 0) == 0) calls.insert(line);
  }
  return calls;
}

/// `sh -e` on a script, in the folder, with the program on PATH and no other cases than those
/// there.
tests::Outcome script_of_page(const tests::Folder& folder, const std::string& script) {
  const std::string file = folder.write("../" + folder.path().filename().string() + ".sh", script);
  const auto outcome = tests::shell(folder,
                                    "DIPTYCH_CASES=/nowhere DIPTYCH_BASELINES=/nowhere "
                                    "PATH=" +
                                        tests::build_folder() + ":$PATH sh -e " + file);
  std::filesystem::remove(file);
  return outcome;
}

TEST(CiPage, ItsCommandsRunInAnEmptyFolderAndItsFilesAreReadByAParser) {
  const tests::Folder folder;
  std::vector<int> codes, failures;
  for (const Block& block : runnable()) {
    EXPECT_EQ(block.language, "sh");
    const auto outcome = script_of_page(folder, block.text);
    ASSERT_EQ(outcome.exit_code, block.exit_code) << block.text << outcome.text;
    codes.push_back(outcome.exit_code);
    if (block.text.find("--junit regress.xml") == std::string::npos) continue;
    pugi::xml_document document;
    const auto result = document.load_file((folder.path() / "regress.xml").c_str());
    ASSERT_TRUE(result) << result.description();
    const auto suite = document.child("testsuites").child("testsuite");
    EXPECT_STREQ(suite.attribute("name").value(), "rubber-strip");
    EXPECT_EQ(suite.attribute("failures").as_int() > 0, block.exit_code == 5);
    failures.push_back(suite.attribute("failures").as_int());
  }
  EXPECT_THAT(codes, testing::ElementsAre(0, 0, 0, 5, 0));
  EXPECT_THAT(failures, SizeIs(3));
}

/// The commands of both files, and where they say the results are.
struct CiFiles {
  YAML::Node github, gitlab;
};
CiFiles files_of_page() {
  std::vector<YAML::Node> files;
  for (const Block& block : blocks_of_page()) {
    if (block.language == "yaml") files.push_back(YAML::Load(block.text));
  }
  if (files.size() != 2) throw std::runtime_error("the page must have two files in YAML");
  return {files[0], files[1]};
}

std::string script_of_github(const YAML::Node& file) {
  std::string script;
  for (const auto& step : file["jobs"]["regress"]["steps"]) {
    if (step["run"]) script += step["run"].as<std::string>() + "\n";
  }
  return script;
}

std::string script_of_gitlab(const YAML::Node& file) {
  std::string script;
  for (const char* part : {"before_script", "script"}) {
    for (const auto& line : file["cases"][part])
      script += line.as<std::string>() + "\n";
  }
  return script;
}

TEST(CiPage, ItsFilesRunTheCommandsThatAreTested) {
  std::set<std::string> tested;
  for (const Block& block : runnable())
    tested.merge(calls_of(block.text));
  const CiFiles files = files_of_page();
  for (const std::string& script :
       {script_of_github(files.github), script_of_gitlab(files.gitlab)}) {
    const auto calls = calls_of(script);
    ASSERT_THAT(calls, SizeIs(1)) << script;
    EXPECT_THAT(tested, IsSupersetOf(calls));
    EXPECT_THAT(*calls.begin(), HasSubstr("--junit regress.xml --json regress.json"));
    EXPECT_THAT(script, HasSubstr("apt-get install -y --no-install-recommends /opt/diptych.deb"));
  }
}

TEST(CiPage, ItsFilesHaveWhatTheServicesRead) {
  const CiFiles files = files_of_page();
  EXPECT_TRUE(files.github["on"].IsSequence());
  const YAML::Node job = files.github["jobs"]["regress"];
  EXPECT_EQ(job["container"].as<std::string>(), "debian:12");
  for (const auto& step : job["steps"])
    EXPECT_TRUE(step["run"].IsDefined() != step["uses"].IsDefined());
  const YAML::Node cases = files.gitlab["cases"];
  EXPECT_EQ(cases["image"].as<std::string>(), "debian:12");
  EXPECT_EQ(cases["artifacts"]["when"].as<std::string>(), "always");
  EXPECT_EQ(cases["artifacts"]["reports"]["junit"].as<std::string>(), "regress.xml");
}

}  // namespace
}  // namespace diptych
