/// Programs against muParser, which evaluates the same texts by itself, against differences, and
/// against themselves at other places, in other company and with other numbers of threads.

#include "common/base/error.hpp"
#include "common/functions/expression_function.hpp"
#include "common/functions/placed_values.hpp"

#include <gmock/gmock.h>
#include <muParser.h>
#include <random>

namespace diptych::functions {
namespace {

using testing::HasSubstr;

const Vocabulary vocabulary{{{"a", 0.3}, {"w", 2.5}}, {}};

const char* const smooth_texts[] = {
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
    "exp(-x^2)*a*t*sin(3*y)*(2*t)/w*(z/t)",
    "tan(0.3*x*t) + atan(x*y - t)",
    "asin(0.4*x*y) - acos(0.3*z*t)",
    "sinh(x - t)*cosh(y*z)/tanh(z + t)",
    "asinh(x*t - y) + acosh(2 + x*z) - atanh(0.3*y*t)",
    "log(1 + x*y*t) + ln(2 + z) - sqrt(x + y*z*t)",
    "sin(w*t)^2 + exp(a*t)*x - 3*(x - (y - (z - t)))",
    "1/(1 + x^2 + t*y) + 2/z",
    "x*cos(a*t*exp(-x^2)) - y*sin(a*t*exp(-x^2)) - x",
    "+x -\t1e-1*y\n + 2E+1*z\r + 3e0*t + .5*x",
    "x^0 + y^1 + (x + 2)^0.5 + (y + 2)^2",
};

const char* const other_texts[] = {
    "x < 0.5 ? y : -y",
    "x < 0.5 ? y < 0.5 ? 1 : 2 : t > 1 ? 3 : 4",
    "1 + (x <= y) + 2*(x >= z) - 3*(x > t)*(y == y) + 5*(z != t)",
    "x < y && y < z || t < x",
    "min(x, y*t, z) + max(x, 0.5, t) + sum(x, y, z, t) + avg(x, y*t, 3)",
    "abs(x - 0.5) + sign(y - t) + rint(3*z) + rint(-3*x)",
    "atan2(y - 0.5, x - 0.5) + log2(1 + x) + log10(2 + y*t)",
    "(x + t)^y + x^(t - 1)",
    "-x < -y == 1",
    "2 - x ? 3*t : 4",
    "(x - 0.5)*(x > 0.5)*sin(w*t)",
    "log(x - 2) > 0 ? 1 : x",
    "abs(-2)*x + min(1, 2)*y + min(2, 1) + max(1, 2)*z + max(2, 1) + (3 - 2)*t",
    "(1 == 1)*x + (1 == 2)*y + (1 != 2)*z + (2 != 2)*t + sign(2) + sign(-2)*x + sign(0)",
};

double by_muparser(const std::string& text, const Vec3& X, double t) {
  mu::Parser parser;
  Vec3 place = X;
  double time = t;
  parser.DefineConst("pi", 3.14159265358979323846);
  for (const auto& [name, value] : vocabulary.parameters)
    parser.DefineConst(name, value);
  for (int i = 0; i < 3; ++i)
    parser.DefineVar(std::string(1, "xyz"[i]), &place[i]);
  parser.DefineVar("t", &time);
  parser.SetExpr(text);
  return parser.Eval();
}

std::vector<Vec3> random_places(size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(0.05, 0.95);
  std::vector<Vec3> X;
  for (size_t a = 0; a < n; ++a)
    X.emplace_back(draw(random), draw(random), draw(random));
  return X;
}

std::vector<double> values_at(const std::string& text, const std::vector<Vec3>& X, double t) {
  return PlacedExpressions({Expression(text, vocabulary, {})}, X).at(t);
}

TEST(Program, AgreesWithMuParser) {
  const std::vector<Vec3> X = random_places(150);
  const auto agrees = [&](const char* text) {
    const PlacedExpressions placed({Expression(text, vocabulary, {})}, X);
    for (const double t : {0.3, 1.2}) {
      const std::vector<double> values = placed.at(t);
      for (size_t a = 0; a < X.size(); ++a) {
        const double value = by_muparser(text, X[a], t);
        EXPECT_NEAR(values[a], value, 2e-14 * (1 + std::abs(value))) << text << " at " << X[a];
      }
    }
  };
  for (const char* text : smooth_texts)
    agrees(text);
  for (const char* text : other_texts)
    agrees(text);
}

TEST(Program, DerivativesAreThoseOfDifferences) {
  const double t = 1.2, step = 1e-4;
  for (const char* text : smooth_texts) {
    const auto program = std::make_shared<Program>();
    std::vector<int> results{program->append(text, vocabulary, {}, Program::Accepts::smooth)};
    for (int i = 0; i < 4; ++i)
      results.push_back(program->derivative(results[0], i));
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j)
        results.push_back(program->derivative(results[static_cast<size_t>(1 + i)], j));
    }
    const auto at = [&](const Vec3& X, double time) {
      std::vector<double> values(results.size());
      PlacedValues(program, results, {&X, 1}).at(time, values);
      return values;
    };
    const Vec3 X(0.7, 0.45, 0.9);
    const std::vector<double> f = at(X, t);
    for (int i = 0; i < 4; ++i) {
      const Vec3 shift = i < 3 ? Vec3(step * Vec3::Unit(i)) : Vec3(Vec3::Zero());
      const double later = i < 3 ? 0 : step;
      const auto above = at(X + shift, t + later), below = at(X - shift, t - later);
      // central differences: h^2 f'''/6 of functions whose third derivatives are below 100
      EXPECT_NEAR(f[static_cast<size_t>(1 + i)], (above[0] - below[0]) / (2 * step), 3e-7)
          << text << " by " << i;
      for (int j = 0; j < 4; ++j) {
        const auto first = static_cast<size_t>(1 + j), second = static_cast<size_t>(5 + 4 * j + i);
        EXPECT_NEAR(f[second], (above[first] - below[first]) / (2 * step), 3e-6)
            << text << " by " << i << ", " << j;
      }
    }
  }
}

