#pragma once
/// Eight nodes at once. `Lanes` is a GCC vector of eight doubles; the compiler lowers it to SSE2,
/// AVX2 or AVX-512. Code of physics and scheme is generic in its scalar T = double or Lanes; pair
/// sweeps also in `SingleLanes`, eight singles, and `WideSingles`, those of two blocks.
///
/// DIPTYCH_CLONES compiles a hot function once per instruction set and picks at start-up. Only what
/// is inlined into such a function is compiled with it: mark helpers DIPTYCH_INLINE.
/// Contraction to fused multiply-adds is left on: AVX2 and AVX-512 then agree bit for bit with each
/// other, the baseline (SSE2, no fused multiply-add) does not agree with them.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#define DIPTYCH_INLINE inline __attribute__((always_inline))
/// For lambdas: after the parameters.
#define DIPTYCH_INLINE_LAMBDA __attribute__((always_inline))

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define DIPTYCH_MULTIVERSION
#if defined(DIPTYCH_ONLY_AVX512)  // of builds with DIPTYCH_INSTRUCTION_SETS=HERE, for development
#define DIPTYCH_CLONES __attribute__((target("arch=x86-64-v4")))
#elif defined(DIPTYCH_ONLY_AVX2)
#define DIPTYCH_CLONES __attribute__((target("arch=x86-64-v3")))
#else
#define DIPTYCH_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#endif
#define DIPTYCH_AVX2 __attribute__((target("arch=x86-64-v3")))
#define DIPTYCH_AVX512 __attribute__((target("arch=x86-64-v4")))
#else
#define DIPTYCH_CLONES
#define DIPTYCH_AVX2
#define DIPTYCH_AVX512
#endif

namespace diptych::algebra {

inline constexpr int n_lanes = 8;

using Lanes = double __attribute__((vector_size(n_lanes * sizeof(double))));
using SingleLanes = float __attribute__((vector_size(n_lanes * sizeof(float))));

using WideSingles = float __attribute__((vector_size(2 * n_lanes * sizeof(float))));

template <class Real>
struct PackOf;
template <>
struct PackOf<double> {
  using type = Lanes;
};
template <>
struct PackOf<float> {
  using type = SingleLanes;
};
/// Eight of Real = double or float.
template <class Real>
using Pack = typename PackOf<Real>::type;

template <class T>
concept Vectorised =
    std::is_same_v<T, Lanes> || std::is_same_v<T, SingleLanes> || std::is_same_v<T, WideSingles>;
/// Number and type of the elements of a vector.
template <Vectorised T>
using Element = std::remove_cvref_t<decltype(T{}[0])>;
template <Vectorised T>
inline constexpr int width_of = sizeof(T) / sizeof(Element<T>);

// One name for scalars and vectors, so that a formula is written once.
DIPTYCH_INLINE double square_root(double a) {
  return std::sqrt(a);
}
template <Vectorised T>
DIPTYCH_INLINE T square_root(const T& a) {
  T r;
  for (int i = 0; i < width_of<T>; ++i)
    r[i] = std::sqrt(a[i]);
  return r;
}
DIPTYCH_INLINE double natural_log(double a) {
  return std::log(a);
}
DIPTYCH_INLINE Lanes natural_log(Lanes a) {
  Lanes r;
  for (int i = 0; i < n_lanes; ++i)
    r[i] = std::log(a[i]);
  return r;
}
/// ln(1 + a), to rounding of a
DIPTYCH_INLINE double natural_log_1p(double a) {
  return std::log1p(a);
}
DIPTYCH_INLINE Lanes natural_log_1p(Lanes a) {
  Lanes r;
  for (int i = 0; i < n_lanes; ++i)
    r[i] = std::log1p(a[i]);
  return r;
}
DIPTYCH_INLINE double cube_root(double a) {
  return std::cbrt(a);
}
DIPTYCH_INLINE Lanes cube_root(Lanes a) {
  Lanes r;
  for (int i = 0; i < n_lanes; ++i)
    r[i] = std::cbrt(a[i]);
  return r;
}
DIPTYCH_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
template <Vectorised T>
DIPTYCH_INLINE T larger(const T& a, const T& b) {
  return a > b ? a : b;
}
DIPTYCH_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}
template <Vectorised T>
DIPTYCH_INLINE T smaller(const T& a, const T& b) {
  return a < b ? a : b;
}
DIPTYCH_INLINE double magnitude(double a) {
  return std::fabs(a);
}
template <Vectorised T>
DIPTYCH_INLINE T magnitude(const T& a) {
  return a < 0 ? -a : a;
}
/// Whether a, every element of it, is below the bound.
DIPTYCH_INLINE bool all_below(double a, double bound) {
  return a < bound;
}
DIPTYCH_INLINE bool all_below(const Lanes& a, double bound) {
  const auto below = a < bound;
  bool all = true;
  for (int i = 0; i < n_lanes; ++i)
    all = all && below[i] != 0;
  return all;
}
/// 1/a, or 0 where a is 0 or so small that 1/a is not finite (its product with 0 would be no
/// number: ahead of a wave everything decays to such values).
DIPTYCH_INLINE double inverse_or_zero(double a) {
  return magnitude(a) < std::numeric_limits<double>::min() ? 0 : 1 / a;
}
template <Vectorised T>
DIPTYCH_INLINE T inverse_or_zero(const T& a) {
  const T one = T{} + 1.0F;
  const T least = T{} + std::numeric_limits<Element<T>>::min();
  return magnitude(a) < least ? T{} : one / (magnitude(a) < least ? one : a);
}
/// a/b, or 0 where b = 0; no overflow of 1/b where b is tiny.
template <Vectorised T>
DIPTYCH_INLINE T ratio_or_zero(const T& a, const T& b) {
  return b != 0 ? a / (b != 0 ? b : T{} + 1.0F) : T{};
}
using HalfLanes = double __attribute__((vector_size(4 * sizeof(double))));
using QuarterLanes = double __attribute__((vector_size(2 * sizeof(double))));

