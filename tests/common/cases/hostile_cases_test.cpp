/// Case files that are small and ask for much: depth, functions of functions, files without end.
/// Each of these once crashed, hung or ate memory.

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "tests/common/io/scratch.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <sys/stat.h>

namespace diptych::cases {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string sound =
    "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 1100\n"
    "youngs_modulus = 17e6\npoissons_ratio = 0.3\n[time]\nend = 1.0\n";

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    case_from_text(text, "case.toml", overrides);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string repeated(const std::string& part, int n) {
  std::string text;
  for (int i = 0; i < n; ++i)
    text += part;
  return text;
}

TEST(HostileCases, DepthIsBoundedWithItsLine) {
  constexpr int n = 20000;
  const std::string told = "more than 32 levels";
  EXPECT_THAT(refusal("\n" + repeated("a.", n) + "b = 1\n"),
              AllOf(StartsWith("case.toml:2:64: "), HasSubstr("a key has " + told)));
  EXPECT_THAT(refusal("[" + repeated("a.", n) + "b]\n"), HasSubstr(told));
  EXPECT_THAT(refusal("[[" + repeated("'a' . ", n) + "b]]\n"), HasSubstr(told));
  EXPECT_THAT(refusal("a = " + repeated("[", n)),
              AllOf(StartsWith("case.toml:1:"), HasSubstr(told)));
  EXPECT_THAT(refusal("a = " + repeated("{b = ", n)), HasSubstr("values are nested " + told));
  EXPECT_THAT(refusal("a = {" + repeated("b.", n) + "c = 1}\n"), HasSubstr(told));
  EXPECT_THAT(refusal(sound, {"mesh.cells={" + repeated("b.", n) + "c = 1}"}), HasSubstr(told));
  EXPECT_THAT(refusal(sound, {repeated("b.", n) + "c=1"}), HasSubstr("unknown key"));
}

TEST(HostileCases, StringsAndCommentsAreNoDepth) {
  const std::string deep = repeated("[{a.", 1000);
  for (const std::string& title :
       {"title = \"" + deep + "\\\"" + deep + "\"", "title = '" + deep + "'",
        "title = \"x\" # " + deep + "\"", "# '" + deep}) {
    EXPECT_EQ(refusal(title + "\n" + sound), "accepted") << title.substr(0, 30);
  }
  // over several lines: read as text, and refused as a title for its line ends only
  for (const char* quotes : {"\"\"\"", "'''"}) {
    EXPECT_THAT(refusal("title = " + std::string(quotes) + "\n" + deep + "\"'\n" + deep + quotes +
                        "\n" + sound),
                HasSubstr("control characters"));
  }
  // a missing quote hides nothing on the next line
  EXPECT_THAT(refusal("title = \"abc\n" + deep), HasSubstr("case.toml:2:"));
}

/// [functions.f1] to [functions.fn]; f0 is `first`.
std::string chain(const std::string& first,
                  int n,
                  const std::string& before,
                  const std::string& two) {
  std::string text = "[functions.f0]\ntype = 'expression'\nvalue = '" + first + "'\n";
  for (int k = 1; k <= n; ++k) {
    const std::string f = fmt::format("f{}", k - 1);
    const std::string g = two.empty() ? f : fmt::format("f{}", std::max(k - 2, 0));
    text +=
        fmt::format("[functions.f{}]\ntype = 'expression'\nvalue = '{}{}{}'\n", k, f, before, g);
  }
  return text;
}

TEST(HostileCases, FunctionsThatNameOneAnotherAreWorkedOutOnce) {
  // sums of the two before: 2^60 evaluations where each is worked out anew for each that names it
  const Case c = case_from_text(
      chain("x + t", 90, " + 0*", "two") + sound + "[exact]\ndisplacement = ['f90', 0, 0]\n",
      "case.toml");
  const functions::Expression& u = c.exact.displacement->component[0];
  EXPECT_DOUBLE_EQ(u({2, 0, 0}, 3), 5);
  EXPECT_DOUBLE_EQ(u({4, 0, 0}, 3), 7) << "the place alone has changed";
  EXPECT_DOUBLE_EQ(u({4, 0, 0}, 1), 5) << "the time alone has changed";
  // squares in a motion: 2^30 terms where each is written out
  const Case squares = case_from_text(chain("1 + 1e-12*x*t", 30, "*", "") + sound +
                                          "[manufactured]\ndisplacement = ['1e-3*f30', '0', '0']\n",
                                      "case.toml");
  EXPECT_NEAR(squares.motion->displacement({1, 0, 0}, 1)[0], 1e-3 * std::exp(1073741824e-12), 1e-9);
}

TEST(HostileCases, DepthOfFunctionsIsBounded) {
  EXPECT_EQ(refusal(chain("t", 999, "+", "") + sound), "accepted");
  EXPECT_THAT(refusal(chain("t", 1002, "+", "") + sound),
              AllOf(HasSubstr("case.toml:3006:"), HasSubstr("more than 1000 functions")));
}

TEST(HostileCases, ChainedParametersEndAtTheirSum) {
  std::string text = "[parameters]\np0 = 1\n";
  for (int k = 1; k < 20000; ++k)
    text += fmt::format("p{} = 'p{} + 1'\n", k, k - 1);
  const Case c = case_from_text(
      text +
          "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 'p19999'\n"
          "youngs_modulus = 17e6\npoissons_ratio = 0.3\n[time]\nend = 1.0\n",
      "case.toml");
  EXPECT_EQ(c.material.density, 20000);
  EXPECT_THAT(refusal("[parameters]\nlength = 1\nb = 'lenght + 1'\n" + sound),
              AllOf(StartsWith("case.toml:3:6: "), HasSubstr("did you mean 'length'")));
}

class HostileFiles : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0); }
  std::string refusal_of_reference(const std::string& file) const {
    return refusal_of_file(sound +
                           "[[probe]]\nname = 'p'\nunit = 'm'\nat = [0, 0, 0]\nquantity = 'ux'\n"
                           "[[reference]]\nprobe = 'p'\nsource = 'nowhere'\nfile = '" +
                           file + "'\n");
  }
  std::string refusal_of_file(const std::string& text) const {
    std::ofstream(folder_ / "case.toml") << text;
    return read_refusal(folder_ / "case.toml");
  }
  static std::string read_refusal(const std::string& path) {
    try {
      read_case(path);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::Scratch folder_;
};

TEST_F(HostileFiles, ReferencesWithoutEndAreNotRead) {
  EXPECT_THAT(refusal_of_reference("/dev/zero"), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal_of_reference("pipe"), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal_of_reference("none.csv"), HasSubstr("no such file"));
  std::ofstream(folder_ / "long.csv") << "";
  std::filesystem::resize_file(folder_ / "long.csv", 10'000'000'000);  // holes, no disk
  EXPECT_THAT(refusal_of_reference("long.csv"), HasSubstr("more than 16777216 bytes"));
  std::ofstream(folder_ / "odd.csv") << "t,p\n" << std::string(100000, 'x') << "\n";
  EXPECT_LT(refusal_of_reference("odd.csv").size(), 400u) << "a line is shown in part";
}

TEST_F(HostileFiles, CaseFilesWithoutEndAreNotRead) {
  EXPECT_THAT(read_refusal("/dev/zero"), HasSubstr("not a regular file"));
  EXPECT_THAT(read_refusal(folder_ / "pipe"), HasSubstr("not a regular file"));
  std::ofstream(folder_ / "long.toml") << "";
  std::filesystem::resize_file(folder_ / "long.toml", 10'000'000'000);
  EXPECT_THAT(read_refusal(folder_ / "long.toml"), HasSubstr("more than 1048576 bytes"));
}

}  // namespace
}  // namespace diptych::cases