TEST(Program, KeepsCommonPartsOnce) {
  Program program;
  const auto append = [&](const char* text) {
    return program.append(text, vocabulary, {}, Program::Accepts::smooth);
  };
  const int both = append("sin(w*t)*cos(pi*x)");
  const int size = program.size();
  append("cos(pi*x)");
  append("sin(w*t)");
  EXPECT_EQ(append("cos(pi*x)*sin(w*t)"), both);
  EXPECT_EQ(program.size(), size);
  // a second derivative of a wave is the wave, scaled
  const int second = program.derivative(program.derivative(append("sin(2*x)*exp(t)"), 0), 0);
  EXPECT_EQ(second, append("-4*(sin(2*x)*exp(t))"));
}

TEST(Program, CollectsWhatDependsOnTimeAndOnPlace) {
  Program program;
  const auto append = [&](const char* text) {
    return program.append(text, vocabulary, {}, Program::Accepts::smooth);
  };
  const Operation& product = program[append("a*t*sin(x)*exp(t)*y*(3*cos(t))*z")];
  ASSERT_EQ(product.op, Operator::scale);
  const Operation& factors = program[product.first];
  ASSERT_EQ(factors.op, Operator::multiply);
  EXPECT_NE(program[factors.first].is_of_time(), program[factors.second].is_of_time());
  EXPECT_NE(program[factors.first].is_of_place(), program[factors.second].is_of_place());
}

TEST(Program, PutsNamedExpressionsInTheirPlace) {
  Vocabulary named = vocabulary;
  const auto define = [&](const char* name, const char* text) {
    named.time_functions.push_back(
        std::make_shared<ExpressionFunction>(name, Expression(text, named, {})));
  };
  define("q", "sin(w*t) - x");
  define("theta", "q*exp(y)");
  Program program;
  const int result = program.append("2*theta^2/q", named, {}, Program::Accepts::smooth);
  EXPECT_EQ(result, program.append("2*((sin(w*t) - x)*exp(y))^2/(sin(w*t) - x)", vocabulary, {},
                                   Program::Accepts::smooth));
}

