#pragma once
/// Eight nodes at once. `Lanes` is a GCC vector of eight doubles; the compiler lowers it to SSE2,
/// AVX2 or AVX-512. Code of physics and scheme is generic in its scalar T = double or Lanes; pair
/// sweeps also in `Pack<float>`, eight singles.
///
/// DIPTYCH_CLONES compiles a hot function once per instruction set and picks at start-up. Only what
/// is inlined into such a function is compiled with it: mark helpers DIPTYCH_INLINE.
/// Contraction to fused multiply-adds is left on: AVX2 and AVX-512 then agree bit for bit with each
/// other, the baseline (SSE2, no fused multiply-add) does not agree with them.

#include <cmath>
#include <cstdint>
#include <type_traits>

#define DIPTYCH_INLINE inline __attribute__((always_inline))
/// For lambdas: after the parameters.
#define DIPTYCH_INLINE_LAMBDA __attribute__((always_inline))

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define DIPTYCH_MULTIVERSION
#define DIPTYCH_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
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

// One name for both scalars, so that a formula is written once.
DIPTYCH_INLINE double square_root(double a) {
  return std::sqrt(a);
}
DIPTYCH_INLINE Lanes square_root(Lanes a) {
  Lanes r;
  for (int i = 0; i < n_lanes; ++i)
    r[i] = __builtin_sqrt(a[i]);
  return r;
}
DIPTYCH_INLINE SingleLanes square_root(SingleLanes a) {
  SingleLanes r;
  for (int i = 0; i < n_lanes; ++i)
    r[i] = __builtin_sqrtf(a[i]);
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
DIPTYCH_INLINE Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
DIPTYCH_INLINE SingleLanes larger(SingleLanes a, SingleLanes b) {
  return a > b ? a : b;
}
DIPTYCH_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}
DIPTYCH_INLINE Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
DIPTYCH_INLINE SingleLanes smaller(SingleLanes a, SingleLanes b) {
  return a < b ? a : b;
}
DIPTYCH_INLINE double magnitude(double a) {
  return std::fabs(a);
}
DIPTYCH_INLINE Lanes magnitude(Lanes a) {
  return a < 0 ? -a : a;
}
DIPTYCH_INLINE SingleLanes magnitude(SingleLanes a) {
  return a < 0 ? -a : a;
}
/// 1/a, or 0 where a = 0.
DIPTYCH_INLINE double inverse_or_zero(double a) {
  return a != 0 ? 1 / a : 0;
}
DIPTYCH_INLINE Lanes inverse_or_zero(Lanes a) {
  const Lanes one = Lanes{} + 1.0;
  return a != 0 ? one / (a != 0 ? a : one) : Lanes{};
}
DIPTYCH_INLINE SingleLanes inverse_or_zero(SingleLanes a) {
  const SingleLanes one = SingleLanes{} + 1.0F;
  return a != 0 ? one / (a != 0 ? a : one) : SingleLanes{};
}
/// a/b, or 0 where b = 0; no overflow of 1/b where b is tiny.
template <class T>
DIPTYCH_INLINE T ratio_or_zero(const T& a, const T& b) {
  return b != 0 ? a / (b != 0 ? b : T{} + 1.0F) : T{};
}
using HalfLanes = double __attribute__((vector_size(4 * sizeof(double))));
using QuarterLanes = double __attribute__((vector_size(2 * sizeof(double))));

/// Sum of the eight lanes, always in the same tree shape.
DIPTYCH_INLINE double lane_sum(const Lanes& a) {
  const HalfLanes half =
      __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
  const QuarterLanes quarter =
      __builtin_shufflevector(half, half, 0, 1) + __builtin_shufflevector(half, half, 2, 3);
  return quarter[0] + quarter[1];
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
/// Eight doubles or singles as T = Lanes or SingleLanes.
template <class T>
DIPTYCH_INLINE T load_as(const double* p) {
  if constexpr (std::is_same_v<T, Lanes>) return load(p);
  return __builtin_convertvector(load(p), T);
}
template <class T>
DIPTYCH_INLINE T load_as(const float* p) {
  if constexpr (std::is_same_v<T, Lanes>) return load(p);
  T r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}
DIPTYCH_INLINE Lanes widened(const Lanes& a) {
  return a;
}
DIPTYCH_INLINE Lanes widened(const SingleLanes& a) {
  return Lanes{a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]};
}
DIPTYCH_INLINE void store(double* p, const Lanes& a) {
  __builtin_memcpy(p, &a, sizeof a);
}
DIPTYCH_INLINE void store(float* p, const SingleLanes& a) {
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
