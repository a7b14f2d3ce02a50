#pragma once
/// Sums that have no order: numbers are added without rounding, in fixed point that spans all
/// doubles (a small superaccumulator: Neal, arXiv:1505.05571), and rounded once, when the sum is
/// asked for. Parts of a sum may be added up by any rank in any order, as integers, and have the
/// same bits. Test: tests/common/parallel/exact_sum_test.cpp

#include <array>
#include <cstdint>
#include <span>

namespace diptych::parallel {

class ExactSum {
 public:
  /// Up to 2^31 times.
  void add(double x);
  /// The sum, rounded to the nearest double; NaN and infinities as a sum in any order has them.
  double value() const;
  /// Sums of several parts are sums of these, entry by entry, which whoever asks for them may
  /// change.
  std::span<std::int64_t> words() {
    first_ = 0;
    last_ = n_digits - 1;
    return words_;
  }

 private:
  /// Digits of 32 bits, the first one in units of the least double, 2^-1074; each has room for
  /// carries.
  static constexpr int n_digits = 67;
  enum Special { not_a_number = n_digits, infinity, minus_infinity, n_words };
  std::array<std::int64_t, n_words> words_{};
  int first_ = n_digits, last_ = -1;  // digits that are not all zero
};

}  // namespace diptych::parallel
