#pragma once
/// 3x3 tensors of hot code, generic in the scalar T (double or Lanes). Trivially copyable, no
/// allocation, everything inlined. Notation of the paper: (A x B)_iI = e_ijk e_IJK A_jJ B_kK.
/// Tests: tests/common/algebra/tensor_test.cpp.

#include "common/algebra/dual.hpp"
#include "common/algebra/lanes.hpp"
#include "common/algebra/vectors.hpp"

namespace diptych::algebra {

template <class T>
struct Vector {
  T c[3];
  DIPTYCH_INLINE T& operator[](int i) { return c[i]; }
  DIPTYCH_INLINE const T& operator[](int i) const { return c[i]; }
};

template <class T>
struct Tensor {
  T m[3][3];
  DIPTYCH_INLINE T& operator()(int i, int j) { return m[i][j]; }
  DIPTYCH_INLINE const T& operator()(int i, int j) const { return m[i][j]; }
};

/// Symmetric tensor in the order 11, 22, 33, 12, 13, 23.
template <class T>
struct SymmetricTensor {
  T s[6];
  static constexpr int index(int i, int j) { return i == j ? i : i + j + 2; }
  DIPTYCH_INLINE T& operator()(int i, int j) { return s[index(i, j)]; }
  DIPTYCH_INLINE const T& operator()(int i, int j) const { return s[index(i, j)]; }
};

// ---- vectors
template <class T>
DIPTYCH_INLINE Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class T>
DIPTYCH_INLINE Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class S, class T>
DIPTYCH_INLINE Vector<T> operator*(const S& s, const Vector<T>& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
template <class T>
DIPTYCH_INLINE T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
DIPTYCH_INLINE Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

// ---- tensors
template <class T>
DIPTYCH_INLINE Tensor<T> identity() {
  Tensor<T> I{};
  for (int i = 0; i < 3; ++i)
    I(i, i) = T{} + 1.0;
  return I;
}
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> symmetric_identity() {
  SymmetricTensor<T> I{};
  for (int i = 0; i < 3; ++i)
    I.s[i] = T{} + 1.0;
  return I;
}
template <class T>
DIPTYCH_INLINE Tensor<T> operator+(const Tensor<T>& A, const Tensor<T>& B) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = A(i, j) + B(i, j);
  return R;
}
template <class T>
DIPTYCH_INLINE Tensor<T> operator-(const Tensor<T>& A, const Tensor<T>& B) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = A(i, j) - B(i, j);
  return R;
}
template <class S, class T>
DIPTYCH_INLINE Tensor<T> operator*(const S& s, const Tensor<T>& A) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = s * A(i, j);
  return R;
}
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> operator+(const SymmetricTensor<T>& A,
                                            const SymmetricTensor<T>& B) {
  SymmetricTensor<T> R;
  for (int k = 0; k < 6; ++k)
    R.s[k] = A.s[k] + B.s[k];
  return R;
}
template <class S, class T>
DIPTYCH_INLINE SymmetricTensor<T> operator*(const S& s, const SymmetricTensor<T>& A) {
  SymmetricTensor<T> R;
  for (int k = 0; k < 6; ++k)
    R.s[k] = s * A.s[k];
  return R;
}

/// A b
template <class T>
DIPTYCH_INLINE Vector<T> product(const Tensor<T>& A, const Vector<T>& b) {
  Vector<T> r;
  for (int i = 0; i < 3; ++i)
    r[i] = A(i, 0) * b[0] + A(i, 1) * b[1] + A(i, 2) * b[2];
  return r;
}
template <class T>
DIPTYCH_INLINE Vector<T> product(const SymmetricTensor<T>& A, const Vector<T>& b) {
  Vector<T> r;
  for (int i = 0; i < 3; ++i)
    r[i] = A(i, 0) * b[0] + A(i, 1) * b[1] + A(i, 2) * b[2];
  return r;
}
/// A B
template <class T>
DIPTYCH_INLINE Tensor<T> product(const Tensor<T>& A, const Tensor<T>& B) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
  return R;
}
template <class T>
DIPTYCH_INLINE Tensor<T> product(const Tensor<T>& A, const SymmetricTensor<T>& B) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
  return R;
}
template <class T>
DIPTYCH_INLINE Tensor<T> transpose(const Tensor<T>& A) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = A(j, i);
  return R;
}
template <class T>
DIPTYCH_INLINE T contract(const Tensor<T>& A, const Tensor<T>& B) {
  T s = A(0, 0) * B(0, 0);
  for (int k = 1; k < 9; ++k)
    s += A(k / 3, k % 3) * B(k / 3, k % 3);
  return s;
}
template <class T>
DIPTYCH_INLINE T contract(const SymmetricTensor<T>& A, const SymmetricTensor<T>& B) {
  return A.s[0] * B.s[0] + A.s[1] * B.s[1] + A.s[2] * B.s[2] +
         2.0 * (A.s[3] * B.s[3] + A.s[4] * B.s[4] + A.s[5] * B.s[5]);
}
template <class T>
DIPTYCH_INLINE T trace(const SymmetricTensor<T>& A) {
  return A.s[0] + A.s[1] + A.s[2];
}
/// N . A N
template <class T>
DIPTYCH_INLINE T quadratic(const SymmetricTensor<T>& A, const Vector<T>& N) {
  return dot(N, product(A, N));
}
/// F^T F
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> transpose_times_self(const Tensor<T>& F) {
  SymmetricTensor<T> C;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      C(i, j) = F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
  return C;
}
/// a (x) b
template <class T>
DIPTYCH_INLINE Tensor<T> outer(const Vector<T>& a, const Vector<T>& b) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = a[i] * b[j];
  return R;
}
/// Tensor cross product A x B
template <class T>
DIPTYCH_INLINE Tensor<T> cross(const Tensor<T>& A, const Tensor<T>& B) {
  Tensor<T> R;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = 0; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      R(i, I) = (A(j, J) * B(k, K) - A(j, K) * B(k, J)) + (B(j, J) * A(k, K) - B(j, K) * A(k, J));
    }
  }
  return R;
}
/// Tensor cross product of symmetric tensors, symmetric.
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> cross(const SymmetricTensor<T>& A, const SymmetricTensor<T>& B) {
  SymmetricTensor<T> R;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = i; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      R(i, I) = (A(j, J) * B(k, K) - A(j, K) * B(k, J)) + (B(j, J) * A(k, K) - B(j, K) * A(k, J));
    }
  }
  return R;
}
/// H = cof F = 1/2 F x F
template <class T>
DIPTYCH_INLINE Tensor<T> cofactor(const Tensor<T>& F) {
  Tensor<T> H;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = 0; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      H(i, I) = F(j, J) * F(k, K) - F(j, K) * F(k, J);
    }
  }
  return H;
}
/// Cofactor of a symmetric tensor.
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> cofactor(const SymmetricTensor<T>& A) {
  SymmetricTensor<T> R;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = i; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;
      R(i, I) = A(j, J) * A(k, K) - A(j, K) * A(k, J);
    }
  }
  return R;
}
template <class T>
DIPTYCH_INLINE T determinant(const Tensor<T>& F, const Tensor<T>& cof_F) {
  return F(0, 0) * cof_F(0, 0) + F(0, 1) * cof_F(0, 1) + F(0, 2) * cof_F(0, 2);
}
template <class T>
DIPTYCH_INLINE T determinant(const SymmetricTensor<T>& A) {
  const SymmetricTensor<T> c = cofactor(A);
  return A(0, 0) * c(0, 0) + A(0, 1) * c(0, 1) + A(0, 2) * c(0, 2);
}
/// Inverse of a symmetric, invertible tensor.
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> inverse(const SymmetricTensor<T>& A) {
  const SymmetricTensor<T> c = cofactor(A);
  const T det = A(0, 0) * c(0, 0) + A(0, 1) * c(0, 1) + A(0, 2) * c(0, 2);
  return (1.0 / det) * c;
}

