/// Parser of the expression language into a Program, with the precedence of muParser: a sign binds
/// less than a power (-2^2 = -4), powers from the right (2^3^2 = 2^9), comparisons less than sums,
/// then &&,
/// ||, and ?: from the right. Whether a text is one of the language is for muParser to say
/// (Expression); the smooth part is refused here.

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/functions/expression_function.hpp"
#include "common/functions/program.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <set>
#include <string_view>

namespace diptych::functions {

namespace {

constexpr double pi = 3.14159265358979323846;

struct NamedOperator {
  std::string_view name;
  Operator op;
};

constexpr std::array smooth_functions{
    NamedOperator{"sin", Operator::sin},     NamedOperator{"cos", Operator::cos},
    NamedOperator{"tan", Operator::tan},     NamedOperator{"asin", Operator::asin},
    NamedOperator{"acos", Operator::acos},   NamedOperator{"atan", Operator::atan},
    NamedOperator{"sinh", Operator::sinh},   NamedOperator{"cosh", Operator::cosh},
    NamedOperator{"tanh", Operator::tanh},   NamedOperator{"asinh", Operator::asinh},
    NamedOperator{"acosh", Operator::acosh}, NamedOperator{"atanh", Operator::atanh},
    NamedOperator{"exp", Operator::exp},     NamedOperator{"log", Operator::log},
    NamedOperator{"ln", Operator::log},      NamedOperator{"sqrt", Operator::sqrt},
};
constexpr std::array other_functions{
    NamedOperator{"log2", Operator::log2}, NamedOperator{"log10", Operator::log10},
    NamedOperator{"abs", Operator::abs},   NamedOperator{"sign", Operator::sign},
    NamedOperator{"rint", Operator::rint},
};
/// Of any number of arguments, taken two by two; avg is their sum over their number.
constexpr std::array folding_functions{
    NamedOperator{"min", Operator::least},   NamedOperator{"max", Operator::greatest},
    NamedOperator{"sum", Operator::add},     NamedOperator{"avg", Operator::add},
    NamedOperator{"atan2", Operator::atan2},
};

template <size_t n>
const NamedOperator* found_in(const std::array<NamedOperator, n>& table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const NamedOperator& entry) { return entry.name == name; });
  return found == table.end() ? nullptr : &*found;
}

/// Infix operators, binding more from row to row of rank.
struct Infix {
  std::string_view sign;
  int rank;
  Operator op;
  bool swaps;  ///< a > b is b < a
};
constexpr int rank_of_choice = 0, rank_of_sum = 4, rank_of_sign = 6, rank_of_power = 6;
constexpr std::array infixes{
    Infix{"||", 1, Operator::either, false},     Infix{"&&", 2, Operator::both, false},
    Infix{"<=", 3, Operator::less_equal, false}, Infix{">=", 3, Operator::less_equal, true},
    Infix{"==", 3, Operator::equal, false},      Infix{"!=", 3, Operator::differs, false},
    Infix{"<", 3, Operator::less, false},        Infix{">", 3, Operator::less, true},
    Infix{"+", 4, Operator::add, false},         Infix{"-", 4, Operator::subtract, false},
    Infix{"*", 5, Operator::multiply, false},    Infix{"/", 5, Operator::divide, false},
    Infix{"^", 6, Operator::raise, false},
};

bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// All words of a text.
std::set<std::string, std::less<>> words_in(const std::string& text) {
  std::set<std::string, std::less<>> words;
  for (size_t i = 0; i < text.size();) {
    const size_t begin = i;
    while (i < text.size() && is_of_name(text[i]))
      ++i;
    if (i > begin) words.insert(text.substr(begin, i - begin));
    if (i == begin) ++i;
  }
  return words;
}

}  // namespace

