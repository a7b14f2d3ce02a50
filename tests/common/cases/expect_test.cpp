/// The sections [expect] and [[expect.unmet]]: pass numbers of a case.

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::HasSubstr;

const std::string block =
    "[parameters]\nf = 0.8\n[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\n"
    "density = 1\nshear_modulus = 1\nlame = 1\n[time]\nend = 1\n";

ExpectCase expect_of(const std::string& text) {
  return case_from_text(block + text, "case.toml").expect;
}

std::string refusal_of(const std::string& text) {
  try {
    expect_of(text);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Expect, HoldsBoundsWithParameters) {
  EXPECT_FALSE(expect_of("").is_given);
  const ExpectCase expect = expect_of("[expect]\nholds = ['tip, final <= 2*f', 'least J>=f/2']\n");
  EXPECT_TRUE(expect.is_given);
  ASSERT_EQ(expect.holds.size(), 2U);
  EXPECT_EQ(expect.holds[0].figure, "tip, final");
  EXPECT_TRUE(expect.holds[0].at_most);
  EXPECT_EQ(expect.holds[0].value, 1.6);
  EXPECT_EQ(expect.holds[1].figure, "least J");
  EXPECT_FALSE(expect.holds[1].at_most);
  EXPECT_EQ(expect.holds[1].value, 0.4);
}

TEST(Expect, BoundsAreMetByFiniteNumbersOnly) {
  const BoundCase most{"", "", true, 1, {}}, least{"", "", false, 1, {}};
  EXPECT_TRUE(most.is_met_by(1) && least.is_met_by(1));
  EXPECT_FALSE(most.is_met_by(1.1) || least.is_met_by(0.9));
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_FALSE(most.is_met_by(none) || least.is_met_by(none)) << none;
}

TEST(Expect, SaysWhoDoesNotMeetThemAndWhy) {
  const ExpectCase expect = expect_of(
      "[expect]\nvariants = ['sph.kappa=0.75']\n[[expect.unmet]]\nmethod = 'sph'\n"
      "variant = 'sph.kappa=0.75'\nstops = 'inside out'\nby_step = 9\nbecause = 'pressure'\n");
  ASSERT_EQ(expect.unmet.size(), 1U);
  EXPECT_EQ(expect.unmet[0].method, "sph");
  EXPECT_EQ(expect.unmet[0].stops, "inside out");
  EXPECT_EQ(expect.unmet[0].by_step, 9);
  EXPECT_EQ(expect.unmet[0].because, "pressure");
}

TEST(Expect, RefusesWhatSaysNothing) {
  EXPECT_THAT(refusal_of("[expect]\nholds = ['least J < 1']\n"), HasSubstr("is no bound"));
  EXPECT_THAT(refusal_of("[expect]\nholds = ['<= 1']\n"), HasSubstr("is no bound"));
  EXPECT_THAT(refusal_of("[expect]\nholds = ['least J <= g']\n"), HasSubstr("'g'"));
  EXPECT_THAT(refusal_of("[expect]\nby_step = 3\n"), HasSubstr("no effect without expect.stops"));
  EXPECT_THAT(refusal_of("[expect]\nstops = 'a'\nholds = ['least J <= 1']\n"),
              HasSubstr("to be stopped"));
  EXPECT_THAT(refusal_of("[[expect.unmet]]\nmethod = 'sph'\n"), HasSubstr("because"));
  EXPECT_THAT(refusal_of("[[expect.unmet]]\nmethod = 'sph'\nvariant = 'a=1'\nbecause = 'b'\n"),
              HasSubstr("none of expect.variants"));
}

}  // namespace
}  // namespace diptych::cases
