#pragma once
/// Sine, cosine and exponential of eight numbers at once, by polynomials on a reduced argument:
/// within two units in the last place of the exact value, for every finite argument. The code has
/// no branch that depends on a neighbouring lane, and AVX2 and AVX-512 give the same bits. Test:
/// tests/common/algebra/lane_functions_test.cpp

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

using LaneBits = long long __attribute__((vector_size(n_lanes * sizeof(long long))));

/// Adding this number rounds to an integer, which then stands in the low bits.
inline constexpr double rounding_shift = 0x1.8p52;

/// sum c_k z^k, k = 0 ... n - 1
template <int n>
DIPTYCH_INLINE Lanes polynomial(const double (&c)[n], const Lanes& z) {
  Lanes sum = Lanes{} + c[n - 1];
  for (int k = n - 2; k >= 0; --k)
    sum = sum * z + c[k];
  return sum;
}

/// x = quarter pi/2 + rest, |rest| <= pi/4.
struct QuarterTurns {
  Lanes rest;
  LaneBits quarter;  ///< low bits of the integer
};

/// Beyond it the pieces of pi/2 do not multiply exactly.
inline constexpr double largest_angle = 8e5;

/// pi/2 in three pieces, the first two of 33 bits: their products with integers below 2^20 are
/// exact (Cody and Waite, Software Manual for the Elementary Functions, 1980).
DIPTYCH_INLINE QuarterTurns quarter_turns(const Lanes& x) {
  constexpr double first = 0x1.921fb544p+0, second = 0x1.0b4611a6p-34,
                   third = 0x1.3198a2e037073p-69, inverse = 0x1.45f306dc9c883p-1;
  const Lanes shifted = x * inverse + rounding_shift, n = shifted - rounding_shift;
  return {((x - n * first) - n * second) - n * third, reinterpret_cast<LaneBits>(shifted)};
}

/// Sine and cosine of the rest: Taylor's series, whose first omitted term is below 1e-18.
DIPTYCH_INLINE void sine_cosine_of_rest(const Lanes& r, Lanes& sine, Lanes& cosine) {
  constexpr double of_sine[] = {
      -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  constexpr double of_cosine[] = {
      1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
      1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  const Lanes z = r * r;
  sine = r + r * z * polynomial(of_sine, z);
  cosine = 1.0 - (0.5 * z - z * z * polynomial(of_cosine, z));
}

/// Of arguments of any size; what is no finite number gives no number.
DIPTYCH_INLINE void sine_cosine(const Lanes& x, Lanes& sine, Lanes& cosine) {
  const QuarterTurns turns = quarter_turns(x);
  Lanes s, c;
  sine_cosine_of_rest(turns.rest, s, c);
  const LaneBits odd = turns.quarter & 1;
  const LaneBits sign_of_sine = (turns.quarter & 2) << 62;
  const LaneBits sign_of_cosine = ((turns.quarter + 1) & 2) << 62;
  const Lanes at_sine = odd != 0 ? c : s, at_cosine = odd != 0 ? s : c;
  const LaneBits bits_of_sine = reinterpret_cast<LaneBits>(at_sine) ^ sign_of_sine;
  const LaneBits bits_of_cosine = reinterpret_cast<LaneBits>(at_cosine) ^ sign_of_cosine;
  sine = reinterpret_cast<Lanes>(bits_of_sine);
  cosine = reinterpret_cast<Lanes>(bits_of_cosine);
  if (all_below(magnitude(x), largest_angle)) return;
  for (int lane = 0; lane < n_lanes; ++lane) {
    if (std::fabs(x[lane]) < largest_angle) continue;
    sine[lane] = std::sin(x[lane]);
    cosine[lane] = std::cos(x[lane]);
  }
}

/// 2^k of integers -1022 <= k <= 1023
DIPTYCH_INLINE Lanes power_of_two(const Lanes& k) {
  const Lanes shifted = k + (rounding_shift + 1023);
  const LaneBits bits = reinterpret_cast<LaneBits>(shifted) << 52;
  return reinterpret_cast<Lanes>(bits);
}

/// e^x; infinite above 709.78, subnormal and then zero below -708.4.
DIPTYCH_INLINE Lanes exponential(const Lanes& x) {
  constexpr double ln2_first = 0x1.62e42fefa2p-1, ln2_second = 0x1.9ef35793c7673p-41,
                   inverse = 0x1.71547652b82fep+0;
  constexpr double series[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                               1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                               1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const Lanes least = Lanes{} - 750, most = Lanes{} + 720;
  const Lanes above = x < least ? least : x, y = above > most ? most : above;
  const Lanes k = (y * inverse + rounding_shift) - rounding_shift;
  const Lanes r = (y - k * ln2_first) - k * ln2_second;
  const Lanes of_rest = 1.0 + (r + r * r * polynomial(series, r));
  const Lanes half = (0.5 * k + rounding_shift) - rounding_shift;  // 2^k itself may not exist
  return of_rest * power_of_two(half) * power_of_two(k - half);
}

}  // namespace diptych::algebra
