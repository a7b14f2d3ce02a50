#pragma once
/// A value with its first and second derivatives by n variables (forward mode), exact to rounding.
/// Test: tests/common/exact/motion_test.cpp.

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

/// Aligned like its scalar (see Dual).
/// @tparam T  double or Lanes  @tparam n  number of variables
template <class T, int n>
struct alignas(sizeof(T)) Jet {
  static constexpr int n_second = n * (n + 1) / 2;
  T v;             ///< value
  T d[n];          ///< first derivatives
  T dd[n_second];  ///< second derivatives: 00, 01, ..., 0n, 11, 12, ...

  /// Place of the second derivative by i and j.
  static constexpr int index(int i, int j) {
    return i <= j ? i * n - i * (i - 1) / 2 + j - i : index(j, i);
  }
};

template <class T, int n>
DIPTYCH_INLINE Jet<T, n> constant_jet(const T& value) {
  Jet<T, n> r{};
  r.v = value;
  return r;
}

/// f(a) from f, f' and f'' at a.v
template <class T, int n>
DIPTYCH_INLINE Jet<T, n> chained(const Jet<T, n>& a, const T& f, const T& slope, const T& bend) {
  Jet<T, n> r;
  r.v = f;
  for (int i = 0; i < n; ++i) {
    r.d[i] = slope * a.d[i];
    for (int j = i; j < n; ++j) {
      const int k = Jet<T, n>::index(i, j);
      r.dd[k] = slope * a.dd[k] + bend * a.d[i] * a.d[j];
    }
  }
  return r;
}

/// p a + q b
template <class T, int n>
DIPTYCH_INLINE Jet<T, n> combined(double p, const Jet<T, n>& a, double q, const Jet<T, n>& b) {
  Jet<T, n> r;
  r.v = p * a.v + q * b.v;
  for (int i = 0; i < n; ++i)
    r.d[i] = p * a.d[i] + q * b.d[i];
  for (int k = 0; k < Jet<T, n>::n_second; ++k)
    r.dd[k] = p * a.dd[k] + q * b.dd[k];
  return r;
}

template <class T, int n>
DIPTYCH_INLINE Jet<T, n> operator*(const Jet<T, n>& a, const Jet<T, n>& b) {
  Jet<T, n> r;
  r.v = a.v * b.v;
  for (int i = 0; i < n; ++i) {
    r.d[i] = a.d[i] * b.v + a.v * b.d[i];
    for (int j = i; j < n; ++j) {
      const int k = Jet<T, n>::index(i, j);
      r.dd[k] = a.dd[k] * b.v + a.v * b.dd[k] + a.d[i] * b.d[j] + a.d[j] * b.d[i];
    }
  }
  return r;
}

}  // namespace diptych::algebra
