/// Input and surroundings that once crashed the program, hung it, or passed for success: each ends
/// with one line that says what to do, and the documented code.

#include "tests/command_line/small_case.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::diptych;
using tests::Folder;

const std::string cube = "swinging-cube-elastic-hex";

void expect_line(const tests::Outcome& outcome, int code, const std::string& part) {
  EXPECT_EQ(outcome.exit_code, code) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(part));
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
}

TEST(CommandLine, MisspeltWordsAreToldTheNearest) {
  const Folder folder;
  expect_line(diptych(folder, "comprae " + cube), 2, "did you mean 'compare'?");
  expect_line(diptych(folder, "run " + cube + " --levle 1"), 2, "did you mean '--level'?");
  expect_line(diptych(folder, "run " + cube + " --levle=1"), 2,
              "unknown option '--levle' of 'run'");
  expect_line(diptych(folder, "--verison"), 2, "did you mean '--version'?");
  expect_line(diptych(folder, "run " + cube + " --threads=two"), 2, "--threads");
  expect_line(diptych(folder, ""), 2, "no verb is given; known: ");
  expect_line(diptych(folder, "--quiet"), 2, "unknown option '--quiet' of diptych");
  EXPECT_TRUE(folder.is_empty());
}

TEST(CommandLine, CountsThatCannotBeAreRefused) {
  const Folder folder;
  for (const std::string verb : {"run", "compare", "check", "converge", "study"}) {
    expect_line(diptych(folder, verb + " " + cube + " --level 1000"), 2, "--level 1000");
    expect_line(diptych(folder, verb + " " + cube + " --level -1"), 2, "--level -1");
  }
  expect_line(diptych(folder, "converge " + cube + " --levels 1000"), 2, "--levels 1000");
  expect_line(diptych(folder, "converge " + cube + " --levels -3"), 2, "--levels");
  expect_line(diptych(folder, "converge " + cube + " --level 2147483647 --levels 2147483647"), 2,
              "--level 2147483647");
  expect_line(diptych(folder, "study " + cube + " --levels 1000"), 2, "--levels 1000");
  expect_line(diptych(folder, "study " + cube + " --repeats 0"), 2, "--repeats");
  expect_line(diptych(folder, "study " + cube + " --stability --steps -1"), 2, "--steps");
  for (const char* steps : {"0", "-1", "2000000000"})
    expect_line(diptych(folder, "material " + cube + " --end 1 --steps " + steps), 2, "--steps");
  expect_line(diptych(folder, "cost --sizes=-5"), 2, "--sizes");
  EXPECT_TRUE(folder.is_empty());
}

TEST(CommandLine, PathsOfMaterialsWhoseEnergyIsOutOfBalanceAreNotDone) {
  const Folder folder;
  const std::string path = " --path uniaxial-step --amplitude 0.3 --end 1 --out out";
  const auto outcome = diptych(folder, "material hard-stiff-branches" + path);
  EXPECT_EQ(outcome.exit_code, 5) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("out of balance"));
  EXPECT_EQ(diptych(folder, "material " + cube + path).exit_code, 0);
}

TEST(CommandLine, RunsThatNoMemoryHoldsAreRefusedBeforeTheFirst) {
  const Folder folder;
  const std::string huge = " --set 'mesh.cells=[1000,1000,1000]'";
  for (const std::string verb : {"run", "compare", "check", "study --levels 1", "converge"}) {
    const auto outcome = diptych(folder, verb + " " + cube + huge);
    expect_line(outcome, 4, "asks for about");
    EXPECT_THAT(outcome.text, AllOf(HasSubstr(" TB of memory"), HasSubstr("are available")));
  }
  // the finest level counts, before the first runs
  expect_line(diptych(folder, "converge " + cube + " --levels 9"), 4, "at level ");
  expect_line(diptych(folder, "run " + cube + " --level 20"), 2, "32 bits");
  const auto limited =
      tests::shell(folder, "ulimit -v 2000000; " + tests::build_folder() + "/diptych run " + cube +
                               " --set 'mesh.cells=[120,120,120]'");
  expect_line(limited, 4, "ulimit -v");
  EXPECT_TRUE(folder.is_empty());
}

TEST(CommandLine, CheckTellsMemoryAndTimeOfTheWholeRun) {
  const Folder folder;
  const auto outcome = diptych(folder, "check " + cube + " --method fvm --threads 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("B of memory at most (estimated beforehand: "),
                                  HasSubstr("for the steps of the whole run with 1 thread")));
}

TEST(CommandLine, CheckRefusesFiguresThatNoRunHas) {
  const Folder folder;
  folder.write("case.toml",
               tests::small_case("Bar") + "[expect]\nholds = [\"least cel J >= 0.1\"]\n");
  for (const char* verb : {"check", "run"}) {
    expect_line(diptych(folder, std::string(verb) + " case.toml --method fvm --out out"), 2,
                "'least cel J' is no figure of a run; did you mean 'least cell J'?");
  }
}

