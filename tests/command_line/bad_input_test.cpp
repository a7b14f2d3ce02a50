/// Bad input through the program: exit code 2, one message that says where and what to do, and
/// nothing left behind.

#include "tests/command_line/program.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <ostream>

namespace diptych {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::diptych;
using tests::Folder;

const std::string sound_case = R"(title = "A block that hangs from one face"
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [2, 2, 2]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.45
zeta_ratio = 0.5
[[boundary]]
group = "x_min"
type = "fixed"
[load]
body_force = ["0", "0", "-1100*9.81"]
[time]
end = 1e-3
)";

std::string with(const std::string& what, const std::string& instead) {
  std::string text = sound_case;
  const size_t at = text.find(what);
  if (at == std::string::npos) ADD_FAILURE() << "no '" << what << "' in the case";
  return text.replace(at, what.size(), instead);
}

struct Bad {
  std::string name, text;
  std::vector<std::string> told;  ///< parts of the message
};

std::vector<Bad> bad_cases() {
  return {
      {"MisspeltKey", with("density", "densty"), {"case.toml:", "densty", "density"}},
      {"WrongType", with("cells = [2, 2, 2]", "cells = \"many\""), {"case.toml:6", "cells"}},
      {"NegativeDensity", with("density = 1100", "density = -1100"), {"density", "-1100"}},
      {"Incompressible", with("0.45", "0.5"), {"poissons_ratio", "0.5"}},
      {"MissingMesh",
       with("lower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [2, 2, 2]", "file = \"none.msh\""),
       {"none.msh"}},
      {"MissingGroup", with("\"x_min\"", "\"x_mim\""), {"x_mim", "x_min"}},
      {"UnknownName", with("-1100*9.81", "-1100*gravity"), {"gravity"}},
      {"UnknownMaterial", with("\"mooney-rivlin\"", "\"mooney\""), {"mooney-rivlin"}},
      {"NotPolyconvex", with("zeta_ratio = 0.5", "zeta_ratio = 0.99\n#") + "", {"zeta_ratio"}},
      {"NegativeEnd", with("end = 1e-3", "end = -1"), {"end"}},
      {"SingleWithExactImpedance",
       with("[time]", "[scheme]\nprecision = \"single\"\nimpedance = \"exact\"\n[time]"),
       {"case.toml:19", "precision", "isotropic"}},
      {"ObjectiveWithExactImpedance",
       with("[time]", "[scheme]\nreconstruction = \"objective\"\nimpedance = \"exact\"\n[time]"),
       {"case.toml:19", "objective", "isotropic"}},
      {"TooSmallForSingle",
       with("upper = [1, 1, 1]", "upper = [1e-7, 1e-7, 1e-7]") +
           "[scheme]\nprecision = \"single\"\n",
       {"scheme.precision", "units"}},
      {"NotToml", with("[material]", "[material"), {"case.toml:7"}},
  };
}

/// For messages of the test programs.
void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.name;
}

std::string name_of(const testing::TestParamInfo<Bad>& bad) {
  return bad.param.name;
}

class BadInput : public testing::TestWithParam<Bad> {};

TEST_P(BadInput, EndsWithCodeTwoAndOneMessage) {
  const Folder folder, output;
  folder.write("case.toml", GetParam().text);
  if (GetParam().name == "NotPolyconvex") {
    folder.write("case.toml", with("poissons_ratio = 0.45\nzeta_ratio = 0.5",
                                   "poissons_ratio = 0.2\nzeta_ratio = 0.9"));
  }
  const auto outcome =
      diptych(folder, "run case.toml --quiet --out " + (output.path() / "results").string());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  for (const std::string& part : GetParam().told)
    EXPECT_THAT(outcome.text, HasSubstr(part));
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
  EXPECT_TRUE(output.is_empty());
}

INSTANTIATE_TEST_SUITE_P(Cases, BadInput, testing::ValuesIn(bad_cases()), name_of);

/// What operators that sum by parts cannot stand on, each with what to do about it.
TEST(BadInputOfFiniteVolumes, SummingByPartsSaysWhatItDoesNotGoWith) {
  const Folder folder;
  folder.write("case.toml", sound_case);
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"scheme.face_correction=1/6", "set it to 0"},
      {"fvm.order=6 --set scheme.reconstruction=linear", "quartic"}};
  for (const auto& [setting, told] : refused) {
    const auto outcome =
        diptych(folder,
                "run case.toml --method fvm --quiet --out out --set mesh.cells=[4,4,4] "
                "--set fvm.stencil=sbp --set " +
                    setting);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("fvm.stencil = \"sbp\""), HasSubstr(told)));
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
}

