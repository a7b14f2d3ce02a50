#include "common/functions/program.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace diptych::functions {

int Operation::n_arguments() const {
  switch (op) {
    case Operator::constant:
    case Operator::variable:
    case Operator::given:
      return 0;
    case Operator::add:
    case Operator::subtract:
    case Operator::multiply:
    case Operator::divide:
    case Operator::raise:
    case Operator::atan2:
    case Operator::least:
    case Operator::greatest:
    case Operator::less:
    case Operator::less_equal:
    case Operator::equal:
    case Operator::differs:
    case Operator::both:
    case Operator::either:
      return 2;
    case Operator::choose:
      return 3;
    default:
      return 1;
  }
}

double result_of(const Operation& operation, double a, double b, double c) {
  switch (operation.op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::scale:
      return operation.constant * a;
    case Operator::shift:
      return operation.constant + a;
    case Operator::power:
      return operation.constant == 2 ? a * a : std::pow(a, operation.constant);
    case Operator::sin:
      return std::sin(a);
    case Operator::cos:
      return std::cos(a);
    case Operator::tan:
      return std::tan(a);
    case Operator::asin:
      return std::asin(a);
    case Operator::acos:
      return std::acos(a);
    case Operator::atan:
      return std::atan(a);
    case Operator::sinh:
      return std::sinh(a);
    case Operator::cosh:
      return std::cosh(a);
    case Operator::tanh:
      return std::tanh(a);
    case Operator::asinh:
      return std::asinh(a);
    case Operator::acosh:
      return std::acosh(a);
    case Operator::atanh:
      return std::atanh(a);
    case Operator::exp:
      return std::exp(a);
    case Operator::log:
      return std::log(a);
    case Operator::sqrt:
      return std::sqrt(a);
    case Operator::raise:
      return std::pow(a, b);
    case Operator::log2:
      return std::log2(a);
    case Operator::log10:
      return std::log10(a);
    case Operator::atan2:
      return std::atan2(a, b);
    case Operator::abs:
      return std::fabs(a);
    case Operator::sign:
      return a < 0 ? -1 : a > 0 ? 1 : 0;
    case Operator::rint:
      return std::floor(a + 0.5);
    case Operator::least:
      return b < a ? b : a;
    case Operator::greatest:
      return b > a ? b : a;
    case Operator::less:
      return a < b;
    case Operator::less_equal:
      return a <= b;
    case Operator::equal:
      return a == b;
    case Operator::differs:
      return a != b;
    case Operator::both:
      return a != 0 && b != 0;
    case Operator::either:
      return a != 0 || b != 0;
    case Operator::choose:
      return a != 0 ? b : c;
    default:
      return operation.constant;
  }
}

size_t Program::Hash::operator()(const Operation& o) const {
  std::uint64_t h = std::bit_cast<std::uint64_t>(o.constant);
  for (const int k : {static_cast<int>(o.op), o.first, o.second, o.third})
    h = (h ^ static_cast<std::uint64_t>(k + 1)) * 0x9e3779b97f4a7c15U;
  return h ^ (h >> 29);
}

bool Program::Same::operator()(const Operation& a, const Operation& b) const {
  return a.op == b.op && a.first == b.first && a.second == b.second && a.third == b.third &&
         std::bit_cast<std::uint64_t>(a.constant) == std::bit_cast<std::uint64_t>(b.constant);
}

int Program::kept(const Operation& operation) {
  const auto [found, is_new] = places_.try_emplace(operation, size());
  if (is_new) operations_.push_back(operation);
  return found->second;
}

int Program::add_given(const std::shared_ptr<const TimeFunction>& function, int name) {
  const auto found = std::find(givens_.begin(), givens_.end(), function);
  const auto k = static_cast<int>(found - givens_.begin());
  if (found == givens_.end()) givens_.push_back(function);
  return kept({Operator::given, k, name, -1, 0, function->depends_on_position(), true});
}

int Program::add(Operator op, int first, int second, double constant, int third) {
  if (op == Operator::constant) return kept({op, -1, -1, -1, constant, false, false});
  if (op == Operator::variable) return kept({op, first, -1, -1, 0, first < 3, first == 3});
  Operation o{op, first, second, third, constant, false, false};
  bool all_constant = true;
  double values[3] = {0, 0, 0};
  const int arguments[3] = {first, second, third};
  for (int i = 0; i < o.n_arguments(); ++i) {
    const Operation& argument = (*this)[arguments[i]];
    o.on_position = o.on_position || argument.on_position;
    o.on_time = o.on_time || argument.on_time;
    all_constant = all_constant && argument.is_constant();
    values[i] = argument.constant;
  }
  if (all_constant) return add_constant(result_of(o, values[0], values[1], values[2]));
  const int simple = simplified(op, first, second, constant);
  if (simple >= 0) return simple;
  const bool commutes = op == Operator::add || op == Operator::multiply;
  if (commutes && o.first > o.second) std::swap(o.first, o.second);
  return kept(o);
}

