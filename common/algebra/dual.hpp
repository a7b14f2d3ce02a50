#pragma once
/// A value with its first derivatives by n variables (forward mode), exact to rounding. A scalar of
/// the templated physics: a response evaluated with Dual gives its gradient, no formula is written
/// twice. Conditions: natural_log and cube_root need a positive (cube_root: non-zero) value.
/// Test: tests/common/algebra/dual_test.cpp.

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

/// Aligned like its scalar: code for wider instruction sets (DIPTYCH_CLONES) relies on it, and
/// baseline code by itself would align Lanes to 16 bytes only.
/// @tparam T  double or Lanes  @tparam n  number of variables
template <class T, int n>
struct alignas(sizeof(T)) Dual {
  T v;     ///< value
  T d[n];  ///< derivatives

  DIPTYCH_INLINE Dual& operator+=(const Dual& b) { return *this = *this + b; }
  DIPTYCH_INLINE Dual& operator-=(const Dual& b) { return *this = *this - b; }
};

/// f(a) from the value f and the derivative f' at a.v
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> chained(const Dual<T, n>& a, const T& f, const T& slope) {
  Dual<T, n> r;
  r.v = f;
  for (int k = 0; k < n; ++k)
    r.d[k] = slope * a.d[k];
  return r;
}

template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator+(const Dual<T, n>& a, const Dual<T, n>& b) {
  Dual<T, n> r;
  r.v = a.v + b.v;
  for (int k = 0; k < n; ++k)
    r.d[k] = a.d[k] + b.d[k];
  return r;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator-(const Dual<T, n>& a, const Dual<T, n>& b) {
  Dual<T, n> r;
  r.v = a.v - b.v;
  for (int k = 0; k < n; ++k)
    r.d[k] = a.d[k] - b.d[k];
  return r;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator*(const Dual<T, n>& a, const Dual<T, n>& b) {
  Dual<T, n> r;
  r.v = a.v * b.v;
  for (int k = 0; k < n; ++k)
    r.d[k] = a.d[k] * b.v + a.v * b.d[k];
  return r;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator+(const Dual<T, n>& a, double b) {
  Dual<T, n> r = a;
  r.v = a.v + b;
  return r;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator+(double b, const Dual<T, n>& a) {
  return a + b;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator-(const Dual<T, n>& a, double b) {
  return a + (-b);
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator*(double s, const Dual<T, n>& a) {
  Dual<T, n> r;
  r.v = s * a.v;
  for (int k = 0; k < n; ++k)
    r.d[k] = s * a.d[k];
  return r;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator*(const Dual<T, n>& a, double s) {
  return s * a;
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator/(double s, const Dual<T, n>& a) {
  const T inverse = 1.0 / a.v, f = s * inverse;
  return chained(a, f, T(-f * inverse));
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> operator/(const Dual<T, n>& a, const Dual<T, n>& b) {
  return a * (1.0 / b);
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> natural_log(const Dual<T, n>& a) {
  return chained(a, natural_log(a.v), T(1.0 / a.v));
}
template <class T, int n>
DIPTYCH_INLINE Dual<T, n> cube_root(const Dual<T, n>& a) {
  const T f = cube_root(a.v);
  return chained(a, f, T((1.0 / 3.0) * f / a.v));
}

}  // namespace diptych::algebra
