/// `diptych regress` through the program: its exit codes, and what it takes to accept a change.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

/// A folder of baselines of the test's own.
class Regress : public testing::Test {
 protected:
  Regress() { setenv("DIPTYCH_BASELINES", (folder_.path() / "baselines").c_str(), 1); }
  ~Regress() override { unsetenv("DIPTYCH_BASELINES"); }
  tests::Outcome program(const std::string& arguments) const {
    return diptych(folder_, "regress --threads 1 --quiet --out out " + arguments);
  }
  std::string baseline() const { return text_of(file()); }
  std::filesystem::path file() const {
    return folder_.path() / "baselines" / "shear-wave-plane-ve2.json";
  }
  Folder folder_;
  const std::string name_ = "shear-wave-plane-ve2";
};

TEST_F(Regress, PassesOnWhatItRecordedAndEndsWithFiveWhereAFigureDiffers) {
  const auto first = program("--bless " + name_ + " --why first");
  EXPECT_EQ(first.exit_code, 0) << first.text;
  const auto again = program(name_);
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_THAT(again.text, AllOf(HasSubstr("sph"), HasSubstr(" 0 failed")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "regress.txt"));

  std::string text = baseline();
  const size_t at = text.find("\"value\": ", text.find("\"velocity L2\""));
  ASSERT_NE(at, std::string::npos);
  text.insert(text.begin() + static_cast<std::ptrdiff_t>(at) + 9, '1');
  std::ofstream(file()) << text;
  const auto changed = program(name_);
  EXPECT_EQ(changed.exit_code, 5) << changed.text;
  EXPECT_THAT(changed.text, HasSubstr("FAILED errors: velocity L2"));

  const auto accepted = program("--bless " + name_ + " --why 'a digit too many'");
  EXPECT_EQ(accepted.exit_code, 0) << accepted.text;
  EXPECT_THAT(accepted.text, AllOf(HasSubstr("(first)"), HasSubstr("(a digit too many)"),
                                   HasSubstr("error, velocity L2: 1")));
  EXPECT_THAT(baseline(), HasSubstr("\"reason\": \"a digit too many\""));
}

TEST_F(Regress, RecordsNothingWithoutAReason) {
  for (const std::string why : {"", " --why ''", " --why ' '"}) {
    const auto outcome = program("--bless " + name_ + why);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("--why"));
  }
  EXPECT_FALSE(std::filesystem::exists(file()));
  EXPECT_EQ(program("--why because").exit_code, 2);
  EXPECT_EQ(program(name_ + " --bless all --why because").exit_code, 2);
}

TEST_F(Regress, FailsWithoutABaselineAndRefusesABrokenOne) {
  const auto missing = program(name_);
  EXPECT_EQ(missing.exit_code, 5) << missing.text;
  EXPECT_THAT(missing.text,
              AllOf(HasSubstr("FAILED record: no baseline"), HasSubstr("--bless " + name_)));
  std::filesystem::create_directories(file().parent_path());
  for (const std::string text : {"", "{}", "{\"case\": null}"}) {
    std::ofstream(file()) << text;
    const auto broken = program(name_);
    EXPECT_EQ(broken.exit_code, 2) << broken.text;
    EXPECT_THAT(broken.text, AllOf(HasSubstr("FAILED case: cannot be read: " + file().string()),
                                   HasSubstr("0 checks met, 1 failed")));
  }
  const auto unknown = program("shear-wave-plane");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.text, HasSubstr(name_));
}

TEST_F(Regress, SkipsWithALineWhatNeedsAMissingMesher) {
  setenv("DIPTYCH_OLD_PATH", getenv("PATH"), 1);
  setenv("PATH", "/nowhere", 1);
  const std::string command = std::string("cd ") + folder_.path().string() + "; " +
                              tests::build_folder() +
                              "/diptych regress cooks-membrane --quiet 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  setenv("PATH", getenv("DIPTYCH_OLD_PATH"), 1);
  ASSERT_NE(pipe, nullptr);
  char buffer[4096];
  std::string text;
  while (const size_t n = fread(buffer, 1, sizeof buffer, pipe))
    text.append(buffer, n);
  EXPECT_EQ(pclose(pipe), 0) << text;
  EXPECT_THAT(text, AllOf(HasSubstr("cooks-membrane"), HasSubstr("skipped"),
                          HasSubstr("needs the gmsh program")));
}

}  // namespace
}  // namespace diptych
