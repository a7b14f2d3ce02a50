/// Studies go on where they stopped: what is finished is not run again, what is not is.

#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

const std::string study =
    "converge shear-wave-elastic --levels 2 --quiet --threads 1 --out out --set output.frames=2 ";

int n_taken_over(const std::string& text) {
  int n = 0;
  for (size_t at = text.find("taken over, not run"); at != std::string::npos;
       at = text.find("taken over, not run", at + 1))
    ++n;
  return n;
}

void replace(const std::filesystem::path& path, const std::string& from, const std::string& to) {
  std::string text = text_of(path);
  const size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  std::ofstream(path) << text;
}

class Resumption : public testing::Test {
 protected:
  void SetUp() override {
    const auto first = diptych(folder, study);
    ASSERT_EQ(first.exit_code, 0) << first.text;
    EXPECT_EQ(n_taken_over(first.text), 0);
  }
  std::filesystem::path summary(int level, const char* method) const {
    return folder.path() / "out" / ("level_" + std::to_string(level)) / method / "summary.json";
  }
  Folder folder;
};

TEST_F(Resumption, RunsNothingTwiceAndWritesTheSameTables) {
  const std::string before = text_of(summary(1, "fvm"));
  const std::string csv = text_of(folder.path() / "out" / "convergence.csv");
  const auto second = diptych(folder, study);
  EXPECT_EQ(second.exit_code, 0) << second.text;
  EXPECT_EQ(n_taken_over(second.text), 4);
  EXPECT_EQ(text_of(summary(1, "fvm")), before) << "its date and times would differ";
  EXPECT_EQ(text_of(folder.path() / "out" / "convergence.csv"), csv);
  const std::string row = "sph,kinetic energy,J,1,";
  const size_t at = csv.find(row);
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(csv.substr(at + row.size())), 0.125, 1e-15) << "the spacing, to rounding";
}

TEST_F(Resumption, RunsAgainWhatWasKilledAndWhatIsCutOff) {
  replace(summary(1, "sph"), "\"status\": \"done\"", "\"status\": \"running\"");
  std::ofstream(summary(0, "fvm")) << "{\"method\": \"fvm\"";
  const auto outcome = diptych(folder, study);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(n_taken_over(outcome.text), 2);
  EXPECT_THAT(text_of(summary(1, "sph")), HasSubstr("\"status\": \"done\""));
  EXPECT_EQ(n_taken_over(diptych(folder, study).text), 4);
}

TEST_F(Resumption, TakesOverNothingOfAnotherCaseProgramOrOnDemand) {
  EXPECT_EQ(n_taken_over(diptych(folder, study + "--fresh").text), 0);
  EXPECT_EQ(n_taken_over(diptych(folder, study + "--force --set scheme.dissipation=0.9").text), 0);
  EXPECT_EQ(n_taken_over(diptych(folder, study + "--force").text), 0)
      << "the folder holds the other case now";
  const std::string text = text_of(summary(0, "sph"));
  const size_t at = text.find("\"program\": \"");
  ASSERT_NE(at, std::string::npos);
  replace(summary(0, "sph"), text.substr(at, 16), "\"program\": \"????");
  EXPECT_EQ(n_taken_over(diptych(folder, study + "--force").text), 3);
}

TEST_F(Resumption, AsksForQuantitiesByNameAndKnowsThem) {
  const auto chosen = diptych(folder, study + "--quantity 'linear momentum x'");
  EXPECT_EQ(chosen.exit_code, 0) << chosen.text;
  EXPECT_THAT(chosen.text, HasSubstr("linear momentum x [kg m/s]"));
  EXPECT_THAT(chosen.text, Not(HasSubstr("kinetic energy")));
  const auto misspelt = diptych(folder, study + "--quantity 'kinetic enrgy'");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.text, HasSubstr("did you mean 'kinetic energy'?"));
  const auto new_one = diptych(folder, "converge shear-wave-elastic --quantity nope --out none");
  EXPECT_EQ(new_one.exit_code, 2);
  EXPECT_THAT(new_one.text, HasSubstr("--quantity 'nope': no column of history.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none")) << "nothing is run before";
}

/// The mean speed of the cube is 0.5 m/s at t = 0, by a probe of every step.
class HeldAgainstAFile : public testing::Test {
 protected:
  void SetUp() override {
    tests::write_case(folder, ".", "mine",
                      tests::cube + tests::probes +
                          "[time]\nend = 2e-4\n[output]\nframes = 1\n[[reference]]\nprobe = "
                          "\"speed\"\nfile = \"ref.csv\"\nuncertainty = 0.1\nsource = \"s\"\n");
    write_values("0.5");
  }
  void write_values(const std::string& value) const {
    folder.write("mine/ref.csv", "time [s],speed [m/s]\n0," + value + "\n");
  }
  Folder folder;
};

TEST_F(HeldAgainstAFile, TakesOverRunsAndHoldsThemAgainstItAsItIsNow) {
  const std::string command = "converge mine --levels 2 --method fvm --threads 1 --quiet --out out";
  const auto first = diptych(folder, command);
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_THAT(first.text, Not(HasSubstr("NOT")));
  write_values("10");
  const auto off = diptych(folder, command);
  EXPECT_EQ(n_taken_over(off.text), 2) << off.text;
  EXPECT_THAT(off.text, HasSubstr("NOT met, 95 times"));
  const std::filesystem::path run = folder.path() / "out" / "level_1" / "fvm";
  EXPECT_NEAR(tests::summary_in(run).references.at(0).greatest, 9.5, 1e-9);
  EXPECT_EQ(diptych(folder, "check out").exit_code, 0) << "its checksums are of the new summary";
  write_values("0.45");
  const auto met = diptych(folder, command);
  EXPECT_EQ(n_taken_over(met.text), 2);
  EXPECT_THAT(met.text, Not(HasSubstr("NOT")));
}

TEST_F(HeldAgainstAFile, HoldsAFinishedRunThatGoesOnAgainstItToo) {
  const std::string command = "run mine --method fvm --threads 1 --quiet --out out";
  ASSERT_EQ(diptych(folder, command).exit_code, 0);
  write_values("10");
  const auto second = diptych(folder, command + " --restart latest");
  EXPECT_EQ(n_taken_over(second.text), 1) << second.text;
  EXPECT_THAT(second.text, HasSubstr("NOT met, 95 times"));
  std::filesystem::remove(folder.path() / "out" / "fvm" / "steps.csv");
  const auto third = diptych(folder, command + " --restart latest");
  EXPECT_EQ(third.exit_code, 2) << "what would be held against it is no longer there";
}

}  // namespace
}  // namespace diptych