/// The run ends at 5e-4 s.
TEST(CommandLine, ValuesFromElsewhereThatAreNotHeldAgainstAreNamed) {
  const std::string probe =
      "[[probe]]\nname = \"end\"\nunit = \"m\"\nkind = \"mean\"\ngroup = \"x_max\"\nquantity = "
      "\"ux\"\n[[reference]]\nprobe = \"end\"\nvalue = 0\nsource = \"nobody\"\ntime = ";
  for (const char* verb : {"run", "compare"}) {
    for (const char* time : {"1e-4", "2e-3"}) {
      const Folder folder;
      folder.write("case.toml", tests::small_case("Bar") + probe + time + "\n");
      const auto outcome =
          diptych(folder, std::string(verb) + " case.toml --quiet --threads 1 --out out");
      EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
      const char* told =
          "end against nobody: not compared, the values begin at 0.002 s and the run";
      if (time == std::string("2e-3")) {
        EXPECT_THAT(outcome.text, HasSubstr(told));
      } else {
        EXPECT_THAT(outcome.text, testing::Not(HasSubstr("not compared")));
      }
    }
    const Folder folder;
    folder.write("case.toml", tests::small_case("Bar") + probe + "1e-4\n");
    const auto outcome = diptych(folder, std::string(verb) +
                                             " case.toml --quiet --threads 1 --out out "
                                             "--set parameters.E=1e6");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_THAT(outcome.text,
                HasSubstr("values from elsewhere: not held against, --set parameters.E=1e6"));
  }
}

TEST(CommandLine, OutputThatDoesNotArriveIsAnError) {
  const Folder folder;
  const std::vector<std::string> all{
      "list",
      "explain all",
      "--help",
      "run --help",
      "--version",
      "material " + cube + " --end 1 --path shear-step --amplitude 0.1 --out out",
      "check " + cube + " --method fvm",
      "run " + cube + " --quiet --threads 1 --method fvm --force --out out"};
  for (const std::string& words : all) {
    for (const char* output : {" >/dev/full", " >&-"}) {
      const auto outcome =
          tests::shell(folder, tests::build_folder() + "/diptych " + words + " 2>message" + output);
      EXPECT_EQ(outcome.exit_code, 4) << words << output;
      EXPECT_THAT(tests::text_of(folder.path() / "message"), HasSubstr("standard output"))
          << words << output;
    }
  }
  // a closed stream must not lend its number to a file of results
  const std::string summary = tests::text_of(folder.path() / "out/fvm/summary.json");
  EXPECT_EQ(summary.find('{'), 0u) << summary.substr(0, 100);
}

TEST(CommandLine, AReaderThatHasGoneIsNone) {
  for (const char* words : {"list", "explain all", "--help"}) {
    const auto outcome = tests::shell(Folder(), std::string("{ sleep 0.2; $diptych ") + words +
                                                    "; echo \"code $?\" >&2; } | true");
    EXPECT_EQ(outcome.text, "code 0\n") << words;
  }
}

/// A case whose mesh is made by gmsh.
std::string geo_case() {
  return "[mesh]\nfile = \"block.geo\"\nsize = 0.5\nelement = \"tetrahedron\"\n[material]\n"
         "model = \"neo-hookean\"\ndensity = 1100\nyoungs_modulus = 17e6\npoissons_ratio = 0.3\n"
         "[time]\nend = 1e-4\n";
}

TEST(CommandLine, MissingFolderForTemporaryFilesIsOneLine) {
  const Folder folder;
  folder.write("case.toml", geo_case());
  folder.write("block.geo", "Point(1) = {0, 0, 0};\n");
  const std::string program = "TMPDIR=/no/such/folder " + tests::build_folder() + "/diptych ";
  expect_line(tests::shell(folder, program + "run case.toml --quiet --out out"), 4,
              "/no/such/folder");
  expect_line(tests::shell(folder, program + "check case.toml"), 4, "set TMPDIR");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  // who needs no such folder is not asked for one
  EXPECT_EQ(tests::shell(folder, program + "check " + cube + " --method fvm").exit_code, 0);
}

TEST(CommandLine, HostileAndWrongGeoFilesEndWithCodeTwo) {
  const Folder folder;
  folder.write("case.toml", geo_case());
  folder.write("block.geo", "Point(1) = {0, 0, 0};\nSystemCall \"touch hurt\";\n");
  expect_line(diptych(folder, "run case.toml --quiet --out out"), 2, "block.geo:2: SystemCall");
  folder.write("block.geo.opt", "System \"touch hurt\";\n");
  folder.write("block.geo", "Point(1) = {0, 0, 0};\n");
  expect_line(diptych(folder, "run case.toml --quiet --out out"), 2, "block.geo.opt:1: System");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "hurt"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(CommandLine, CaseFilesThatAreNoFilesAreRefused) {
  const Folder folder;
  expect_line(diptych(folder, "run /dev/zero"), 2, "/dev/zero");
  ASSERT_EQ(tests::shell(folder, "mkfifo pipe").exit_code, 0);
  expect_line(diptych(folder, "check pipe"), 2, "pipe");
}

}  // namespace
}  // namespace diptych
