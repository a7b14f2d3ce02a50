#pragma once
/// Expressions of the case language: functions of x, y, z (reference position, m) and t (s), named
/// parameters, `pi`, and named functions of time (see TimeFunction). muParser says what is an
/// expression and what a constant is worth; a wrong name or syntax is an InputError with file,
/// line, column and the nearest known name. Values are those of a Program, of many places at once
/// those of PlacedExpressions. A result that is not finite is an InputError too.

#include "common/algebra/vectors.hpp"

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace diptych::functions {

using algebra::Mat3;
using algebra::Vec3;

/// A place in a case file; line 0 for values given on the command line.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;  ///< 0 where it is not known
};

/// "file:line:column: "; what is 0 is left out.
std::string prefix(const SourcePlace& where);

/// A function of time, or of place and time, that expressions may use as a variable: name ->
/// value(t). Several names may come from one object (q, q_dot, q_1, ...).
class TimeFunction {
 public:
  virtual ~TimeFunction() = default;
  virtual std::vector<std::string> names() const = 0;
  /// values of names() at time t, same order; at X = 0 where they depend on the place
  virtual std::vector<double> values(double t) const = 0;
  virtual bool depends_on_position() const { return false; }
  /// values of names() at reference position X  [m]
  virtual std::vector<double> values_at(const Vec3& /*X*/, double t) const { return values(t); }
  /// The same of many places; several threads may ask at a time, where several places are
  /// evaluated.
  /// @param values  [X][names()]
  virtual void values_at_all(std::span<const Vec3> X, double t, double* values) const;
};

/// Names that expressions may use.
struct Vocabulary {
  std::map<std::string, double> parameters;
  std::vector<std::shared_ptr<const TimeFunction>> time_functions;
};

/// A number written as an expression of parameters only, as in end = "1.25*2*pi/omega".
/// @param  where place of the first character of text
/// @throws base::InputError on x, y, z, t, unknown names, wrong syntax, a result that is not finite
double constant_value(const std::string& text,
                      const std::map<std::string, double>& parameters,
                      const SourcePlace& where);

/// Names that parameters and time functions may not take: x, y, z, t, pi and the functions (sin,
/// ...).
const std::vector<std::string>& reserved_names();

/// A letter or '_', then letters, digits or '_', all ASCII.
bool is_name(const std::string& text);

/// One scalar expression. Copies share what is compiled; not for concurrent use.
class Expression {
 public:
  Expression() = default;  ///< the constant 0
  explicit Expression(double constant);
  /// @param  where place of the first character of text
  /// @throws base::InputError
  Expression(const std::string& text, const Vocabulary& vocabulary, const SourcePlace& where);
  double operator()(const Vec3& X, double t) const;
  bool depends_on_time() const;
  bool depends_on_position() const;
  /// More than by a sum of products of what depends on place alone and on time alone.
  bool joins_place_and_time() const;
  bool is_zero() const;  ///< the constant 0
  std::string text() const;
  /// The names of the vocabulary that the text uses.
  const Vocabulary& vocabulary() const;
  const SourcePlace& where() const;
  /// @throws base::InputError: this value at X and t is not finite
  [[noreturn]] void refuse_value(double value, const Vec3& X, double t) const;

 private:
  struct Compiled;
  std::shared_ptr<Compiled> compiled_;
};

struct VectorExpression {
  std::array<Expression, 3> component;
  Vec3 operator()(const Vec3& X, double t) const {
    return {component[0](X, t), component[1](X, t), component[2](X, t)};
  }
  bool depends_on_time() const {
    return component[0].depends_on_time() || component[1].depends_on_time() ||
           component[2].depends_on_time();
  }
  bool depends_on_position() const {
    return component[0].depends_on_position() || component[1].depends_on_position() ||
           component[2].depends_on_position();
  }
  bool joins_place_and_time() const {
    return component[0].joins_place_and_time() || component[1].joins_place_and_time() ||
           component[2].joins_place_and_time();
  }
  bool is_zero() const {
    return component[0].is_zero() && component[1].is_zero() && component[2].is_zero();
  }
};

struct TensorExpression {
  std::array<Expression, 9> component;  ///< row-major
  Mat3 operator()(const Vec3& X, double t) const {
    Mat3 T;
    for (int i = 0; i < 9; ++i)
      T(i / 3, i % 3) = component[i](X, t);
    return T;
  }
};

}  // namespace diptych::functions
