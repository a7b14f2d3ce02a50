/// Studies go on where they stopped: what is finished is not run again, what is not is.

#include "tests/command_line/program.hpp"

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
}

}  // namespace
}  // namespace diptych
