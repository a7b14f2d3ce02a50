/// The copy of a case file that a run leaves reads as the same case.

#include "common/cases/copy.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string text =
    "[parameters]\nT = 2\n[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\n"
    "density = 1\nshear_modulus = 1\nlame = 1\n[time]\nend = \"T\"";  // no end of line

TEST(CaseCopy, IsTheSameCaseFromAnywhere) {
  const std::vector<std::string> set{"time.end=\"T/4\"", "sph.kappa=0.75", "title=a \"b\" \\ c"};
  const Case original = case_from_text(text, "/home/me/cube/case.toml", set);
  const Case copy = case_from_text(case_copy(original), "/tmp/results/case.toml");
  EXPECT_EQ(copy.hash, original.hash);
  EXPECT_EQ(copy.text, text);
  EXPECT_EQ(copy.name, "cube");
  EXPECT_EQ(copy.file, "/home/me/cube/case.toml");
  EXPECT_EQ(copy.overrides, set);
  EXPECT_EQ(copy.time.end, 0.5);
  EXPECT_EQ(copy.sph.kappa, 0.75);
  EXPECT_EQ(copy.title, "a \"b\" \\ c");
  const Case copy_of_copy = case_from_text(case_copy(copy), "/elsewhere/x.toml");
  EXPECT_EQ(copy_of_copy.hash, original.hash);
  EXPECT_EQ(case_copy(copy_of_copy), case_copy(original));
}

TEST(CaseCopy, TakesOverridesOfItsOwn) {
  const Case original = case_from_text(text, "/home/me/cube/case.toml", {"time.end=0.5"});
  const Case again =
      case_from_text(case_copy(original), "/tmp/case.toml", {"time.end=0.25", "sph.kappa=1"});
  EXPECT_EQ(again.time.end, 0.25);
  EXPECT_THAT(again.overrides, ElementsAre("time.end=0.25", "sph.kappa=1"));
}

TEST(CaseCopy, CannotBeMadeOnTheCommandLine) {
  try {
    case_from_text(text, "/home/me/case.toml", {"record.file=x"});
    FAIL() << "no error";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot be set"));
  }
}

TEST(CaseCopy, OfABrokenRecordIsRefused) {
  const std::string copy = case_copy(case_from_text(text, "/home/me/case.toml"));
  for (const char* overrides : {"3", "[3]", "[\"time.end\"]", "[\"time.emd=3\"]"}) {
    std::string broken = copy;
    broken.replace(broken.find("overrides = []"), 14, std::string("overrides = ") + overrides);
    EXPECT_THROW(case_from_text(broken, "/tmp/case.toml"), base::InputError) << overrides;
  }
}

}  // namespace
}  // namespace diptych::cases