/// Precedence climbing; every method leaves `at_` behind what it has read.
class ProgramParser {
 public:
  ProgramParser(Program& program,
                const std::string& text,
                const Vocabulary& vocabulary,
                const SourcePlace& where,
                Program::Accepts accepts)
      : program_(program),
        text_(text),
        vocabulary_(vocabulary),
        where_(where),
        smooth_(accepts == Program::Accepts::smooth) {}

  int whole() {
    const int result = expression(smooth_ ? rank_of_sum : rank_of_choice);
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
  bool take(std::string_view sign) {
    if (peek() == '\0' || text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    return true;
  }
  [[noreturn]] void refuse(size_t offset, const std::string& reason) const {
    SourcePlace place = where_;
    if (place.column > 0 && text_.find('\n') == std::string::npos)
      place.column += static_cast<int>(offset);
    throw base::InputError(fmt::format("{}in the {} '{}': {}", prefix(place),
                                       smooth_ ? "motion" : "expression", text_.substr(0, 80),
                                       reason));
  }

  const Infix* take_infix(int least_rank) {
    for (const Infix& infix : infixes) {
      if (infix.rank >= least_rank && (!smooth_ || infix.rank >= rank_of_sum) && take(infix.sign))
        return &infix;
    }
    return nullptr;
  }
  /// What binds at least as much as this rank.
  int expression(int least_rank) {
    int left = operand();
    while (const Infix* infix = take_infix(least_rank)) {
      const bool from_the_right = infix->rank == rank_of_power;
      const int right = expression(from_the_right ? rank_of_power : infix->rank + 1);
      left = infix->op == Operator::raise ? raised(left, right)
             : infix->swaps               ? program_.add(infix->op, right, left)
                                          : program_.add(infix->op, left, right);
    }
    if (least_rank > rank_of_choice || smooth_ || !take("?")) return left;
    const int chosen = expression(rank_of_choice);
    expect(':');
    return program_.add(Operator::choose, left, chosen, 0, expression(rank_of_choice));
  }
  int raised(int base, int exponent) {
    const Operation& e = program_[exponent];
    if (e.is_constant()) return program_.add(Operator::power, base, -1, e.constant);
    if (!smooth_) return program_.add(Operator::raise, base, exponent);
    const int log = program_.add(Operator::log, base);  // base > 0, else not finite
    return program_.add(Operator::exp, program_.add(Operator::multiply, exponent, log));
  }
  int operand() {
    if (take("+")) return expression(rank_of_sign);
    if (take("-")) return program_.add(Operator::scale, expression(rank_of_sign), -1, -1);
    if (take("(")) return inside();
    const char c = peek();
    if ((c >= '0' && c <= '9') || c == '.') return number();
    return name();
  }
  /// Behind '('.
  int inside() {
    const int result = expression(smooth_ ? rank_of_sum : rank_of_choice);
    expect(')');
    return result;
  }
  void expect(char c) {
    if (take(std::string_view(&c, 1))) return;
    refuse(at_, peek() == '\0' ? "a parenthesis is not closed"
                               : fmt::format("'{}' has no derivative here", text_[at_]));
  }
  int number() {
    double value = 0;
    const char* const begin = text_.c_str() + at_;
    const auto [end, error] = std::from_chars(begin, text_.c_str() + text_.size(), value);
    if (error != std::errc()) refuse(at_, "a number that is no double");
    at_ += static_cast<size_t>(end - begin);
    return program_.add_constant(value);
  }
  int name() {
    const size_t begin = at_;
    while (at_ < text_.size() && is_of_name(text_[at_]))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (word.empty()) {
      refuse(at_, peek() == '\0' ? "it ends too early"
                                 : fmt::format("'{}' has no derivative", text_[at_]));
    }
    if (peek() == '(') return call(word, begin);
    const size_t variable = std::string("xyzt").find(word);
    if (word.size() == 1 && variable != std::string::npos)
      return program_.add(Operator::variable, static_cast<int>(variable));
    if (word == "pi") return program_.add_constant(pi);
    const auto parameter = vocabulary_.parameters.find(word);
    if (parameter != vocabulary_.parameters.end()) return program_.add_constant(parameter->second);
    for (const auto& function : vocabulary_.time_functions) {
      const auto* const named = dynamic_cast<const ExpressionFunction*>(function.get());
      if (named != nullptr) {
        if (named->name() == word) return program_.parsed_.at(named);
        continue;
      }
      if (smooth_) continue;
      const std::vector<std::string> names = function->names();
      const auto found = std::find(names.begin(), names.end(), word);
      if (found != names.end())
        return program_.add_given(function, static_cast<int>(found - names.begin()));
    }
    refuse(begin,
           fmt::format("'{}' has no derivatives; a motion may use x, y, z, t, pi, parameters "
                       "and functions of type \"expression\"",
                       word));
  }
  int call(const std::string& word, size_t begin) {
    const NamedOperator* of_one = found_in(smooth_functions, word);
    if (of_one == nullptr && !smooth_) of_one = found_in(other_functions, word);
    if (of_one != nullptr) {
      take("(");
      return program_.add(of_one->op, inside());
    }
    const NamedOperator* folding = smooth_ ? nullptr : found_in(folding_functions, word);
    if (folding == nullptr) {
      std::vector<std::string> names;
      for (const NamedOperator& known : smooth_functions)
        names.emplace_back(known.name);
      refuse(begin, fmt::format("the function '{}' has no two derivatives everywhere; use {}", word,
                                base::joined(names)));
    }
    take("(");
    int result = expression(rank_of_choice), n = 1;
    for (; take(","); ++n)
      result = program_.add(folding->op, result, expression(rank_of_choice));
    expect(')');
    return word == "avg" ? program_.add(Operator::scale, result, -1, 1.0 / n) : result;
  }

  Program& program_;
  const std::string& text_;
  const Vocabulary& vocabulary_;
  const SourcePlace& where_;
  bool smooth_;
  size_t at_ = 0;
};

/// Functions first that others stand on, by a stack of our own: they may be a thousand deep.
void Program::append_functions(const Vocabulary& vocabulary,
                               const std::string& text,
                               Accepts accepts) {
  std::vector<const ExpressionFunction*> stack;
  const auto push_missing = [&](const std::string& of_text, const Vocabulary& names) {
    const auto words = words_in(of_text);
    const size_t before = stack.size();
    for (const auto& function : names.time_functions) {
      const auto* const named = dynamic_cast<const ExpressionFunction*>(function.get());
      if (named != nullptr && parsed_.count(named) == 0 && words.count(named->name()) != 0)
        stack.push_back(named);
    }
    return stack.size() > before;
  };
  push_missing(text, vocabulary);
  while (!stack.empty()) {
    const ExpressionFunction* const function = stack.back();
    const Expression& expression = function->expression();
    if (push_missing(expression.text(), expression.vocabulary())) continue;
    stack.pop_back();
    if (parsed_.count(function) != 0) continue;
    parsed_[function] = parsed(expression, accepts);
  }
}

/// @pre the functions that it names are there
int Program::parsed(const Expression& expression, Accepts accepts) {
  if (!expression.depends_on_time() && !expression.depends_on_position())
    return add_constant(expression(Vec3::Zero(), 0));
  const std::string text = expression.text();
  return ProgramParser(*this, text, expression.vocabulary(), expression.where(), accepts).whole();
}

int Program::append(const Expression& expression) {
  append_functions(expression.vocabulary(), expression.text(), Accepts::all);
  return parsed(expression, Accepts::all);
}

int Program::append(const std::string& text,
                    const Vocabulary& vocabulary,
                    const SourcePlace& where,
                    Accepts accepts) {
  append_functions(vocabulary, text, accepts);
  return ProgramParser(*this, text, vocabulary, where, accepts).whole();
}

}  // namespace diptych::functions
