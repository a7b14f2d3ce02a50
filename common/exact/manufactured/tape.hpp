#pragma once
/// Smooth expressions of x, y, z, t as one list of operations, evaluated with all their first and
/// second derivatives. Common parts are kept once. Unlike Expression (muParser), for concurrent
/// use. Test: tests/common/exact/motion_test.cpp.

#include "common/algebra/jet.hpp"
#include "common/functions/expressions.hpp"

#include <type_traits>
#include <vector>

namespace diptych::exact {

using algebra::Jet;
using algebra::Lanes;

enum class Operator {
  constant,
  variable,  ///< x, y, z, t: first = 0 .. 3
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
  sqrt
};

struct Operation {
  Operator op = Operator::constant;
  int first = -1, second = -1;  ///< places of the arguments, before this one
  double constant = 0;
  bool on_position = false, on_time = false;
};

/// Value and first two derivatives of a function of one variable.
struct Slopes {
  double value, first, second;
};
Slopes slopes(Operator op, double a, double constant);

/// Result of an operation on jets; @pre neither a constant nor a variable.
template <class T, int n>
DIPTYCH_INLINE Jet<T, n> jet_of(const Operation& o, const std::vector<Jet<T, n>>& values) {
  const Jet<T, n>& a = values[o.first];
  switch (o.op) {
    case Operator::add:
      return algebra::combined(1, a, 1, values[o.second]);
    case Operator::subtract:
      return algebra::combined(1, a, -1, values[o.second]);
    case Operator::multiply:
      return a * values[o.second];
    case Operator::divide: {
      const T inverse = 1.0 / values[o.second].v, square = inverse * inverse;
      return a * algebra::chained(values[o.second], inverse, T(-square), T(2.0 * square * inverse));
    }
    case Operator::scale:
      return algebra::combined(o.constant, a, 0, a);
    case Operator::shift: {
      Jet<T, n> r = a;
      r.v = r.v + o.constant;
      return r;
    }
    default:
      break;
  }
  if constexpr (std::is_same_v<T, double>) {
    const Slopes f = slopes(o.op, a.v, o.constant);
    return algebra::chained(a, f.value, f.first, f.second);
  } else {
    T f, slope, bend;
    for (int lane = 0; lane < algebra::n_lanes; ++lane) {
      const Slopes s = slopes(o.op, a.v[lane], o.constant);
      f[lane] = s.value;
      slope[lane] = s.first;
      bend[lane] = s.second;
    }
    return algebra::chained(a, f, slope, bend);
  }
}

class Tape {
 public:
  /// Parses a text that muParser accepts and appends its operations.
  /// @param where place of the first character of text
  /// @return place of the result
  /// @throws base::InputError on names and operators without two derivatives
  int append(const std::string& text,
             const functions::Vocabulary& vocabulary,
             const functions::SourcePlace& where);

  /// Appends an operation, or finds it, or its constant result.
  int add(Operator op, int first, int second, double constant);

  const std::vector<Operation>& operations() const { return operations_; }
  int size() const { return static_cast<int>(operations_.size()); }

  /// Value, rate and second rate of all operations that do not depend on position.
  std::vector<Jet<double, 1>> at_time(double t) const;

 private:
  std::vector<Operation> operations_;
};

/// Evaluation of a tape at one place (T = double) or eight (Lanes), at several times in turn.
/// Derivatives are by the first n_space coordinates and, where with_time is set, by t after them.
template <class T, int n_space, bool with_time>
class TapeEvaluation {
 public:
  static constexpr int n = n_space + (with_time ? 1 : 0);
  using Value = Jet<T, n>;

  explicit TapeEvaluation(const Tape& tape) : tape_(tape), values_(tape.size()) {}

  /// Moves to reference position X.
  DIPTYCH_INLINE void place(const T X[3]) {
    for (int i = 0; i < 3; ++i)
      X_[i] = X[i];
    const auto& operations = tape_.operations();
    for (int k = 0; k < tape_.size(); ++k) {
      if (!operations[k].on_time) values_[k] = result(operations[k]);
    }
  }
  /// Moves to the time of Tape::at_time.
  DIPTYCH_INLINE void time(const std::vector<Jet<double, 1>>& at_time) {
    const auto& operations = tape_.operations();
    for (int k = 0; k < tape_.size(); ++k) {
      const Operation& o = operations[k];
      if (!o.on_time) continue;
      if (o.on_position) {
        values_[k] = result(o);
        continue;
      }
      values_[k] = algebra::constant_jet<T, n>(T{} + at_time[k].v);
      if constexpr (with_time) {
        values_[k].d[n_space] = T{} + at_time[k].d[0];
        values_[k].dd[Value::index(n_space, n_space)] = T{} + at_time[k].dd[0];
      }
    }
  }
  const Value& operator[](int k) const { return values_[k]; }

 private:
  DIPTYCH_INLINE Value result(const Operation& o) const {
    if (o.op == Operator::constant) return algebra::constant_jet<T, n>(T{} + o.constant);
    if (o.op != Operator::variable) return jet_of(o, values_);
    Value r = algebra::constant_jet<T, n>(X_[o.first]);
    if (o.first < n_space) r.d[o.first] = T{} + 1.0;
    return r;
  }

  const Tape& tape_;
  std::vector<Value> values_;
  alignas(sizeof(T)) T X_[3]{};
};

}  // namespace diptych::exact
