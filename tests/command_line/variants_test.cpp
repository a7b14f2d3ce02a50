/// Variants beside both methods in compare and converge: tables, report, folders, what is taken
/// over, and bad input.

#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::small_case;
using tests::summary_in;
using tests::text_of;

const std::string wide = "--with 'wide: sph.kappa=1.4' ";

TEST(VariantColumns, StandBesideTheMethodsOfAComparison) {
  const Folder folder;
  folder.write("case.toml", small_case("A strip") +
                                "[[variant]]\nname = \"integral\"\nset = [\"fvm.stencil="
                                "integral\"]\n");
  const auto outcome = diptych(
      folder, "compare case.toml --quiet --out out " + wide + "--with scheme.dissipation=0.5");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("SPH/FVM"), ContainsRegex("SPH +FVM +FVM +SPH +SPH\n"),
                                  ContainsRegex("integral +wide +dissipation=\n +0\\.5\n"),
                                  ContainsRegex("from FVM, u +[0-9.e-]+ +[0-9.e-]+ +[0-9.e-]+\n")));
  const auto out = folder.path() / "out";
  for (const char* column :
       {"sph", "fvm", "fvm-integral", "sph-wide", "sph-dissipation=0.5", "fvm-dissipation=0.5"})
    EXPECT_EQ(summary_in(out / column).column(), column);
  EXPECT_THAT(text_of(out / "sph-wide" / "case.toml"), HasSubstr("\"sph.kappa=1.4\""));
  const std::string page = text_of(out / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("\"title\":\"SPH wide\""), HasSubstr("sph.kappa=1.4</small>"),
                          HasSubstr("energy-fvm-integral"), HasSubstr("var(--fvm-2)")));
  std::filesystem::copy(out / "sph", out / "sph-before");  // of the user
  const auto fewer = diptych(folder, "compare case.toml --quiet --out out --force --no-variants");
  EXPECT_EQ(fewer.exit_code, 0) << fewer.text;
  EXPECT_THAT(fewer.text, Not(HasSubstr("variants")));
  EXPECT_FALSE(std::filesystem::exists(out / "sph-wide")) << "nothing of an earlier command stays";
  EXPECT_TRUE(std::filesystem::exists(out / "sph-before" / "summary.json")) << "no variant's";
}

TEST(VariantColumns, AreCurvesOfAStudyWhereNothingElseVaries) {
  const Folder folder;
  folder.write("case.toml", small_case("A strip") +
                                "[[variant]]\nname = \"integral\"\nset = [\"fvm.stencil="
                                "integral\"]\n");
  const std::string study =
      "study case.toml --levels 1 --repeats 1 --quiet --threads 1 --quantity 'kinetic energy' ";
  const auto outcome = diptych(folder, study + "--out out " + wide);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::string number = " +[0-9.e+]+";
  EXPECT_THAT(outcome.text, AllOf(ContainsRegex("as it stands" + number + number + "\n"),
                                  ContainsRegex("integral +-" + number + "\n"),
                                  ContainsRegex("wide" + number + " +-\n")));
  const auto varied = diptych(folder, study + "--out varied --vary time.cfl=0.2,0.4");
  EXPECT_EQ(varied.exit_code, 0) << varied.text;
  EXPECT_THAT(varied.text, AllOf(HasSubstr("cfl=0.4"), Not(HasSubstr("integral"))));
  const auto refused = diptych(folder, "study case.toml --stability " + wide);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.text, HasSubstr("--with has no effect with --stability"));
}