/// 2 cos(2/3 acos(s)) for s in [0, 1], from above: never less, at most 2e-8 more. The polynomial of
/// degree 8 in t = 2 s - 1 through the Chebyshev points (it errs by 7.5e-9: the nearest singularity
/// is s = -1), raised by 1e-8.
template <class T>
DIPTYCH_INLINE T two_cosines_bound(const T& s) {
  constexpr double a[9] = {1.532088896238,      0.4948180846726,    -0.03101836322883,
                           0.004933341330805,   -0.001008430151436, 0.0002306004011789,
                           -5.720022214146e-05, 1.79677855963e-05,  -4.890979009057e-06};
  const T t = 2.0 * s - 1.0, t2 = t * t, t4 = t2 * t2;
  const T low = (a[0] + a[1] * t) + t2 * (a[2] + a[3] * t);
  const T high = (a[4] + a[5] * t) + t2 * (a[6] + a[7] * t);
  return low + t4 * (high + t4 * a[8]);
}

/// An upper bound of the largest eigenvalue of a symmetric tensor, within 1e-7 norm(A) of it: with
/// A = q I + p B, the scaled eigenvalue is y = 2 cos(acos(r)/3), r = det(B)/2 in [-1, 1], and with
/// s = cos(acos(r)/2) = sqrt((1 + r)/2) y = 2 cos(2/3 acos(s)), which is smooth in s. Where the two
/// largest eigenvalues coincide (r = -1) an error of r counts with its square root: r is raised by
/// more than its rounding.
template <class T>
DIPTYCH_INLINE T largest_eigenvalue_bound(const SymmetricTensor<T>& A) {
  const T q = (1.0 / 3.0) * trace(A);
  SymmetricTensor<T> B = A;
  for (int i = 0; i < 3; ++i)
    B.s[i] = B.s[i] - q;
  const T p2 = (1.0 / 6.0) * contract(B, B);
  const T p = square_root(p2);
  const T inverse_p3 = inverse_or_zero(p2 * p);
  T r = 0.5 * determinant(B) * inverse_p3;
  r = larger(T{} - 1.0, r) + (1e-14 + 2e-15 * magnitude(q) * p2 * inverse_p3);
  r = smaller(T{} + 1.0, r);
  return q + p * two_cosines_bound(square_root(0.5 + 0.5 * r));
}

// ---- conversions of set-up code and tests
inline Tensor<double> to_tensor(const Mat3& M) {
  Tensor<double> R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      R(i, j) = M(i, j);
  return R;
}
inline Vector<double> to_vector(const Vec3& a) {
  return {{a[0], a[1], a[2]}};
}
inline SymmetricTensor<double> to_symmetric(const Mat3& M) {
  return {{M(0, 0), M(1, 1), M(2, 2), M(0, 1), M(0, 2), M(1, 2)}};
}
inline Mat3 to_eigen(const Tensor<double>& A) {
  Mat3 M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      M(i, j) = A(i, j);
  return M;
}
inline Mat3 to_eigen(const SymmetricTensor<double>& A) {
  Mat3 M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      M(i, j) = A(i, j);
  return M;
}
inline Vec3 to_eigen(const Vector<double>& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace diptych::algebra
