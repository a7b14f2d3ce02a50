/// Whether a text is an expression, by muParser (the only file that includes it). Names are scanned
/// here before muParser sees the text, so that a wrong one is reported at its own line and column,
/// with the nearest known name; the scan also tells on what an expression depends. Test:
/// tests/common/functions/expressions_test.cpp.

#include "common/functions/expressions.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/functions/expression_function.hpp"
#include "common/functions/placed_program.hpp"
#include "common/functions/program.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <muParser.h>

namespace diptych::functions {

namespace {

constexpr size_t max_length = 4096;  // bounds muParser's stack for nested parentheses
constexpr int max_depth = 1000;      // of functions that name one another
constexpr double pi = 3.14159265358979323846;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Place of text[offset] where text begins at `where`.
SourcePlace place_at(const SourcePlace& where, const std::string& text, size_t offset) {
  if (where.line == 0 || where.column == 0) return where;
  SourcePlace place = where;
  for (size_t i = 0; i < std::min(offset, text.size()); ++i) {
    if (text[i] == '\n') {
      ++place.line;
      place.column = 1;
    } else {
      ++place.column;
    }
  }
  return place;
}

[[noreturn]] void refuse(const SourcePlace& where,
                         const std::string& text,
                         size_t offset,
                         const std::string& reason) {
  const std::string shown = text.size() > 80 ? text.substr(0, 77) + "..." : text;
  throw base::InputError(fmt::format("{}in the expression '{}': {}",
                                     prefix(place_at(where, text, offset)), shown, reason));
}

struct Name {
  std::string text;
  size_t offset;
  bool is_call;  ///< followed by '('
};

/// End of the number that starts at text[i]: digits, a point, an exponent.
size_t end_of_number(const std::string& text, size_t i) {
  while (i < text.size() && (is_digit(text[i]) || text[i] == '.'))
    ++i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    size_t j = i + 1;
    if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
    if (j < text.size() && is_digit(text[j])) {
      while (j < text.size() && is_digit(text[j]))
        ++j;
      return j;
    }
  }
  return i;
}

/// The names in text, in order.
std::vector<Name> names_in(const std::string& text, const SourcePlace& where) {
  std::vector<Name> names;
  for (size_t i = 0; i < text.size();) {
    if (is_digit(text[i]) || text[i] == '.') {
      i = end_of_number(text, i);
      if (i < text.size() && is_letter(text[i]))
        refuse(where, text, i, "an operator is missing between a number and a name");
    } else if (is_letter(text[i])) {
      const size_t begin = i;
      while (i < text.size() && (is_letter(text[i]) || is_digit(text[i])))
        ++i;
      size_t next = i;
      while (next < text.size() && is_space(text[next]))
        ++next;
      names.push_back(
          {text.substr(begin, i - begin), begin, next < text.size() && text[next] == '('});
    } else {
      ++i;
    }
  }
  return names;
}

/// Refuses what muParser would take in a sense that nobody means (assignment, lists of results) or
/// report badly (characters that are no part of the language).
void check_characters(const std::string& text, const SourcePlace& where) {
  if (std::all_of(text.begin(), text.end(), is_space))
    refuse(where, text, 0, "it is empty; write 0 for zero");
  if (text.size() > max_length)
    refuse(where, text, 0,
           fmt::format("it has {} characters; the most is {}", text.size(), max_length));
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool known = is_letter(c) || is_digit(c) || is_space(c) ||
                       std::string_view(".+-*/^(),<>=!&|?:").find(c) != std::string_view::npos;
    if (!known) refuse(where, text, i, "unknown character");
    const char before = i > 0 ? text[i - 1] : ' ';
    const char after = i + 1 < text.size() ? text[i + 1] : ' ';
    if (c == '*' && after == '*') refuse(where, text, i, "unknown operator '**'; a power is x^2");
    const bool comparison =
        after == '=' || std::string_view("=<>!").find(before) != std::string_view::npos;
    if (c == '=' && !comparison) refuse(where, text, i, "no assignments; to compare, write ==");
  }
}

/// muParser's complaint in our words; its own words where the code says nothing better.
std::string reason_of(const mu::ParserError& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected parenthesis";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return fmt::format("an operator is missing before '{}'", error.GetToken());
    case mu::ecUNEXPECTED_OPERATOR:
      return fmt::format("unexpected operator '{}'", error.GetToken());
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG:
      return "unexpected comma; decimals are written with a point";
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("too many arguments of '{}'", error.GetToken());
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("too few arguments of '{}'", error.GetToken());
    default: {
      std::string words = error.GetMsg();
      if (!words.empty() && words.back() == '.') words.pop_back();
      return "syntax error (" + words + ")";
    }
  }
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    const mu::Parser parser;
    for (const auto& [name, function] : parser.GetFunDef())
      found.push_back(name);
    return found;
  }();
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> variable_names(const Vocabulary& vocabulary) {
  std::vector<std::string> names{"x", "y", "z", "t", "pi"};
  for (const auto& [name, value] : vocabulary.parameters)
    names.push_back(name);
  for (const auto& function : vocabulary.time_functions) {
    for (const auto& name : function->names())
      names.push_back(name);
  }
  return names;
}

