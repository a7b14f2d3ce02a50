/// Parser of the smooth part of the expression language, with the precedence of muParser: a sign
/// binds less than a power (-2^2 = -4), powers from the right (2^3^2 = 2^9).

#include "common/exact/manufactured/tape.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/functions/expression_function.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace diptych::exact {

namespace {

constexpr double pi = 3.14159265358979323846;

constexpr std::array smooth_functions{
    std::pair{"sin", Operator::sin},     std::pair{"cos", Operator::cos},
    std::pair{"tan", Operator::tan},     std::pair{"asin", Operator::asin},
    std::pair{"acos", Operator::acos},   std::pair{"atan", Operator::atan},
    std::pair{"sinh", Operator::sinh},   std::pair{"cosh", Operator::cosh},
    std::pair{"tanh", Operator::tanh},   std::pair{"asinh", Operator::asinh},
    std::pair{"acosh", Operator::acosh}, std::pair{"atanh", Operator::atanh},
    std::pair{"exp", Operator::exp},     std::pair{"log", Operator::log},
    std::pair{"ln", Operator::log},      std::pair{"sqrt", Operator::sqrt},
};

/// Places on the tape of the functions that were met before: each is parsed once, however many
/// others name it.
using Parsed = std::map<const functions::TimeFunction*, int>;

/// Recursive descent; every method leaves `at_` behind what it has read.
class SmoothParser {
 public:
  SmoothParser(Tape& tape,
               const std::string& text,
               const functions::Vocabulary& vocabulary,
               const functions::SourcePlace& where,
               Parsed& parsed)
      : tape_(tape), text_(text), vocabulary_(vocabulary), where_(where), parsed_(parsed) {}

  int whole() {
    const int result = sum();
    if (peek() != '\0') {
      refuse(at_, fmt::format("'{}' has no derivative; a motion is written with + - * / ^ and "
                              "smooth functions",
                              text_[at_]));
    }
    return result;
  }

 private:
  char peek() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void refuse(size_t offset, const std::string& reason) const {
    functions::SourcePlace place = where_;
    if (place.column > 0 && text_.find('\n') == std::string::npos)
      place.column += static_cast<int>(offset);
    throw base::InputError(fmt::format("{}in the motion '{}': {}", functions::prefix(place),
                                       text_.substr(0, 80), reason));
  }