/// Counts at how many places it is asked.
class Counting : public TimeFunction {
 public:
  std::vector<std::string> names() const override { return {"d", "d_dot"}; }
  std::vector<double> values(double t) const override { return values_at(Vec3::Zero(), t); }
  bool depends_on_position() const override { return true; }
  std::vector<double> values_at(const Vec3& X, double t) const override {
#pragma omp atomic
    ++n_calls;
    return {X[0] * t, X[0]};
  }
  mutable int n_calls = 0;
};

TEST(Program, AsksAFunctionOncePerPlaceAndInstant) {
  const auto counting = std::make_shared<Counting>();
  Vocabulary named = vocabulary;
  named.time_functions.push_back(counting);
  // each of 200 names the one before it three times
  const auto define = [&](int k) {
    const std::string before = k == 0 ? "d" : "f" + std::to_string(k - 1);
    const std::string text = before + "/2 + sin(" + before + ")*d_dot/2 + 0*" + before;
    named.time_functions.push_back(
        std::make_shared<ExpressionFunction>("f" + std::to_string(k), Expression(text, named, {})));
  };
  for (int k = 0; k < 200; ++k)
    define(k);
  const std::vector<Vec3> X = random_places(125);
  const PlacedExpressions placed(
      {Expression("f199", named, {}), Expression("f199 + f198", named, {})}, X);
  EXPECT_EQ(counting->n_calls, 0);
  placed.at(0.5);
  EXPECT_EQ(counting->n_calls, 125);
}

TEST(Program, AValueDoesNotDependOnItsCompany) {
  const std::vector<Vec3> X = random_places(1000);
  for (const char* text : smooth_texts) {
    const std::vector<double> all = values_at(text, X, 0.7);
    const std::vector<double> some = values_at(text, {X.begin() + 411, X.begin() + 420}, 0.7);
    const Expression alone(text, vocabulary, {});
    for (size_t a = 411; a < 420; ++a) {
      EXPECT_EQ(all[a], some[a - 411]) << text;
      EXPECT_EQ(all[a], alone(X[a], 0.7)) << text;
    }
    const int threads = parallel::n_threads();
    parallel::set_threads(threads == 1 ? 2 : 1);
    EXPECT_EQ(values_at(text, X, 0.7), all) << text;
    parallel::set_threads(threads);
  }
}

TEST(Program, ReportsAValueThatIsNotFinite) {
  try {
    values_at("1/(x - 0.5)", {Vec3(0.1, 0, 0), Vec3(0.5, 2, 3)}, 0);
    FAIL() << "1/0 went unnoticed";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("its value is inf at X = (0.5, 2, 3), t = 0"));
  }
}

