/// The output folder shows this command's results and nothing of an earlier one; another case's
/// results, and other people's files, are not touched.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::Folder;
using tests::text_of;

class OutputFolder : public testing::Test {
 protected:
  tests::Outcome diptych(const std::string& arguments, int code = 0) const {
    const auto outcome = tests::diptych(folder, arguments + " --quiet --threads 1 --out out");
    EXPECT_EQ(outcome.exit_code, code) << arguments << ": " << outcome.text;
    return outcome;
  }
  bool has(const std::string& name) const { return fs::exists(folder.path() / "out" / name); }
  Folder folder;
  const std::string cube = " shear-wave-elastic --set output.frames=2 ";
  const std::string other = " swinging-cube-elastic-hex --set time.end=1e-4 ";
};

TEST_F(OutputFolder, HoldsNothingOfAnEarlierRun) {
  diptych("compare" + cube);
  ASSERT_TRUE(has("fvm/frame_0002.hdf") && has("report.html") && has("sph/summary.json"));
  folder.write("out/notes.txt", "mine");
  folder.write("out/fvm/view.pvsm", "mine");
  EXPECT_THAT(
      diptych("run --method sph" + cube, 2).text,
      HasSubstr("out/sph, out/fvm: are runs that finished; give another --out, or --force"));
  diptych("run --method sph --no-fields --force" + cube);
  EXPECT_TRUE(has("sph/summary.json"));
  EXPECT_FALSE(has("report.html") || has("fvm/summary.json") || has("fvm/history.csv") ||
               has("fvm/frame_0002.hdf") || has("fvm/mesh.hdf") || has("fvm/case.toml"));
  EXPECT_FALSE(has("sph/frame_0002.hdf") || has("sph/run.hdf.series") || has("sph/mesh.hdf"));
  EXPECT_EQ(text_of(folder.path() / "out" / "notes.txt"), "mine");
  EXPECT_EQ(text_of(folder.path() / "out" / "fvm" / "view.pvsm"), "mine");
}

TEST_F(OutputFolder, HoldsNoStepsOfAnEarlierCase) {
  const std::string probe =
      "[[probe]]\nname = \"v\"\nunit = \"m/s\"\nkind = \"mean\"\nquantity = \"vx\"\n";
  const std::string body =
      "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
      "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n";
  folder.write("case.toml", body + probe + "every_step = true\n");
  diptych("run case.toml");
  ASSERT_TRUE(has("fvm/steps.csv"));
  folder.write("case.toml", body + probe);
  diptych("run case.toml --force");
  EXPECT_FALSE(has("fvm/steps.csv"));
}

TEST_F(OutputFolder, SetsFinishedLevelsAsideAndTakesThemOverLater) {
  diptych("converge --levels 3" + cube);
  const std::string before = text_of(folder.path() / "out" / "level_2" / "sph" / "summary.json");
  diptych("compare" + cube);
  EXPECT_FALSE(has("level_0") || has("level_2") || has("convergence.csv") ||
               has("convergence.tex"));
  EXPECT_TRUE(has("sph/summary.json") && has("report.html"));
  const auto two = diptych("converge --levels 2" + cube);
  EXPECT_THAT(two.text, HasSubstr("taken over, not run again: out/level_1/fvm"));
  EXPECT_FALSE(has("sph/summary.json") || has("level_2"));
  const auto three = diptych("converge --levels 3" + cube);
  EXPECT_THAT(three.text, HasSubstr("taken over, not run again: out/level_2/sph"));
  EXPECT_EQ(text_of(folder.path() / "out" / "level_2" / "sph" / "summary.json"), before);
  EXPECT_FALSE(has("earlier"));
  // other overrides make other runs: nothing of those before is left where it could be taken for
  // one of them
  const std::string changed = "converge" + cube + "--levels 2 --set scheme.dissipation=0.9";
  EXPECT_THAT(diptych(changed, 2).text, HasSubstr("out/level_1/fvm: are runs that finished"));
  diptych(changed + " --force");
  EXPECT_FALSE(has("level_2"));
  EXPECT_THAT(text_of(folder.path() / "out" / "case.toml"), HasSubstr("scheme.dissipation=0.9"));
}