std::string place_in_body(const Vec3& X, double t) {
  return fmt::format("X = ({}, {}, {}), t = {}", X[0], X[1], X[2], t);
}

}  // namespace

std::string prefix(const SourcePlace& where) {
  if (where.line == 0) return where.file.empty() ? "" : where.file + ": ";
  if (where.column == 0) return fmt::format("{}:{}: ", where.file, where.line);
  return fmt::format("{}:{}:{}: ", where.file, where.line, where.column);
}

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"x", "y", "z", "t", "pi"};
    all.insert(all.end(), function_names().begin(), function_names().end());
    return all;
  }();
  return names;
}

bool is_name(const std::string& text) {
  return !text.empty() && is_letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

namespace {

/// The parameters that the text uses; all where it uses an unknown one, for the nearest name.
Vocabulary vocabulary_of(const std::string& text,
                         const std::map<std::string, double>& parameters,
                         const SourcePlace& where) {
  Vocabulary used;
  for (const Name& name : names_in(text, where)) {
    const auto found = parameters.find(name.text);
    if (found != parameters.end()) {
      used.parameters.insert(*found);
    } else if (!name.is_call && name.text != "pi") {
      return {parameters, {}};
    }
  }
  return used;
}

}  // namespace

double constant_value(const std::string& text,
                      const std::map<std::string, double>& parameters,
                      const SourcePlace& where) {
  for (const Name& name : names_in(text, where)) {
    const bool varies =
        name.text == "x" || name.text == "y" || name.text == "z" || name.text == "t";
    if (varies && !name.is_call) {
      refuse(where, text, name.offset,
             fmt::format("'{}' has no value here; a number may use parameters and pi only",
                         name.text));
    }
  }
  return Expression(text, vocabulary_of(text, parameters, where), where)(Vec3::Zero(), 0);
}

namespace {

/// Evaluates at one place after the other.
struct PointEvaluation {
  PlacedProgram placed;
  PlacedProgram::Workspace workspace;
  PlacedProgram::Instant instant;
  Vec3 X;
  double t = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

struct Expression::Compiled {
  std::string text;
  SourcePlace where;
  bool on_time = false;
  bool on_position = false;
  double value = 0;       // of the constant
  int depth = 0;          // of functions that stand on one another below this text
  Vocabulary vocabulary;  // what the text uses
  std::unique_ptr<PointEvaluation> points;

  void bind(const std::vector<Name>& names, const Vocabulary& known, mu::Parser& parser);
  bool bind_time_function(const std::string& name, const Vocabulary& known);
  int depth_of(const ExpressionFunction& function) const {
    const auto& below = function.expression().compiled_;
    return below ? below->depth : 0;
  }
  void check(mu::Parser& parser);
  double evaluate(const Vec3& place, double time);
  [[noreturn]] void refuse_value(double result, const Vec3& X, double t) const;
};

bool Expression::Compiled::bind_time_function(const std::string& name, const Vocabulary& known) {
  for (const auto& function : known.time_functions) {
    const auto* const named = dynamic_cast<const ExpressionFunction*>(function.get());
    if (named != nullptr && named->name() != name) continue;  // of most cases all of them
    const std::vector<std::string> names = function->names();
    if (!contains(names, name)) continue;
    if (named != nullptr) depth = std::max(depth, 1 + depth_of(*named));
    on_position = on_position || function->depends_on_position();
    auto& used = vocabulary.time_functions;
    if (std::find(used.begin(), used.end(), function) == used.end()) used.push_back(function);
    return true;
  }
  return false;
}

/// Gives the parser the names that the text uses and no others.
void Expression::Compiled::bind(const std::vector<Name>& names,
                                const Vocabulary& known,
                                mu::Parser& parser) {
  static double unknown = 0;  // the parser evaluates constants only
  parser.ClearConst();        // its own _pi and _e
  parser.DefineConst("pi", pi);
  for (const char* variable : {"x", "y", "z", "t"})
    parser.DefineVar(variable, &unknown);
  for (const Name& name : names) {
    if (name.is_call) {
      if (!contains(function_names(), name.text)) {
        refuse(
            where, text, name.offset,
            "unknown function '" + name.text + "'" + base::suggestion(name.text, function_names()));
      }
    } else if (name.text == "x" || name.text == "y" || name.text == "z") {
      on_position = true;
    } else if (name.text == "t") {
      on_time = true;
    } else if (const auto parameter = known.parameters.find(name.text);
               parameter != known.parameters.end()) {
      parser.DefineConst(name.text, parameter->second);
      vocabulary.parameters.insert(*parameter);
    } else if (bind_time_function(name.text, known)) {
      parser.DefineVar(name.text, &unknown);
      on_time = true;
    } else if (contains(function_names(), name.text)) {
      refuse(where, text, name.offset,
             fmt::format("the function '{}' needs its argument in parentheses", name.text));
    } else if (name.text != "pi") {
      refuse(
          where, text, name.offset,
          "unknown name '" + name.text + "'" + base::suggestion(name.text, variable_names(known)));
    }
  }
}

/// Whether it is an expression; a constant gets its value.
void Expression::Compiled::check(mu::Parser& parser) {
  int n_results = 0;
  try {
    parser.SetExpr(text);
    value = parser.Eval(n_results)[0];
  } catch (const mu::ParserError& error) {
    const int position = error.GetPos();
    refuse(where, text, position < 0 ? 0 : static_cast<size_t>(position), reason_of(error));
  }
  if (n_results != 1)
    refuse(where, text, text.find(','), "unexpected comma; decimals are written with a point");
  if (!on_time && !on_position && !std::isfinite(value))
    refuse(where, text, 0, fmt::format("its value is {}, not a finite number", value));
}

void Expression::Compiled::refuse_value(double result, const Vec3& X, double t) const {
  refuse(where, text, 0,
         fmt::format("its value is {} at {}; it must be finite at every node and time", result,
                     place_in_body(X, t)));
}

double Expression::Compiled::evaluate(const Vec3& place, double time) {
  if (!on_time && !on_position) return value;
  if (!points) {
    const auto program = std::make_shared<Program>();
    const int result = program->append(text, vocabulary, where, Program::Accepts::all);
    const std::vector<int> results{result};
    points = std::make_unique<PointEvaluation>(
        PointEvaluation{PlacedProgram(program, results, {&place, 1}), {}, {}, place});
    points->workspace = points->placed.workspace();
  }
  PointEvaluation& at = *points;
  if (at.X != place) {
    at.placed.move_to({&place, 1});
    at.X = place;
  }
  if (at.t != time) {
    at.instant = at.placed.at(time);
    at.t = time;
  }
  at.placed.evaluate(0, time, at.instant, at.workspace);
  const double result = at.placed.result(0, 0, at.instant, at.workspace)[0][0];
  if (!std::isfinite(result)) refuse_value(result, place, time);
  return result;
}

Expression::Expression(double constant) : compiled_(std::make_shared<Compiled>()) {
  if (!std::isfinite(constant))
    throw base::InputError(fmt::format("the constant {} is not a finite number", constant));
  compiled_->text = fmt::format("{}", constant);
  compiled_->value = constant;
}

Expression::Expression(const std::string& text,
                       const Vocabulary& vocabulary,
                       const SourcePlace& where)
    : compiled_(std::make_shared<Compiled>()) {
  compiled_->text = text;
  compiled_->where = where;
  check_characters(text, where);
  mu::Parser parser;
  compiled_->bind(names_in(text, where), vocabulary, parser);
  if (compiled_->depth > max_depth) {
    refuse(where, text, 0,
           fmt::format("it stands on more than {} functions, one below the other; write some of "
                       "them out",
                       max_depth));
  }
  compiled_->check(parser);
}

double Expression::operator()(const Vec3& X, double t) const {
  return compiled_ ? compiled_->evaluate(X, t) : 0.0;
}

bool Expression::depends_on_time() const {
  return compiled_ && compiled_->on_time;
}

bool Expression::depends_on_position() const {
  return compiled_ && compiled_->on_position;
}

bool Expression::is_zero() const {
  return !compiled_ || (!compiled_->on_time && !compiled_->on_position && compiled_->value == 0);
}

std::string Expression::text() const {
  return compiled_ ? compiled_->text : "0";
}

const Vocabulary& Expression::vocabulary() const {
  static const Vocabulary none;
  return compiled_ ? compiled_->vocabulary : none;
}

const SourcePlace& Expression::where() const {
  static const SourcePlace nowhere;
  return compiled_ ? compiled_->where : nowhere;
}

void Expression::refuse_value(double value, const Vec3& X, double t) const {
  if (compiled_) compiled_->refuse_value(value, X, t);
  refuse({}, "0", 0, fmt::format("its value is {} at {}", value, place_in_body(X, t)));
}

void TimeFunction::values_at_all(std::span<const Vec3> X, double t, double* values) const {
  for (const Vec3& place : X) {
    const std::vector<double> here = values_at(place, t);
    values = std::copy(here.begin(), here.end(), values);
  }
}

}  // namespace diptych::functions