/// An equal operation of simpler parts, or -1. Constant factors come to the outside, where products
/// of the same parts find one another.
int Program::simplified(Operator op, int first, int second, double constant) {
  const Operation a = (*this)[first], b = (*this)[second >= 0 ? second : first];
  switch (op) {
    case Operator::add:
      if (a.is_constant()) return add(Operator::shift, second, -1, a.constant);
      if (b.is_constant()) return add(Operator::shift, first, -1, b.constant);
      if (b.op == Operator::scale && b.constant == -1)
        return add(Operator::subtract, first, b.first);
      break;
    case Operator::subtract:
      if (b.is_constant()) return add(Operator::shift, first, -1, -b.constant);
      if (b.op == Operator::scale && b.constant == -1) return add(Operator::add, first, b.first);
      break;
    case Operator::multiply:
      return product(first, second);
    case Operator::divide:
      if (b.is_constant()) return add(Operator::scale, first, -1, 1 / b.constant);
      if (a.is_mixed() && !b.is_mixed())  // the quotient of what is evaluated less often
        return add(Operator::multiply, first, add(Operator::divide, add_constant(1), second));
      break;
    case Operator::scale:
      if (constant == 1) return first;
      if (a.op == Operator::scale) return add(Operator::scale, a.first, -1, constant * a.constant);
      break;
    case Operator::shift:
      if (constant == 0) return first;
      break;
    case Operator::power:
      if (constant == 1) return first;
      if (constant == 0) return add_constant(1);
      break;
    default:
      break;
  }
  return -1;
}

/// (time)(place) for a product of factors of time and of place alone, else -1.
int Program::product(int first, int second) {
  const Operation a = (*this)[first], b = (*this)[second];
  if (a.is_constant()) return add(Operator::scale, second, -1, a.constant);
  if (b.is_constant()) return add(Operator::scale, first, -1, b.constant);
  if (a.op == Operator::scale || b.op == Operator::scale) {
    const int rest_a = a.op == Operator::scale ? a.first : first;
    const int rest_b = b.op == Operator::scale ? b.first : second;
    const double factor =
        (a.op == Operator::scale ? a.constant : 1) * (b.op == Operator::scale ? b.constant : 1);
    return add(Operator::scale, add(Operator::multiply, rest_a, rest_b), -1, factor);
  }
  // factors {of time, of place} of what is such a product; -1: none
  using Factors = std::pair<int, int>;
  const auto factors_of = [&](int k) -> Factors {
    const Operation& o = (*this)[k];
    if (o.is_of_time()) return {k, -1};
    if (o.is_of_place()) return {-1, k};
    if (o.op != Operator::multiply) return {-1, -1};
    for (const auto& [t, X] : {Factors{o.first, o.second}, Factors{o.second, o.first}}) {
      if ((*this)[t].is_of_time() && (*this)[X].is_of_place()) return {t, X};
    }
    return {-1, -1};
  };
  const Factors p = factors_of(first), q = factors_of(second);
  const bool p_factors = p.first >= 0 || p.second >= 0, q_factors = q.first >= 0 || q.second >= 0;
  const bool joins_time = p.first >= 0 && q.first >= 0;
  const bool joins_place = p.second >= 0 && q.second >= 0;
  const bool is_done = p.second < 0 && q.second < 0;  // of time alone
  if (!p_factors || !q_factors || (!joins_time && !joins_place)) return -1;
  if (is_done || (p.first < 0 && q.first < 0)) return -1;
  const int of_time =
      joins_time ? add(Operator::multiply, p.first, q.first) : std::max(p.first, q.first);
  const int of_place =
      joins_place ? add(Operator::multiply, p.second, q.second) : std::max(p.second, q.second);
  return add(Operator::multiply, of_time, of_place);
}