/// A side of four cells has too few nodes for order 4: said in the log and in the summary.
TEST(ShortLines, AreSaidInTheLogAndInTheSummary) {
  const Folder folder;
  folder.write("case.toml", sound_case);
  const auto outcome = diptych(folder,
                               "run case.toml --method fvm --out out --set mesh.cells=[7,4,8] "
                               "--set fvm.stencil=sbp");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::string lost = "order 2 instead of 4 along (0, 1, 0): its lines have 5 nodes";
  EXPECT_THAT(outcome.text, HasSubstr(lost));
  std::ifstream summary(folder.path() / "out" / "fvm" / "summary.json");
  const std::string text{std::istreambuf_iterator<char>(summary), {}};
  EXPECT_THAT(text, HasSubstr("order 4 on 8 nodes along (1, 0, 0), order 2 on 5 nodes along"));
}

TEST(BadMesh, InvertedCellIsNamed) {
  const Folder folder;
  // two tetrahedra of opposite orientation
  folder.write("bad.msh",
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
               "4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 4\n"
               "2 4 2 1 1 2 4 3 5\n$EndElements\n");
  folder.write("case.toml",
               with("lower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [2, 2, 2]", "file = \"bad.msh\"")
                   .replace(sound_case.find("hexahedron"), 10, "tetrahedron"));
  const auto outcome = diptych(folder, "run case.toml --quiet --out out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("bad.msh"), HasSubstr("cell")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(BadMesh, CellsOfAnotherElementAreNamed) {
  const Folder folder;
  folder.write("pair.msh",
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
               "4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 4\n"
               "2 4 2 1 1 2 3 4 5\n$EndElements\n");
  folder.write("case.toml", with("lower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [2, 2, 2]",
                                 "file = \"pair.msh\""));
  const auto outcome = diptych(folder, "run case.toml --quiet --out out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("case.toml: mesh.element = \"hexahedron\""),
                                  HasSubstr("write mesh.element = \"tetrahedron\"")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(CommandLine, WrongWordsEndWithCodeTwo) {
  const Folder folder;
  for (const char* arguments :
       {"",
        "fly",
        "run",
        "run no-such-case",
        "run swinging-cube-elastic-hex --method fem",
        "run swinging-cube-elastic-hex --level -1",
        "run swinging-cube-elastic-hex --levle 1",
        "run swinging-cube-elastic-hex --set mesh.cels=[1,1,1]",
        "explain mesh.cels",
        "converge swinging-cube-elastic-hex --levels 1",
        "study swinging-cube-elastic-hex --vary sph.kappa",
        "study swinging-cube-elastic-hex --vary sph.kapa=1,2",
        "study swinging-cube-elastic-hex --levels 0",
        "study swinging-cube-elastic-hex --field stres --levels 1 --repeats 1 --quiet",
        "study swinging-cube-elastic-hex --stability --integrators rk5",
        "study swinging-cube-elastic-hex --stability --steps 3",
        "study swinging-cube-elastic-hex --stability --levels 2",
        "study swinging-cube-elastic-hex --local-steps --levels 2",
        "study swinging-cube-elastic-hex --local-steps --steps 100",
        "study swinging-cube-elastic-hex --local-steps --repeats 2",
        "study swinging-cube-elastic-hex --local-steps --field stress"}) {
    const auto outcome = diptych(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << ": " << outcome.text;
    EXPECT_FALSE(outcome.text.empty()) << arguments;
  }
  EXPECT_THAT(diptych(folder, "run swinging-cube-elastic-hx").text,
              HasSubstr("swinging-cube-elastic-hex"));
  EXPECT_TRUE(folder.is_empty());
}

TEST(CommandLine, FolderOfSomebodyElseIsNotTouched) {
  const Folder folder;
  std::filesystem::create_directories(folder.path() / "mine" / "sph");
  folder.write("mine/sph/thesis.txt", "years of work");
  const auto outcome =
      diptych(folder, "run swinging-cube-elastic-hex --quiet --threads 1 --out mine");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_EQ(tests::text_of(folder.path() / "mine" / "sph" / "thesis.txt"), "years of work");
}

TEST(CommandLine, BreakdownEndsWithCodeThreeAndASummary) {
  const Folder folder;
  folder.write("case.toml", sound_case + "[initial]\nvelocity = [\"-3e4*x\", \"0\", \"0\"]\n");
  const auto outcome = diptych(folder, "run case.toml --method fvm --quiet --threads 1 --out out");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("node"), HasSubstr("step")));
  EXPECT_THAT(tests::text_of(folder.path() / "out" / "fvm" / "summary.json"),
              HasSubstr("\"breakdown\""));
}

TEST(CommandLine, OutputThatCannotBeWrittenEndsWithCodeFour) {
  const Folder folder;
  const auto outcome = diptych(
      folder, "run swinging-cube-elastic-hex --quiet --threads 1 --out /proc/no-such-place");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("/proc/no-such-place"));
}

}  // namespace
}  // namespace diptych
