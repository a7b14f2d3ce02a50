/// Smooth expressions: the same values as muParser, and derivatives against differences.

#include "common/exact/manufactured/motion.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/functions/expression_function.hpp"

#include <gmock/gmock.h>

namespace diptych::exact {
namespace {

using testing::HasSubstr;

const functions::Vocabulary vocabulary{{{"a", 0.3}, {"w", 2.5}}, {}};

/// Value, first and second derivatives by x, y, z, t of a text.
Jet<double, 4> jet(const std::string& text, const Vec3& X, double t) {
  Tape tape;
  const int result = tape.append(text, vocabulary, {});
  TapeEvaluation<double, 3, true> evaluated(tape);
  evaluated.place(X.data());
  evaluated.time(tape.at_time(t));
  return evaluated[result];
}

const char* const texts[] = {
    "1",
    "-2.5e-1*x",
    "x + y*z - t/w",
    "-x^2",
    "2^-2^x",
    "2^3^2*x",
    "x^-1.5 + (-y)^3",
    "(x + y)^(z*t)",
    "-x*-y/-z",
    "a*sin(w*t)*cos(pi*x)*exp(-y*z)",
    "tan(0.3*x*t) + atan(x*y - t)",
    "asin(0.4*x*y) - acos(0.3*z*t)",
    "sinh(x - t)*cosh(y*z)/tanh(z + t)",
    "asinh(x*t - y) + acosh(2 + x*z) - atanh(0.3*y*t)",
    "log(1 + x*y*t) + ln(2 + z) - sqrt(x + y*z*t)",
    "sin(w*t)^2 + exp(a*t)*x - 3*(x - (y - (z - t)))",
    "1/(1 + x^2 + t*y) + 2/z",
};

TEST(Tape, AgreesWithTheParserOfOtherExpressions) {
  const Vec3 X(0.7, 0.45, 0.9);
  for (const char* text : texts) {
    const double value = functions::Expression(text, vocabulary, {})(X, 1.2);
    EXPECT_NEAR(jet(text, X, 1.2).v, value, 1e-14 * (1 + std::abs(value))) << text;
  }
}

TEST(Tape, DerivativesAreThoseOfDifferences) {
  const Vec3 X(0.7, 0.45, 0.9);
  const double t = 1.2, step = 1e-4;
  for (const char* text : texts) {
    const Jet<double, 4> f = jet(text, X, t);
    for (int i = 0; i < 4; ++i) {
      const Vec3 shift = i < 3 ? Vec3(step * Vec3::Unit(i)) : Vec3(Vec3::Zero());
      const double later = i < 3 ? 0 : step;
      const auto above = jet(text, X + shift, t + later), below = jet(text, X - shift, t - later);
      // central differences: h^2 f'''/6 of functions whose third derivatives are below 100
      EXPECT_NEAR(f.d[i], (above.v - below.v) / (2 * step), 3e-7) << text << " by " << i;
      for (int j = 0; j < 4; ++j) {
        EXPECT_NEAR(f.dd[f.index(i, j)], (above.d[j] - below.d[j]) / (2 * step), 3e-6)
            << text << " by " << i << ", " << j;
      }
    }
  }
}

TEST(Tape, KeepsCommonPartsOnce) {
  Tape tape;
  tape.append("sin(w*t)*cos(pi*x)", vocabulary, {});
  const int size = tape.size();
  tape.append("cos(pi*x)", vocabulary, {});
  tape.append("sin(w*t)", vocabulary, {});
  EXPECT_EQ(tape.size(), size);
}

TEST(Tape, PutsNamedExpressionsInTheirPlace) {
  functions::Vocabulary named = vocabulary;
  const auto define = [&](const char* name, const char* text) {
    named.time_functions.push_back(std::make_shared<functions::ExpressionFunction>(
        name, functions::Expression(text, named, {})));
  };
  define("q", "sin(w*t) - x");
  define("theta", "q*exp(y)");
  Tape tape;
  const int result = tape.append("2*theta^2/q", named, {});
  EXPECT_EQ(result, tape.append("2*((sin(w*t) - x)*exp(y))^2/(sin(w*t) - x)", vocabulary, {}));
}

std::string refusal(const std::string& text) {
  Tape tape;
  try {
    tape.append(text, vocabulary, {"case.toml", 3, 10});
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Tape, RefusesWhatHasNoTwoDerivatives) {
  EXPECT_THAT(refusal("x + abs(y)"), HasSubstr("case.toml:3:14: "));
  EXPECT_THAT(refusal("x + abs(y)"), HasSubstr("'abs' has no two derivatives"));
  EXPECT_THAT(refusal("x > 1 ? x : 0"), HasSubstr("'>' has no derivative"));
  EXPECT_THAT(refusal("max(x, y)"), HasSubstr("'max'"));
  EXPECT_THAT(refusal("(x == 1)"), HasSubstr("'=' has no derivative"));
  EXPECT_THAT(refusal("q_dot*x"), HasSubstr("'q_dot' has no derivatives"));
}

TEST(Motion, GivesVelocityAndAcceleration) {
  const Motion motion({{"a*t^3*x", {}}, {"sin(w*t)*y", {}}}, vocabulary);
  const Vec3 X(0.5, 2, 0);
  EXPECT_EQ(motion.dimension(), 2);
  EXPECT_NEAR((motion.displacement(X, 2) - Vec3(0.3 * 8 * 0.5, 2 * std::sin(5), 0)).norm(), 0,
              1e-15);
  EXPECT_NEAR((motion.velocity(X, 2) - Vec3(0.3 * 12 * 0.5, 5 * std::cos(5), 0)).norm(), 0, 2e-15);
  EXPECT_NEAR((motion.acceleration(X, 2) - Vec3(0.3 * 12 * 0.5, -12.5 * std::sin(5), 0)).norm(), 0,
              5e-15);
}

// ---- case files
const std::string head = R"(
[mesh]
element = "quadrilateral"
cells = [4, 4]
[material]
model = "neo-hookean"
density = 1
shear_modulus = 1
lame = 1
[time]
end = 1
)";
const std::string motion = "[manufactured]\ndisplacement = [\"0.1*t*x\", 0.5]\n";
const std::string edge = "[[boundary]]\ngroup = \"x_min\"\n";

std::string complaint(const std::string& tail) {
  try {
    cases::case_from_text(head + tail, "case.toml");
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ManufacturedCase, HasTheMotionAndItsInitialState) {
  const cases::Case c = cases::case_from_text(
      head + motion + edge + "type = \"traction\"\nvalue = \"manufactured\"\n", "case.toml");
  ASSERT_NE(c.motion, nullptr);
  EXPECT_EQ(c.initial.motion, c.motion);
  EXPECT_TRUE(c.boundaries[0].manufactured);
  EXPECT_EQ(c.motion->velocity(Vec3(2, 3, 0), 0.3), Vec3(0.2, 0, 0));
  EXPECT_EQ(c.motion->displacement(Vec3(2, 3, 0), 0.5), Vec3(0.1, 0.5, 0));
  EXPECT_EQ(cases::case_from_text(head, "case.toml").motion, nullptr);
}

TEST(ManufacturedCase, RefusesWhatTheMotionAlreadyGives) {
  EXPECT_THAT(complaint(motion + "[load]\nbody_force = [1, 0]\n"),
              HasSubstr("load.body_force is already given by the motion"));
  EXPECT_THAT(complaint(motion + "[initial]\nvelocity = [1, 0]\n"),
              HasSubstr("initial.velocity is already given"));
  EXPECT_THAT(complaint(motion + "[exact]\ndisplacement = [1, 0]\n"),
              HasSubstr("exact.displacement is already given"));
  EXPECT_THAT(complaint("[manufactured]\n"), HasSubstr("manufactured.displacement is missing"));
  EXPECT_THAT(complaint("[manufactured]\ndisplacement = [\"abs(x)\", 0]\n"),
              HasSubstr("case.toml:13:18: in the motion 'abs(x)': the function 'abs'"));
  EXPECT_THAT(complaint("[manufactured]\ndisplacement = [\"x +\", 0]\n"),
              HasSubstr("it ends too early"));
}

TEST(ManufacturedCase, BoundariesFollowOnlyAMotionThatIsThere) {
  EXPECT_THAT(complaint(edge + "type = \"velocity\"\nvalue = \"manufactured\"\n"),
              HasSubstr("needs a motion; give it in [manufactured]"));
  EXPECT_THAT(complaint(motion + edge + "type = \"pressure\"\nvalue = \"manufactured\"\n"),
              HasSubstr("unknown name 'manufactured'"));
}

}  // namespace
}  // namespace diptych::exact
