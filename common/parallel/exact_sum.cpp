#include "common/parallel/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace diptych::parallel {

namespace {

constexpr int digit_bits = 32;
constexpr std::int64_t digit_mask = (std::int64_t{1} << digit_bits) - 1;

/// Digits from 0 to 2^32 - 1 of the same number, but for the last, which has its sign.
void carry(std::span<std::int64_t> digits) {
  for (size_t i = 0; i + 1 < digits.size(); ++i) {
    digits[i + 1] += digits[i] >> digit_bits;
    digits[i] &= digit_mask;
  }
}

}  // namespace

void ExactSum::add(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<int>(bits >> 52 & 0x7ff);
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  const bool is_negative = bits >> 63 != 0;
  if (exponent == 0x7ff) {
    ++words_[mantissa != 0 ? not_a_number : is_negative ? minus_infinity : infinity];
    return;
  }
  if (exponent != 0) mantissa |= std::uint64_t{1} << 52;
  const int place = exponent == 0 ? 0 : exponent - 1;  // x = mantissa 2^(place - 1074)
  const int digit = place / digit_bits, shift = place % digit_bits;
  const auto low = static_cast<std::int64_t>(mantissa << shift & digit_mask);
  const auto middle = static_cast<std::int64_t>(mantissa >> (digit_bits - shift) & digit_mask);
  const auto high =
      shift == 0 ? 0 : static_cast<std::int64_t>(mantissa >> digit_bits >> (digit_bits - shift));
  const std::int64_t sign = is_negative ? -1 : 1;
  first_ = std::min(first_, digit);
  last_ = std::max(last_, digit + 2);
  words_[digit] += sign * low;
  words_[digit + 1] += sign * middle;
  words_[digit + 2] += sign * high;
}

double ExactSum::value() const {
  if (words_[not_a_number] != 0 || (words_[infinity] != 0 && words_[minus_infinity] != 0))
    return std::numeric_limits<double>::quiet_NaN();
  if (words_[infinity] != 0) return std::numeric_limits<double>::infinity();
  if (words_[minus_infinity] != 0) return -std::numeric_limits<double>::infinity();

  int first = first_, top = last_;
  while (first < top && words_[first] == 0)
    ++first;
  while (top > first && words_[top] == 0)
    --top;
  if (top < first) return 0;
  first = std::min(first, n_digits - 3);
  top = std::min(std::max(top, first + 1) + 2, n_digits - 1);  // with what is carried, and a sign
  std::array<std::int64_t, n_digits> digits;
  std::copy(words_.begin() + first, words_.begin() + top + 1, digits.begin() + first);
  const std::span range(digits.data() + first, digits.data() + top + 1);
  carry(range);
  const bool is_negative = range.back() < 0;
  if (is_negative) {
    for (std::int64_t& digit : range)
      digit = -digit;
    carry(range);
  }
  while (top > first + 1 && digits[top] == 0)
    --top;
  // the leading 64 bits, the last of which says whether any is set behind them, too
  auto bits = static_cast<std::uint64_t>(digits[top]) << digit_bits |
              static_cast<std::uint64_t>(digits[top - 1]);
  if (bits == 0) return 0;
  std::uint64_t rest = top >= first + 2 ? static_cast<std::uint64_t>(digits[top - 2]) : 0;
  const int shift = std::countl_zero(bits);
  int place = digit_bits * (top - 1);
  if (shift > 0) {
    rest <<= digit_bits;
    bits = bits << shift | rest >> (64 - shift);
    rest <<= shift;
    place -= shift;
  }
  bool has_more = rest != 0;
  for (int i = first; i < top - 2 && !has_more; ++i)
    has_more = digits[i] != 0;
  if (has_more) bits |= 1;
  const double size = std::ldexp(static_cast<double>(bits), place - 1074);
  return is_negative ? -size : size;
}

}  // namespace diptych::parallel
