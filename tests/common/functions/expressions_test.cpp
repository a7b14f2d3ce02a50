#include "common/functions/expressions.hpp"

#include "common/base/error.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <locale>

namespace diptych::functions {
namespace {

using testing::HasSubstr;

const SourcePlace line_3{"case.toml", 3, 10};

/// Counts how often it is asked.
class Doubling : public TimeFunction {
 public:
  std::vector<std::string> names() const override { return {"d", "d_dot"}; }
  std::vector<double> values(double t) const override {
    ++n_calls;
    return {2 * t, 2};
  }
  mutable int n_calls = 0;
};

Vocabulary vocabulary() {
  return {{{"E", 17e6}, {"omega", 2.0}}, {}};
}

double value(const std::string& text, const Vec3& X = {1, 2, 3}, double t = 0.5) {
  return Expression(text, vocabulary(), line_3)(X, t);
}

std::string refusal(const std::string& text) {
  try {
    value(text);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_DOUBLE_EQ(value("x + 2*y - z/4"), 4.25);
  EXPECT_DOUBLE_EQ(value("-2^2"), -4);
  EXPECT_DOUBLE_EQ(value("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(value("1e-3*E + .5"), 17000.5);
  EXPECT_DOUBLE_EQ(value("sin(omega*t) + cos(pi*x)"), std::sin(1.0) - 1);
  EXPECT_DOUBLE_EQ(value("log(x + 1) - ln(2)"), 0);
  EXPECT_DOUBLE_EQ(value("t < 1 ? 7 : 8"), 7);
  EXPECT_DOUBLE_EQ(value("(t >= 1 || x == 1) && y != 3"), 1);
  EXPECT_DOUBLE_EQ(value("max(x, y, z)"), 3);
}

TEST(Expression, TellsWhatItDependsOn) {
  const auto made = [](const std::string& text) { return Expression(text, vocabulary(), line_3); };
  EXPECT_FALSE(made("E*pi").depends_on_time() || made("E*pi").depends_on_position());
  EXPECT_TRUE(made("t").depends_on_time());
  EXPECT_FALSE(made("t").depends_on_position());
  EXPECT_TRUE(made("z").depends_on_position());
  EXPECT_FALSE(made("z").depends_on_time());
  EXPECT_TRUE(made("E - E").is_zero());
  EXPECT_FALSE(made("x - x").is_zero());
  EXPECT_TRUE(Expression().is_zero());
  EXPECT_EQ(Expression()(Vec3::Ones(), 1), 0);
  EXPECT_EQ(Expression(2.5)(Vec3::Ones(), 1), 2.5);
}

TEST(Expression, ReportsWrongNamesAtTheirPlaceWithTheNearest) {
  EXPECT_THAT(refusal("1 + omgea*t"), HasSubstr("case.toml:3:14: "));
  EXPECT_THAT(refusal("1 + omgea*t"), HasSubstr("did you mean 'omega'?"));
  EXPECT_THAT(refusal("1 +\n  omgea"), HasSubstr("case.toml:4:3: "));
  EXPECT_THAT(refusal("sqr(x)"), HasSubstr("unknown function 'sqr'; did you mean 'sqrt'?"));
  EXPECT_THAT(refusal("sin x"), HasSubstr("needs its argument in parentheses"));
  EXPECT_THAT(refusal("Pi"), HasSubstr("did you mean 'pi'?"));
  EXPECT_THAT(refusal("_pi"), HasSubstr("unknown name '_pi'"));
  EXPECT_THAT(refusal("x0"), HasSubstr("unknown name 'x0'"));
}

TEST(Expression, RefusesWhatIsNoExpression) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("1 +"), HasSubstr("ends too early"));
  EXPECT_THAT(refusal("(x"), HasSubstr("parenthesis is not closed"));
  EXPECT_THAT(refusal("x)"), HasSubstr("case.toml:3:11: "));
  EXPECT_THAT(refusal("2x"), HasSubstr("operator is missing"));
  EXPECT_THAT(refusal("x y"), HasSubstr("operator is missing before 'y'"));
  EXPECT_THAT(refusal("x**2"), HasSubstr("a power is x^2"));
  EXPECT_THAT(refusal("1,5"), HasSubstr("decimals are written with a point"));
  EXPECT_THAT(refusal("t = 3"), HasSubstr("no assignments"));
  EXPECT_THAT(refusal("sin(1, 2)"), HasSubstr("too many arguments"));
  EXPECT_THAT(refusal("x; y"), HasSubstr("case.toml:3:11: "));
  EXPECT_THAT(refusal("\xC2\xB5*x"), HasSubstr("unknown character"));
  EXPECT_THAT(refusal(std::string(100000, '(')), HasSubstr("the most is 4096"));
  EXPECT_THAT(refusal(std::string(4000, '(')), HasSubstr("case.toml:3"));
}

TEST(Expression, RefusesResultsThatAreNotFinite) {
  EXPECT_THAT(refusal("1/0"), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("log(-1)"), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("1e400"), HasSubstr("case.toml:3:10: "));
  EXPECT_THAT(refusal("1/(x - 1)"), HasSubstr("its value is inf at X = (1, 2, 3), t = 0.5"));
  EXPECT_THROW(Expression(std::nan("")), base::InputError);

  // A refused time is asked again, not remembered.
  const Expression once("sqrt(t - 1)", vocabulary(), line_3);
  EXPECT_THROW(once(Vec3::Zero(), 0), base::InputError);
  EXPECT_THROW(once(Vec3::Zero(), 0), base::InputError);
  EXPECT_EQ(once(Vec3::Zero(), 5), 2);
}

TEST(Expression, AsksTimeFunctionsOncePerInstant) {
  const auto doubling = std::make_shared<Doubling>();
  Vocabulary v = vocabulary();
  v.time_functions.push_back(doubling);
  const Expression field("d*x + d_dot", v, line_3);
  EXPECT_TRUE(field.depends_on_time());
  for (int node = 0; node < 100; ++node)
    EXPECT_EQ(field(Vec3(node, 0, 0), 3), 6 * node + 2);
  EXPECT_EQ(doubling->n_calls, 1);
  EXPECT_EQ(field(Vec3(1, 0, 0), 4), 10);
  EXPECT_EQ(field(Vec3(1, 0, 0), 3), 8);
  EXPECT_EQ(doubling->n_calls, 3);

  const Expression idle("x*t", v, line_3);
  idle(Vec3::Ones(), 1);
  EXPECT_EQ(doubling->n_calls, 3);
}

TEST(Expression, CopiesShareOneMeaning) {
  const Expression original("x*t", vocabulary(), line_3);
  const Expression copy = original;
  EXPECT_EQ(copy(Vec3(2, 0, 0), 3), 6);
  EXPECT_EQ(original(Vec3(5, 0, 0), 3), 15);
  EXPECT_EQ(copy(Vec3(2, 0, 0), 3), 6);
}

TEST(Expression, IgnoresTheLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  EXPECT_EQ(value("1.5*x"), 1.5);
  EXPECT_EQ(value("12345.25"), 12345.25);
  std::locale::global(before);
}

TEST(ConstantValue, UsesParametersOnly) {
  const std::map<std::string, double> parameters{{"omega", 4.0}};
  EXPECT_DOUBLE_EQ(constant_value("2*pi/omega", parameters, line_3), std::acos(-1.0) / 2);
  try {
    constant_value("2*x", parameters, line_3);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("case.toml:3:12: "));
    EXPECT_THAT(error.what(), HasSubstr("parameters and pi only"));
  }
}

}  // namespace
}  // namespace diptych::functions
