/// [functions.NAME]: every type can be read, used in expressions, and is held to its own keys.

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::HasSubstr;

Case case_with(const std::string& functions, const std::string& displacement) {
  return case_from_text(functions +
                            "\n[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\n"
                            "density = 1\nshear_modulus = 1\nlame = 1\n[time]\nend = 1\n"
                            "[exact]\ndisplacement = ['" +
                            displacement + "', 0, 0]\n",
                        "case.toml");
}

std::string refusal(const std::string& functions) {
  try {
    case_with(functions, "0");
    return "";
  } catch (const base::InputError& error) {
    return error.what();
  }
}

TEST(CaseFunctions, ExpressionsMayUseEarlierOnesAndThePlace) {
  const Case c = case_with(
      "[functions.a]\ntype = 'expression'\nvalue = '1 + t'\n"
      "[functions.b]\ntype = 'expression'\nvalue = 'a*x'\n",
      "b^2 + a");
  const functions::Expression& u = c.exact.displacement->component[0];
  EXPECT_TRUE(u.depends_on_position());
  EXPECT_DOUBLE_EQ(u({2, 0, 0}, 1), 18);
  EXPECT_DOUBLE_EQ(u({3, 0, 0}, 1), 38) << "the place alone has changed";
  EXPECT_DOUBLE_EQ(u({3, 0, 0}, 0), 10) << "the time alone has changed";
}

TEST(CaseFunctions, BarAndImpactFollowThePlace) {
  const Case bar = case_with(
      "[functions.w]\ntype = 'zener_slab'\nlength = 1\ndensity = 1\nmodulus = 1\namplitude = 2\n",
      "w");
  EXPECT_NEAR((*bar.exact.displacement)({1, 0, 0}, 0.25)[0], 0.5, 1e-9);
  EXPECT_NEAR((*bar.exact.displacement)({0.9, 0, 0}, 0.25)[0], 0.3, 1e-9);
  const Case impact = case_with(
      "[functions.w]\ntype = 'uniaxial_wave'\nshear_modulus = 1\nlame = 1\ndensity = 1\n"
      "velocity = -0.1\n",
      "w_speed + w");
  EXPECT_NEAR((*impact.exact.displacement)({1, 0, 0}, 0)[0],
              (*impact.exact.displacement)({2, 0, 0}, 0)[0], 1e-15);
}

TEST(CaseFunctions, RefuseKeysOfOtherTypesAndWantTheirOwn) {
  EXPECT_THAT(refusal("[functions.a]\ntype = 'expression'\nvalue = 't'\nmodulus = 1\n"),
              HasSubstr("is no key of type = \"expression\""));
  EXPECT_THAT(refusal("[functions.w]\ntype = 'zener_wave'\ndensity = 1\nmodulus = 1\nlength = 1\n"),
              HasSubstr("is no key of type = \"zener_wave\""));
  EXPECT_THAT(refusal("[functions.w]\ntype = 'zener_slab'\ndensity = 1\nmodulus = 1\nlength = 1\n"
                      "signal = 'sine'\n"),
              HasSubstr("angular_frequency is missing"));
  EXPECT_THAT(refusal("[functions.w]\ntype = 'zener_slab'\ndensity = 1\nmodulus = 1\nlength = 1\n"
                      "angular_frequency = 1\n"),
              HasSubstr("no effect on a step"));
  EXPECT_THAT(refusal("[functions.b]\ntype = 'expression'\nvalue = 'a*x'\n"
                      "[functions.a]\ntype = 'expression'\nvalue = '1'\n"),
              HasSubstr("unknown name 'a'"));
}

}  // namespace
}  // namespace diptych::cases