TEST_F(OutputFolder, OfAnotherCaseIsNotOverwrittenWithoutForce) {
  diptych("converge --levels 2" + cube);
  folder.write("out/notes.txt", "mine");
  for (const char* verb : {"run", "compare", "converge --levels 2", "study --levels 1 --repeats 1",
                           "study --stability --integrators leapfrog --steps 40"}) {
    const auto refused = diptych(verb + other, 2);
    EXPECT_THAT(refused.text,
                AllOf(HasSubstr("out: holds results of another case, shear-wave-elastic"),
                      HasSubstr("--force")));
  }
  EXPECT_TRUE(has("level_1/fvm/history.csv") && has("convergence.csv") && has("report.html"));
  diptych("run --method fvm --force" + other);
  EXPECT_TRUE(has("fvm/summary.json"));
  EXPECT_FALSE(has("level_0") || has("level_1") || has("convergence.csv") || has("report.html"));
  EXPECT_EQ(text_of(folder.path() / "out" / "notes.txt"), "mine");
  diptych("run" + other +
          "--method fvm --force --set time.cfl=0.5");  // the same case: other overrides
  const auto refused = diptych("study --levels 1 --repeats 1" + cube, 2);
  EXPECT_THAT(refused.text, HasSubstr("swinging-cube-elastic-hex"));
}

TEST_F(OutputFolder, TellsCasesOfOneNameApartByTheirFiles) {
  const std::string body =
      "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
      "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n";
  for (const char* place : {"a/cube", "b/cube"}) {
    fs::create_directories(folder.path() / place);
    folder.write(std::string(place) + "/case.toml", body);
  }
  diptych("run a/cube/case.toml --method fvm");
  EXPECT_THAT(diptych("run b/cube/case.toml --method fvm", 2).text, HasSubstr("a/cube/case.toml"));
  EXPECT_THAT(diptych("run ./b/../a/cube --method fvm", 2).text,
              HasSubstr("is a run that finished"))
      << "the same file";
  fs::create_directory_symlink("a", folder.path() / "link");
  EXPECT_THAT(diptych("run link/cube --method fvm", 2).text, HasSubstr("is a run that finished"))
      << "the same file";
  diptych("run out/case.toml --method fvm --force");  // its copy
  diptych("run b/cube/case.toml --method fvm --force");
}

TEST_F(OutputFolder, LeavesACaseFileOfTheUserThere) {
  const std::string body =
      "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
      "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n";
  fs::create_directories(folder.path() / "out");
  folder.write("out/case.toml", body);
  diptych("run out/case.toml --method fvm --set time.end=0.5");
  EXPECT_EQ(text_of(folder.path() / "out" / "case.toml"), body);
  EXPECT_THAT(text_of(folder.path() / "out" / "fvm" / "case.toml"), HasSubstr("time.end=0.5"));
}

TEST_F(OutputFolder, KeepsPagesThatDiptychDidNotMake) {
  fs::create_directories(folder.path() / "out");
  folder.write("out/report.html", "mine");
  folder.write("out/convergence.csv", "mine");
  diptych("run --method fvm --no-fields" + cube);
  EXPECT_EQ(text_of(folder.path() / "out" / "report.html"), "mine");
  EXPECT_EQ(text_of(folder.path() / "out" / "convergence.csv"), "mine");
}

TEST_F(OutputFolder, IsNotTouchedWhereTheInputIsWrong) {
  diptych("compare" + cube);
  diptych("run" + cube + "--method sph --set mesh.cells=[0,1,1]", 2);
  diptych("run --method sph --level 25" + cube, 2);
  const std::string file =
      (fs::path(tests::source_folder()) / "benchmarks/cases/shear-wave-elastic").string();
  std::string text = text_of(fs::path(file) / "case.toml");
  text +=
      "\n[[probe]]\nname = \"far\"\nunit = \"m\"\nkind = \"point\"\nat = [9, 9, 9]\n"
      "quantity = \"ux\"\n";
  fs::create_directories(folder.path() / "wrong");
  folder.write("wrong/case.toml", text);
  diptych("run wrong --method sph --force", 2);
  EXPECT_TRUE(has("fvm/summary.json") && has("report.html") && has("sph/frame_0002.hdf"));
}

}  // namespace
}  // namespace diptych