TEST(References, AreToldOfEveryColumnWithTheirUncertainty) {
  const Folder folder;
  folder.write("case.toml", small_case("A strip") + R"(
[[probe]]
name = "tip"
unit = "m"
at = [0.1, 0]
quantity = "ux"

[[reference]]
probe = "tip"
value = 0
time = 0
uncertainty = 1e-6
source = "at rest"

[[reference]]
probe = "tip"
file = "tip.csv"
column = "far"
relative_uncertainty = 0.01
source = "invented"
)");
  folder.write("tip.csv", "t,near,far\n0,0,1\n5e-4,0,1\n");
  const auto outcome = diptych(folder, "compare case.toml --quiet --out out " + wide);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("tip, +-1e-06: at rest\n"),
                                  ContainsRegex("  sph-wide +0 +0 .* met\n"),
                                  HasSubstr("tip (2), +-0.01: invented\n"),
                                  ContainsRegex("  fvm +0 +1 .*NOT met, 1e\\+02 times\n")));
  const auto summary = summary_in(folder.path() / "out" / "fvm");
  ASSERT_EQ(summary.references.size(), 2u);
  EXPECT_TRUE(summary.references[0].is_inside());
  EXPECT_EQ(summary.references[1].name, "tip (2)");
  EXPECT_EQ(*summary.references[1].uncertainty, 0.01);
  EXPECT_THAT(text_of(folder.path() / "out" / "report.html"),
              HasSubstr("<strong>not met</strong>"));
  const auto other =
      diptych(folder, "compare case.toml --quiet --out other --set parameters.E=1e6");
  EXPECT_THAT(other.text, AllOf(Not(HasSubstr("at rest")),
                                HasSubstr("--set parameters.E=1e6 makes it another scene")));
}

TEST(VariantColumns, AreTakenOverAsTheMethodsAre) {
  const Folder folder;
  const std::string converge =
      "converge shear-wave-elastic --levels 2 --quiet --threads 1 --out out "
      "--set output.frames=2 ";
  const auto first = diptych(folder, converge + "--with 'wide: sph.kappa=1.3'");
  EXPECT_EQ(first.exit_code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("SPH wide, shear-wave-elastic: relative L2 errors"));
  const std::string csv = text_of(folder.path() / "out" / "convergence.csv");
  EXPECT_THAT(csv, HasSubstr("\nsph-wide,velocity error L2,-,1,"));
  EXPECT_THAT(csv, HasSubstr("\nsph-wide,kinetic energy,J,1,"));
  const auto second = diptych(folder, converge + "--with 'wide: sph.kappa=1.3'");
  EXPECT_THAT(second.text, HasSubstr("taken over, not run again: out/level_1/sph-wide"));
  EXPECT_EQ(text_of(folder.path() / "out" / "convergence.csv"), csv);
  const auto other = diptych(folder, converge + "--force --with 'wide: sph.kappa=1.4'");
  EXPECT_EQ(other.exit_code, 0) << other.text;
  EXPECT_THAT(other.text, AllOf(HasSubstr("out/level_1/sph\n"), Not(HasSubstr("1/sph-wide\n"))))
      << "another one of the same name";
}

TEST(VariantColumns, OfTheFileGiveWayToSettings) {
  const Folder folder;
  folder.write("case.toml",
               small_case("A strip") +
                   "[[variant]]\nname = \"wide\"\nset = [\"sph.kappa=1.2\"]\n"
                   "[[variant]]\nname = \"half\"\nset = [\"scheme.dissipation=0.5\"]\n");
  const auto outcome =
      diptych(folder, "compare case.toml --quiet --out out --no-fields --set sph.kappa=1.2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("variant 'wide' of the case is left out"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/sph-wide"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/sph-half"));
}

TEST(VariantColumns, ThatAreNoneAreRefusedInOneLine) {
  const Folder folder;
  folder.write("case.toml", small_case("A strip") + "[sph]\nkappa = 1.1\n");
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"--with sph.kapa=1.2", "did you mean 'sph.kappa'?"},
      {"--with 'sph.kappa=1.2 fvm.stencil=integral'", "make two variants"},
      {"--with 'a: sph.kappa=1.2' --with 'a: sph.kappa=1.3'", "is there already"},
      {"--with sph.kappa=1.1", "sets sph.kappa = 1.1, which the case has by itself"},
      {"--with sph.kappa=many", "sph.kappa"},
      {"--with sph.kappa=1.2 --method fvm", "is of sph, --method asks for fvm"}};
  for (const auto& [options, told] : refused) {
    const auto outcome =
        diptych(folder, "converge case.toml --levels 2 --quiet --out out " + options);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(told));
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << options;
  }
}

}  // namespace
}  // namespace diptych