std::string refusal(const std::string& text) {
  Program program;
  try {
    program.append(text, vocabulary, {"case.toml", 3, 10}, Program::Accepts::smooth);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Program, RefusesWhatHasNoTwoDerivatives) {
  EXPECT_THAT(refusal("x + abs(y)"), HasSubstr("case.toml:3:14: "));
  EXPECT_THAT(refusal("x + abs(y)"), HasSubstr("'abs' has no two derivatives"));
  EXPECT_THAT(refusal("x > 1 ? x : 0"), HasSubstr("'>' has no derivative"));
  EXPECT_THAT(refusal("max(x, y)"), HasSubstr("'max'"));
  EXPECT_THAT(refusal("(x == 1)"), HasSubstr("'=' has no derivative"));
  EXPECT_THAT(refusal("q_dot*x"), HasSubstr("'q_dot' has no derivatives"));
}

VectorExpression vector_of(const char* x, const char* y, const char* z) {
  return {{Expression(x, vocabulary, {}), Expression(y, vocabulary, {}),
           Expression(z, vocabulary, {})}};
}

const std::vector<Vec3> places = {{0.1, 0.2, 0.3}, {0.7, -0.4, 0.5}, {-0.3, 0.6, 0.9}};

TEST(GradientsOf, AreThoseOfDifferences) {
  const VectorExpression u = vector_of("x^2*y + t*z", "sin(w*x)*z", "exp(y)*x - z^3");
  for (const int dimension : {2, 3}) {
    auto gradients = gradients_of(u, dimension, places);
    ASSERT_TRUE(gradients);
    const auto n = static_cast<size_t>(dimension * dimension);
    std::vector<double> values(places.size() * n);
    gradients->at(0.4, values);
    for (size_t a = 0; a < places.size(); ++a) {
      for (int i = 0; i < dimension; ++i) {
        for (int j = 0; j < dimension; ++j) {
          const Vec3 step = 1e-5 * Vec3::Unit(j);
          const Vec3 difference = (u(places[a] + step, 0.4) - u(places[a] - step, 0.4)) / 2e-5;
          EXPECT_NEAR(values[a * n + static_cast<size_t>(i * dimension + j)], difference[i], 1e-8);
        }
      }
    }
  }
  EXPECT_FALSE(gradients_of(vector_of("abs(x)", "y", "z"), 3, places));
  EXPECT_TRUE(gradients_of(vector_of("abs(t)*x", "y", "z"), 3, places)) << "smooth in place";
}

TEST(PlacedExpressions, AreTheExpressionsAtEachPlace) {
  const VectorExpression u = vector_of("x*t", "y - z", "a*x");
  TensorExpression F;
  for (size_t k = 0; k < 9; ++k)
    F.component[k] = Expression(std::to_string(k) + "*x + y*t", vocabulary, {});
  const auto vectors = vectors_at(u, places, 0.4);
  const auto tensors = tensors_at(F, places, 0.4);
  ASSERT_EQ(vectors.size(), places.size());
  ASSERT_EQ(tensors.size(), places.size());
  for (size_t a = 0; a < places.size(); ++a) {
    EXPECT_LE((vectors[a] - u(places[a], 0.4)).norm(), 1e-15);
    EXPECT_LE((tensors[a] - F(places[a], 0.4)).norm(), 1e-14);
  }
}

TEST(Program, AtAPlaceHasTheValuesThere) {
  const Vec3 place(0.3, 0.7, 0.2);
  Vocabulary names = vocabulary;
  names.time_functions.push_back(
      std::make_shared<ExpressionFunction>("g", Expression("exp(-(t - x)^2)", vocabulary, {})));
  std::vector<std::string> texts{"g*y + g^2"};
  texts.insert(texts.end(), std::begin(smooth_texts), std::end(smooth_texts));
  texts.insert(texts.end(), std::begin(other_texts), std::end(other_texts));
  for (const std::string& text : texts) {
    const Expression expression(text, names, {});
    const auto program = std::make_shared<Program>();
    const int result = program->append(expression, place);
    EXPECT_FALSE((*program)[result].on_position) << text;
    const std::vector<Vec3> elsewhere{Vec3::Zero()};
    const PlacedValues placed(program, {result}, elsewhere);
    for (const double t : {0.1, 0.4}) {
      double value = 0;
      placed.at(t, {&value, 1});
      const double wanted = expression(place, t);
      EXPECT_NEAR(value, wanted, 1e-13 * (1 + std::abs(wanted))) << text;
    }
  }
}

TEST(Program, TellsWhatJoinsPlaceAndTimeFromSumsOfProducts) {
  const auto joins = [](const char* text) {
    return Expression(text, vocabulary, {}).joins_place_and_time();
  };
  for (const char* text :
       {"x*sin(3*t)", "t", "x*y", "1 + x*t - y^2*exp(-t)", "(x + t)*(y - t)/t",
        "x > 0.4 ? sin(t) : 2*t", "t < 0.1 && x > 0.2 ? 3 : x", "t < 1 && x > 0 && y > 0 ? t : 0"})
    EXPECT_FALSE(joins(text)) << text;
  for (const char* text : {"sin(x - t)", "x < t ? 1 : 0", "abs(t - (x < 0.5 ? 1 : 2))",
                           "(x + t)^0.5", "1/(x + t)", "max(x*t, y)", "x < t && y > 0 ? 1 : 0"})
    EXPECT_TRUE(joins(text)) << text;
}

}  // namespace
}  // namespace diptych::functions