/// In double precision.
DIPTYCH_INLINE Lanes widened(const Lanes& a) {
  return a;
}
DIPTYCH_INLINE Lanes widened(const SingleLanes& a) {
  return Lanes{a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]};
}

/// Sum of the lanes, always in the same tree shape.
DIPTYCH_INLINE double lane_sum(const HalfLanes& half) {
  const QuarterLanes quarter =
      __builtin_shufflevector(half, half, 0, 1) + __builtin_shufflevector(half, half, 2, 3);
  return quarter[0] + quarter[1];
}
DIPTYCH_INLINE double lane_sum(const Lanes& a) {
  return lane_sum(__builtin_shufflevector(a, a, 0, 1, 2, 3) +
                  __builtin_shufflevector(a, a, 4, 5, 6, 7));
}
DIPTYCH_INLINE double lane_sum(const SingleLanes& a) {
  const auto half =
      __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
  return lane_sum(HalfLanes{half[0], half[1], half[2], half[3]});
}
DIPTYCH_INLINE SingleLanes first_half(const WideSingles& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3, 4, 5, 6, 7);
}
DIPTYCH_INLINE SingleLanes second_half(const WideSingles& a) {
  return __builtin_shufflevector(a, a, 8, 9, 10, 11, 12, 13, 14, 15);
}
DIPTYCH_INLINE WideSingles joined(const SingleLanes& first, const SingleLanes& second) {
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
                                 15);
}
DIPTYCH_INLINE double lane_sum(const WideSingles& a) {
  return lane_sum(widened(first_half(a)) + widened(second_half(a)));
}
DIPTYCH_INLINE Lanes load(const double* p) {
  Lanes r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}
/// Eight singles, widened: in this form one instruction, as a conversion of vectors four.
DIPTYCH_INLINE Lanes load(const float* p) {
  return Lanes{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
}
/// Doubles or singles as T.
template <Vectorised T>
DIPTYCH_INLINE T load_as(const double* p) {
  if constexpr (std::is_same_v<T, Lanes>) {
    return load(p);
  } else {
    return __builtin_convertvector(load(p), T);
  }
}
template <Vectorised T>
DIPTYCH_INLINE T load_as(const float* p) {
  if constexpr (std::is_same_v<T, Lanes>) {
    return load(p);
  } else {
    T r;
    __builtin_memcpy(&r, p, sizeof r);
    return r;
  }
}
template <Vectorised T>
DIPTYCH_INLINE void store(Element<T>* p, const T& a) {
  __builtin_memcpy(p, &a, sizeof a);
}
/// Rounds.
DIPTYCH_INLINE void store(float* p, const Lanes& a) {
  store(p, __builtin_convertvector(a, SingleLanes));
}

/// Instruction sets that pair sweeps are compiled for by hand: their gathers differ in form.
enum class InstructionSet { baseline, avx2, avx512 };

/// What this processor runs.
inline InstructionSet instruction_set() {
#if defined(DIPTYCH_MULTIVERSION)
  if (__builtin_cpu_supports("x86-64-v4")) return InstructionSet::avx512;
  if (__builtin_cpu_supports("x86-64-v3")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

}  // namespace diptych::algebra