  int sum() {
    int left = product();
    while (true) {
      if (take('+')) {
        left = tape_.add(Operator::add, left, product(), 0);
      } else if (take('-')) {
        left = tape_.add(Operator::subtract, left, product(), 0);
      } else {
        return left;
      }
    }
  }
  int product() {
    int left = signed_factor();
    while (true) {
      if (take('*')) {
        left = tape_.add(Operator::multiply, left, signed_factor(), 0);
      } else if (take('/')) {
        left = tape_.add(Operator::divide, left, signed_factor(), 0);
      } else {
        return left;
      }
    }
  }
  int signed_factor() {
    if (take('+')) return signed_factor();
    if (take('-')) return tape_.add(Operator::scale, signed_factor(), -1, -1);
    return power();
  }
  int power() {
    const int base = primary();
    if (!take('^')) return base;
    const int exponent = signed_factor();
    const Operation& e = tape_.operations()[exponent];
    if (e.op == Operator::constant) return tape_.add(Operator::power, base, -1, e.constant);
    const int log = tape_.add(Operator::log, base, -1, 0);  // base > 0, else not finite
    return tape_.add(Operator::exp, tape_.add(Operator::multiply, exponent, log, 0), -1, 0);
  }
  int primary() {
    if (take('(')) {
      const int inside = sum();
      if (!take(')')) {
        refuse(at_, peek() == '\0' ? "a parenthesis is not closed"
                                   : fmt::format("'{}' has no derivative here", text_[at_]));
      }
      return inside;
    }
    const char c = peek();
    if ((c >= '0' && c <= '9') || c == '.') return number();
    return name();
  }
  int number() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    at_ = static_cast<size_t>(end - text_.c_str());
    return tape_.add(Operator::constant, -1, -1, value);
  }
  int name() {
    const size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (word.empty()) {
      refuse(at_, peek() == '\0' ? "it ends too early"
                                 : fmt::format("'{}' has no derivative", text_[at_]));
    }
    if (peek() == '(') return call(word, begin);
    const size_t variable = std::string("xyzt").find(word);
    if (word.size() == 1 && variable != std::string::npos)
      return tape_.add(Operator::variable, static_cast<int>(variable), -1, 0);
    if (word == "pi") return tape_.add(Operator::constant, -1, -1, pi);
    const auto parameter = vocabulary_.parameters.find(word);
    if (parameter != vocabulary_.parameters.end())
      return tape_.add(Operator::constant, -1, -1, parameter->second);
    for (const auto& function : vocabulary_.time_functions) {
      const auto* const named = dynamic_cast<const functions::ExpressionFunction*>(function.get());
      if (named != nullptr && named->name() == word) return function_place(*named);
    }
    refuse(begin,
           fmt::format("'{}' has no derivatives; a motion may use x, y, z, t, pi, parameters "
                       "and functions of type \"expression\"",
                       word));
  }
  int function_place(const functions::ExpressionFunction& function) {
    const auto before = parsed_.find(&function);
    if (before != parsed_.end()) return before->second;
    const std::string text = function.expression().text();
    const int place = SmoothParser(tape_, text, vocabulary_, where_, parsed_).whole();
    parsed_[&function] = place;
    return place;
  }
  int call(const std::string& word, size_t begin) {
    const auto* const found =
        std::find_if(smooth_functions.begin(), smooth_functions.end(),
                     [&](const auto& function) { return function.first == word; });
    if (found == smooth_functions.end()) {
      std::vector<std::string> names;
      for (const auto& [known, op] : smooth_functions)
        names.emplace_back(known);
      refuse(begin, fmt::format("the function '{}' has no two derivatives everywhere; use {}", word,
                                base::joined(names)));
    }
    const int argument = primary();  // the parenthesis
    return tape_.add(found->second, argument, -1, 0);
  }

  Tape& tape_;
  const std::string& text_;
  const functions::Vocabulary& vocabulary_;
  const functions::SourcePlace& where_;
  Parsed& parsed_;
  size_t at_ = 0;
};

bool is_binary(Operator op) {
  return op == Operator::add || op == Operator::subtract || op == Operator::multiply ||
         op == Operator::divide;
}

double constant_result(Operator op, double a, double b, double constant) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::scale:
      return constant * a;
    case Operator::shift:
      return constant + a;
    default:
      return slopes(op, a, constant).value;
  }
}

}  // namespace

