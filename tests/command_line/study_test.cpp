/// `diptych study` of cases without an exact solution, and with one where quantities are asked for.

#include "common/io/run_record.hpp"
#include "tests/command_line/program.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <regex>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using tests::diptych;
using tests::Folder;
using tests::text_of;

const std::string column =
    "study bending-column-ve --levels 1 --threads 1 --set time.end=0.05 --set output.frames=5 "
    "--out "
    "out";

TEST(StudyWithoutExactSolution, ShowsTheQuantitiesOfEachVariant) {
  const Folder folder;
  const std::string arguments = column + " --vary parameters.De=0.1,10";
  const auto outcome = diptych(folder, arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("level 0 done: 4 runs, 0 of them taken over"),
                    HasSubstr("\ntip displacement x, final [m]\n"),
                    HasSubstr("\nviscous dissipation [J]\n"), HasSubstr("\nleast J\n"),
                    HasSubstr("\nseconds [s]\n"), Not(HasSubstr("external work"))));
  const std::regex row("De=0\\.1 +[-0-9.e]+ +[-0-9.e]+\nDe=10 +[-0-9.e]+ +[-0-9.e]+\n");
  EXPECT_TRUE(std::regex_search(outcome.text, row)) << outcome.text;
  const auto out = folder.path() / "out";
  EXPECT_THAT(text_of(out / "quantities.csv"),
              StartsWith("variant,parameters.De,method,level,spacing [m],"
                         "\"tip displacement x, final [m]\""));
  EXPECT_THAT(text_of(out / "quantities.html"),
              AllOf(HasSubstr("Each quantity against parameters.De"), HasSubstr("</html>")));
  EXPECT_FALSE(std::filesystem::exists(out / "work_precision.csv"));
  // the numbers are those of the runs, which are kept
  const std::string csv = text_of(out / "quantities.csv");
  int n_runs = 0;
  for (const auto& run : std::filesystem::directory_iterator(out / "runs")) {
    const auto s = io::summary_from_json(text_of(run.path() / "summary.json"), "summary.json");
    char value[40];
    std::snprintf(value, sizeof value, ",%.17g,", s.quantities.at(0).final_value);
    EXPECT_THAT(csv, HasSubstr(value));
    ++n_runs;
  }
  EXPECT_EQ(n_runs, 4);
  EXPECT_THAT(diptych(folder, arguments).text,
              HasSubstr("level 0 done: 4 runs, 4 of them taken over"));
}

TEST(StudyWithoutExactSolution, ShowsTheQuantitiesThatAreAskedFor) {
  const Folder folder;
  const auto outcome =
      diptych(folder, column + " --method fvm --quiet --quantity 'least J' --quantity steps");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("\nleast J\n"), HasSubstr("\nsteps\n"),
                                  HasSubstr("as it stands"), Not(HasSubstr("energy"))));
}

TEST(StudyWithoutExactSolution, RefusesWhatTheCaseDoesNotHaveBeforeTheFirstRun) {
  const Folder folder;
  const auto unknown = diptych(folder, column + " --quantity 'tip displacment x'");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.text, HasSubstr("tip displacement x"));
  const auto field = diptych(folder, column + " --field velocity");
  EXPECT_EQ(field.exit_code, 2);
  EXPECT_THAT(field.text, HasSubstr("no exact solution"));
  EXPECT_TRUE(folder.is_empty());
}

TEST(StudyWithoutExactSolution, GoesOnWhereAVariantBreaksDown) {
  const Folder folder;
  const auto outcome =
      diptych(folder, column + " --method fvm --quiet --vary time.cfl=9,0.5 --quantity seconds");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("diptych: fvm level 0 broke down: cfl=9: "),
                                  HasSubstr("\ncfl=9                   -\n")));
  EXPECT_TRUE(std::regex_search(outcome.text, std::regex("cfl=0\\.5 +[0-9]")));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "quantities.csv"));
}

TEST(StudyWithExactSolution, ShowsQuantitiesBesideErrorsWhereTheyAreAskedFor) {
  const Folder folder;
  const std::string arguments =
      "study swinging-cube-elastic-hex --levels 2 --repeats 1 --threads 1 --quiet --out out";
  const auto both = diptych(folder, arguments + " --quantity 'kinetic energy'");
  ASSERT_EQ(both.exit_code, 0) << both.text;
  EXPECT_THAT(both.text, AllOf(HasSubstr("seconds at equal error"),
                               HasSubstr("\nkinetic energy [J]\n"), HasSubstr("FVM 1")));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "work_precision.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "quantities.csv"));
}

}  // namespace
}  // namespace diptych
