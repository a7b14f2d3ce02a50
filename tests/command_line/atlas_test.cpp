/// `diptych study --atlas`: a shipped atlas as a coarse map, and one of a user that goes on.

#include "tests/command_line/program.hpp"
#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

nlohmann::json map_in(const Folder& folder) {
  return nlohmann::json::parse(text_of(folder.path() / "out" / "atlas.json"));
}

TEST(Atlas, OfShippedScenesIsMadeAsACoarseMap) {
  const Folder folder;
  const auto outcome =
      diptych(folder, "study --atlas stability --coarse --threads 1 --quiet --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const nlohmann::json map = map_in(folder);
  EXPECT_EQ(map["points"].size(), 128U);
  std::map<std::string, int> n;
  for (const auto& point : map["points"]) {
    ++n[point["outcome"]];
    const bool is_default = point["settings"]["step"] == "default";
    if (is_default) {
      EXPECT_NE(point["outcome"], "wrong") << point;
    }
  }
  EXPECT_GT(n["stable"], 40) << outcome.text;
  EXPECT_GT(n["stopped"], 0) << "steps of twice the bound";
  for (const char* name : {"atlas.html", "atlas.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
}

/// Two steps of a strip, one of them far too large.
class OwnAtlas : public testing::Test {
 protected:
  OwnAtlas() {
    tests::write_case(folder, "mine", "strip", tests::small_case("A strip"));
    folder.write("steps.toml",
                 "title = \"Steps\"\ncase = \"mine/strip\"\nset = "
                 "[\"time.end=0.005\", \"time.max_retries=0\"]\n[[axis]]\nname = \"cfl\"\n"
                 "key = \"time.cfl\"\nvalues = [0.5, 9]\n[[axis]]\nname = \"kappa\"\n"
                 "[[axis.choice]]\nname = \"1.2\"\n[[axis.choice]]\nname = \"0.5\"\n"
                 "methods = [\"sph\"]\nset = [\"sph.kappa=0.5\"]\n");
  }
  tests::Outcome made(const std::string& more = "") const {
    return diptych(folder, "study steps.toml --atlas --threads 1 --out out " + more);
  }
  Folder folder;
};

TEST_F(OwnAtlas, TellsStableFromStoppedAndRefused) {
  const auto outcome = made();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("Of 6 points 2 are stable, 2 were stopped"),
                                  HasSubstr("2 could not be begun"),
                                  HasSubstr("6 of 6 points, 0 of them taken over")));
  EXPECT_THAT(text_of(folder.path() / "out" / "atlas.csv"), HasSubstr("neighbours"));
}

TEST_F(OwnAtlas, GoesOnWhereItWasKilledAndRunsNothingTwice) {
  tests::shell(folder,
               "$diptych study steps.toml --atlas --threads 1 --quiet --out out & pid=$!\n"
               "for i in $(seq 500); do grep -q '\"status\": \"done\"' out/runs/*/summary.json && "
               "break; sleep 0.02; done; kill -9 $pid; wait $pid");
  const auto rest = made();
  EXPECT_THAT(rest.text, testing::ContainsRegex("6 of 6 points, [1-4] of them taken over"));
  // those that ended and that were stopped; what could not be begun has left nothing
  EXPECT_THAT(made().text, HasSubstr("6 of 6 points, 4 of them taken over"));
  EXPECT_THAT(made("--fresh").text, HasSubstr("6 of 6 points, 0 of them taken over"));
}

// Killed while the first file of a run was written.
TEST_F(OwnAtlas, MakesARunAgainWhoseFirstFileWasCutOff) {
  made();
  tests::shell(
      folder,
      "cd $(ls -d out/runs/*_sph_level_0 | head -n 1) && mv summary.json summary.json.tmp && "
      "rm history.csv case.toml checksums.txt");
  EXPECT_THAT(made().text, HasSubstr("6 of 6 points, 3 of them taken over"));
  EXPECT_THAT(made().text, HasSubstr("6 of 6 points, 4 of them taken over"));
}

TEST_F(OwnAtlas, IsComparedWithThatOfAnEarlierProgram) {
  ASSERT_EQ(made("--quiet").exit_code, 0);
  std::filesystem::rename(folder.path() / "out" / "atlas.json", folder.path() / "before.json");
  const auto now = made("--quiet --before before.json --set time.cfl=0.4");
  EXPECT_EQ(now.exit_code, 2) << "the axis sets it: " << now.text;
  const auto after = made("--quiet --before before.json");
  EXPECT_THAT(after.text, HasSubstr("before \\ now"));
  EXPECT_THAT(after.text, Not(HasSubstr("no longer stable")));
}

// before it runs anything
TEST_F(OwnAtlas, IsNotComparedWithWhatHasNoneOfItsPoints) {
  folder.write("before.json", "{\"points\": []}");
  const auto outcome = made("--quiet --before before.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("has no point of the atlas"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(OwnAtlas, AsksForAnAtlasAndForNothingThatHasNoEffect) {
  for (const std::string wrong :
       {"study nowhere --atlas", "study steps.toml --atlas --vary time.cfl=1",
        "study steps.toml --atlas --stability", "study mine/strip --coarse",
        "study steps.toml --atlas --before steps.toml", "study mine/strip/case.toml --atlas"}) {
    const auto outcome = diptych(folder, wrong + " --quiet --threads 1");
    EXPECT_EQ(outcome.exit_code, 2) << wrong << '\n' << outcome.text;
  }
}

}  // namespace
}  // namespace diptych