Slopes slopes(Operator op, double a, double constant) {
  switch (op) {
    case Operator::power: {
      const double p = constant;
      if (p == 2) return {a * a, 2 * a, 2};
      return {std::pow(a, p), p * std::pow(a, p - 1), p * (p - 1) * std::pow(a, p - 2)};
    }
    case Operator::sin:
      return {std::sin(a), std::cos(a), -std::sin(a)};
    case Operator::cos:
      return {std::cos(a), -std::sin(a), -std::cos(a)};
    case Operator::tan: {
      const double f = std::tan(a), g = 1 + f * f;
      return {f, g, 2 * f * g};
    }
    case Operator::asin: {
      const double g = 1 / std::sqrt((1 - a) * (1 + a));
      return {std::asin(a), g, a * g * g * g};
    }
    case Operator::acos: {
      const double g = 1 / std::sqrt((1 - a) * (1 + a));
      return {std::acos(a), -g, -a * g * g * g};
    }
    case Operator::atan: {
      const double g = 1 / (1 + a * a);
      return {std::atan(a), g, -2 * a * g * g};
    }
    case Operator::sinh:
      return {std::sinh(a), std::cosh(a), std::sinh(a)};
    case Operator::cosh:
      return {std::cosh(a), std::sinh(a), std::cosh(a)};
    case Operator::tanh: {
      const double f = std::tanh(a), g = (1 - f) * (1 + f);
      return {f, g, -2 * f * g};
    }
    case Operator::asinh: {
      const double g = 1 / std::sqrt(1 + a * a);
      return {std::asinh(a), g, -a * g * g * g};
    }
    case Operator::acosh: {
      const double g = 1 / std::sqrt((a - 1) * (a + 1));
      return {std::acosh(a), g, -a * g * g * g};
    }
    case Operator::atanh: {
      const double g = 1 / ((1 - a) * (1 + a));
      return {std::atanh(a), g, 2 * a * g * g};
    }
    case Operator::exp: {
      const double f = std::exp(a);
      return {f, f, f};
    }
    case Operator::log:
      return {std::log(a), 1 / a, -1 / (a * a)};
    case Operator::sqrt: {
      const double f = std::sqrt(a);
      return {f, 0.5 / f, -0.25 / (a * f)};
    }
    default:
      return {0, 0, 0};  // operators of two arguments never come here
  }
}

int Tape::add(Operator op, int first, int second, double constant) {
  if (op == Operator::scale) second = -1;
  Operation o{op,
              first,
              second,
              constant,
              op == Operator::variable && first < 3,
              op == Operator::variable && first == 3};
  if (op != Operator::constant && op != Operator::variable) {
    const Operation &a = operations_[first], &b = operations_[is_binary(op) ? second : first];
    const bool a_constant = a.op == Operator::constant, b_constant = b.op == Operator::constant;
    if (a_constant && b_constant) {
      return add(Operator::constant, -1, -1, constant_result(op, a.constant, b.constant, constant));
    }
    if (op == Operator::multiply && a_constant) return add(Operator::scale, second, -1, a.constant);
    if (op == Operator::multiply && b_constant) return add(Operator::scale, first, -1, b.constant);
    if (op == Operator::divide && b_constant)
      return add(Operator::scale, first, -1, 1 / b.constant);
    if (op == Operator::add && a_constant) return add(Operator::shift, second, -1, a.constant);
    if (op == Operator::add && b_constant) return add(Operator::shift, first, -1, b.constant);
    if (op == Operator::subtract && b_constant) return add(Operator::shift, first, -1, -b.constant);
    if (op == Operator::power && constant == 1) return first;
    if (op == Operator::power && constant == 0) return add(Operator::constant, -1, -1, 1);
    o.on_position = a.on_position || b.on_position;
    o.on_time = a.on_time || b.on_time;
  }
  const auto same = [&](const Operation& other) {
    return other.op == o.op && other.first == o.first && other.second == o.second &&
           other.constant == o.constant;
  };
  const auto found = std::find_if(operations_.begin(), operations_.end(), same);
  if (found != operations_.end()) return static_cast<int>(found - operations_.begin());
  operations_.push_back(o);
  return size() - 1;
}

int Tape::append(const std::string& text,
                 const functions::Vocabulary& vocabulary,
                 const functions::SourcePlace& where) {
  Parsed parsed;
  return SmoothParser(*this, text, vocabulary, where, parsed).whole();
}

std::vector<Jet<double, 1>> Tape::at_time(double t) const {
  std::vector<Jet<double, 1>> values(operations_.size(), Jet<double, 1>{});
  for (size_t k = 0; k < operations_.size(); ++k) {
    const Operation& o = operations_[k];
    if (o.on_position) continue;
    if (o.op == Operator::constant) {
      values[k].v = o.constant;
    } else if (o.op == Operator::variable) {
      values[k] = {t, {1}, {0}};
    } else {
      values[k] = jet_of(o, values);
    }
  }
  return values;
}

}  // namespace diptych::exact
