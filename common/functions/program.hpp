#pragma once
/// Expressions of x, y, z, t as one flat list of operations on numbers. Equal parts are there once,
/// in whatever expression or function of a case they stand; derivatives are further operations of
/// the same list. Factors that depend on time alone and on place alone are collected, so that an
/// evaluation works them out once (PlacedProgram). Test: tests/common/functions/program_test.cpp

#include "common/functions/expressions.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace diptych::functions {

enum class Operator : std::uint8_t {
  constant,
  variable,  ///< x, y, z, t: first = 0 .. 3
  given,     ///< value of a function of a case: first into givens(), second of its names
  // ---- smooth: these have derivatives
  add,
  subtract,
  multiply,
  divide,
  scale,  ///< constant times first
  shift,  ///< constant plus first
  power,  ///< first to the constant
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  exp,
  log,
  sqrt,
  // ---- without
  raise,  ///< first to the second
  log2,
  log10,
  atan2,
  abs,
  sign,
  rint,  ///< to the next whole number, halves upwards
  least,
  greatest,
  less,  ///< comparisons and conjunctions are 1 or 0
  less_equal,
  equal,
  differs,
  both,
  either,
  choose  ///< first is not 0: second, else third
};

struct Operation {
  Operator op = Operator::constant;
  int first = -1, second = -1, third = -1;  ///< places of the arguments, before this one
  double constant = 0;
  bool on_position = false, on_time = false;

  bool is_constant() const { return op == Operator::constant; }
  bool is_of_time() const { return on_time && !on_position; }
  bool is_of_place() const { return on_position && !on_time; }
  bool is_mixed() const { return on_position && on_time; }
  /// Number of arguments that are operations.
  int n_arguments() const;
};

/// Result of an operation on numbers; @pre neither a variable nor given
double result_of(const Operation& operation, double a, double b, double c);

class Program {
 public:
  enum class Accepts {
    all,    ///< a text that Expression has accepted
    smooth  ///< what has derivatives; refuses the rest
  };

  /// Appends the operations of a text, those of the functions that it names first.
  /// @param vocabulary  names that it may use
  /// @param where       place of the first character of text
  /// @return place of the result
  /// @throws base::InputError on what is not accepted
  int append(const std::string& text,
             const Vocabulary& vocabulary,
             const SourcePlace& where,
             Accepts accepts);

  /// Of an expression; a constant has the value that it has there.
  int append(const Expression& expression);
  /// As it is at one place: of time alone.
  int append(const Expression& expression, const Vec3& place);

  /// Appends an operation, or finds it, or an equal one of fewer or simpler parts.
  int add(Operator op, int first = -1, int second = -1, double constant = 0, int third = -1);
  int add_constant(double value) { return add(Operator::constant, -1, -1, value); }

  /// Appends derivatives by variable 0 to 3. @pre smooth, or smooth_in_place() and not by time
  int derivative(int of, int variable);
  /// Whether what depends on the place has derivatives there.
  bool smooth_in_place(int result) const;

  /// Whether it is more than a sum of products of what depends on place alone and on time alone.
  bool joins_place_and_time(int result) const;

  /// @param function  of the vocabulary, not an expression
  int add_given(const std::shared_ptr<const TimeFunction>& function, int name);

  const std::vector<Operation>& operations() const { return operations_; }
  const Operation& operator[](int k) const { return operations_[static_cast<size_t>(k)]; }
  int size() const { return static_cast<int>(operations_.size()); }
  const std::vector<std::shared_ptr<const TimeFunction>>& givens() const { return givens_; }

 private:
  friend class ProgramParser;

  int simplified(Operator op, int first, int second, double constant);
  int product(int first, int second);
  std::vector<char> made_of(int result) const;
  int append_at(const Vec3& place, const Program& other, int result);
  int derivative_of(const Operation& operation, int place, int d_first, int d_second);
  int kept(const Operation& operation);
  int parsed(const Expression& expression, Accepts accepts);
  void append_functions(const Vocabulary& vocabulary, const std::string& text, Accepts accepts);

  struct Hash {
    size_t operator()(const Operation& o) const;
  };
  struct Same {
    bool operator()(const Operation& a, const Operation& b) const;
  };
  std::vector<Operation> operations_;
  std::unordered_map<Operation, int, Hash, Same> places_;
  std::vector<std::shared_ptr<const TimeFunction>> givens_;
  /// Results of the expressions that were met before: each is parsed once, however many name it.
  std::unordered_map<const TimeFunction*, int> parsed_;
  std::unordered_map<std::int64_t, int> derivatives_;  ///< of 4 place + variable
};

}  // namespace diptych::functions