/// @param place            of the operation
/// @param d_first, d_second  derivatives of its arguments, -1: zero; not both
/// @return the derivative, or -1: zero
int Program::derivative_of(const Operation& o, int place, int d_first, int d_second) {
  const auto multiplied = [&](int a, int b) { return add(Operator::multiply, a, b); };
  const auto scaled = [&](double c, int a) { return add(Operator::scale, a, -1, c); };
  const auto power = [&](int a, double p) { return add(Operator::power, a, -1, p); };
  const auto one_plus = [&](double sign, int a) {  // 1 + sign a^2
    return add(Operator::shift, scaled(sign, power(a, 2)), -1, 1);
  };
  const int a = o.first;
  switch (o.op) {
    case Operator::add:
      if (d_first < 0 || d_second < 0) return std::max(d_first, d_second);
      return add(Operator::add, d_first, d_second);
    case Operator::subtract:
      if (d_second < 0) return d_first;
      return d_first < 0 ? scaled(-1, d_second) : add(Operator::subtract, d_first, d_second);
    case Operator::multiply: {
      if (d_second < 0) return multiplied(d_first, o.second);
      if (d_first < 0) return multiplied(a, d_second);
      return add(Operator::add, multiplied(d_first, o.second), multiplied(a, d_second));
    }
    case Operator::divide: {  // (a' - (a/b) b') / b
      if (d_second < 0) return add(Operator::divide, d_first, o.second);
      const int change = multiplied(place, d_second);
      const int numerator =
          d_first < 0 ? scaled(-1, change) : add(Operator::subtract, d_first, change);
      return add(Operator::divide, numerator, o.second);
    }
    case Operator::scale:
      return scaled(o.constant, d_first);
    case Operator::shift:
      return d_first;
    default:
      break;
  }
  const int slope = [&] {
    switch (o.op) {
      case Operator::power:
        return scaled(o.constant, power(a, o.constant - 1));
      case Operator::sin:
        return add(Operator::cos, a);
      case Operator::cos:
        return scaled(-1, add(Operator::sin, a));
      case Operator::tan:
        return one_plus(1, place);
      case Operator::asin:
        return power(one_plus(-1, a), -0.5);
      case Operator::acos:
        return scaled(-1, power(one_plus(-1, a), -0.5));
      case Operator::atan:
        return power(one_plus(1, a), -1);
      case Operator::sinh:
        return add(Operator::cosh, a);
      case Operator::cosh:
        return add(Operator::sinh, a);
      case Operator::tanh:
        return one_plus(-1, place);
      case Operator::asinh:
        return power(one_plus(1, a), -0.5);
      case Operator::acosh:
        return power(add(Operator::shift, power(a, 2), -1, -1), -0.5);
      case Operator::atanh:
        return power(one_plus(-1, a), -1);
      case Operator::exp:
        return place;
      case Operator::log:
        return power(a, -1);
      default:  // sqrt
        return scaled(0.5, power(place, -1));
    }
  }();
  return multiplied(slope, d_first);
}

/// Which operations a result reads, itself among them.  [result + 1]
std::vector<char> Program::made_of(int result) const {
  std::vector<char> is_part(static_cast<size_t>(result) + 1, 0);
  is_part.back() = 1;
  for (int k = result; k >= 0; --k) {
    if (!is_part[static_cast<size_t>(k)]) continue;
    const Operation& o = (*this)[k];
    const int arguments[3] = {o.first, o.second, o.third};
    for (int i = 0; i < o.n_arguments(); ++i)
      is_part[static_cast<size_t>(arguments[i])] = 1;
  }
  return is_part;
}

bool Program::smooth_in_place(int result) const {
  const std::vector<char> is_part = made_of(result);
  for (int k = 0; k <= result; ++k) {
    const Operation& o = (*this)[k];
    const bool has_derivative = o.op <= Operator::sqrt && o.op != Operator::given;
    if (is_part[static_cast<size_t>(k)] && o.on_position && !has_derivative) return false;
  }
  return true;
}

/// Forward through what the result is made of: no recursion, whatever its depth.
int Program::derivative(int of, int variable) {
  const std::vector<char> is_part = made_of(of);
  for (int k = 0; k <= of; ++k) {
    if (!is_part[static_cast<size_t>(k)]) continue;
    const std::int64_t key = 4 * static_cast<std::int64_t>(k) + variable;
    if (derivatives_.count(key) != 0) continue;
    const Operation o = (*this)[k];
    int result = -1;
    if (o.op == Operator::variable) {
      if (o.first == variable) result = add_constant(1);
    } else if (variable < 3 ? o.on_position : o.on_time) {
      const auto of_argument = [&](int argument) {
        return derivatives_.at(4 * static_cast<std::int64_t>(argument) + variable);
      };
      const int d_first = of_argument(o.first);
      const int d_second = o.n_arguments() > 1 ? of_argument(o.second) : -1;
      if (d_first >= 0 || d_second >= 0) result = derivative_of(o, k, d_first, d_second);
    }
    derivatives_[key] = result;
  }
  const int result = derivatives_.at(4 * static_cast<std::int64_t>(of) + variable);
  return result < 0 ? add_constant(0) : result;
}

}  // namespace diptych::functions
