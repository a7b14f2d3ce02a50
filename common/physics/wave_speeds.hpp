#pragma once
/// Acoustic tensor, wave speeds and impedance, exact with all branches (notes 2). Reference
/// speeds: time steps and dissipation need no division by a stretch.
///
///   Q(N) = (a0 + tr M) I - M + W_JJ h(x)h + W_FJ (f(x)h + h(x)f),   f = F N, h = H N,
///   a0 = N.A_tot N,  M = F [N]x S_tot [N]x^T F^T.
///
/// With W_FJ = 0, h is an eigenvector (M h = 0): rho c_p^2 = a0 + tr M + W_JJ h.h, and the two
/// shear speeds follow from M's 2x2 block. Both sums are quadratic forms of N with node tensors,
///   rho c_p^2 = N.K_p N,           K_p = A_tot + S_tot x C + W_JJ G,
///   rho (c_s1^2 + c_s2^2) = N.K_s N,  K_s = 2 A_tot + S_tot x C,
/// so the largest speed over all directions is an eigenvalue of K_p, no search is needed.
/// With W_FJ != 0 (isochoric materials) M = 0 and Q - a0 I has rank two.
/// Tests: tests/common/physics/wave_speeds_test.cpp.

#include "common/physics/response.hpp"

namespace diptych::physics {

template <class T>
struct WaveSpeeds {
  T c_p;   ///< m/s, pressure wave
  T c_s1;  ///< m/s, faster shear wave
  T c_s2;  ///< m/s, slower shear wave
};

/// M = F [N]x S_tot [N]x^T F^T  [Pa]
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> shear_tensor(const Response<T>& r,
                                               const Tensor<T>& F,
                                               const Vector<T>& N) {
  Tensor<T> FN;  // rows: f_i x N, since (F [N]x)_ij = F_ik [N]x_kj
  for (int i = 0; i < 3; ++i) {
    const Vector<T> row = algebra::cross(Vector<T>{{F(i, 0), F(i, 1), F(i, 2)}}, N);
    for (int j = 0; j < 3; ++j)
      FN(i, j) = row[j];
  }
  const Tensor<T> FNS = algebra::product(FN, r.S_tot);
  SymmetricTensor<T> M;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      M(i, j) = FNS(i, 0) * FN(j, 0) + FNS(i, 1) * FN(j, 1) + FNS(i, 2) * FN(j, 2);
  return M;
}

/// Q(N) of P = dW/dF at frozen internal variables: Q_ij = d2W/dF_iI dF_jJ N_I N_J  [Pa]
template <class T>
DIPTYCH_INLINE SymmetricTensor<T> acoustic_tensor(const Response<T>& r,
                                                  const Deformation<T>& X,
                                                  const Vector<T>& N) {
  const SymmetricTensor<T> M = shear_tensor(r, X.F, N);
  const Vector<T> h = algebra::product(X.H, N);
  const Vector<T> f = algebra::product(X.F, N);
  const T diagonal = algebra::quadratic(r.A_tot, N) + algebra::trace(M);
  SymmetricTensor<T> Q;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      Q(i, j) = r.W_JJ * h[i] * h[j] + r.W_FJ * (f[i] * h[j] + h[i] * f[j]) - M(i, j);
      if (i == j) Q(i, j) += diagonal;
    }
  }
  return Q;
}

/// The two non-zero eigenvalues of W_JJ h(x)h + W_FJ (f(x)h + h(x)f), larger first  [Pa]
template <class T>
struct RankTwo {
  T larger, smaller;
};
template <class T>
DIPTYCH_INLINE RankTwo<T> rank_two_eigenvalues(const Response<T>& r,
                                               const Vector<T>& f,
                                               const Vector<T>& h) {
  const T fh = algebra::dot(f, h);
  const T trace = r.W_JJ * algebra::dot(h, h) + 2.0 * r.W_FJ * fh;
  T gram = algebra::dot(f, f) * algebra::dot(h, h) - fh * fh;
  gram = algebra::larger(gram, T{});
  const T root = algebra::square_root(0.25 * trace * trace + r.W_FJ * r.W_FJ * gram);
  return {0.5 * trace + root, 0.5 * trace - root};
}

/// Pressure and shear wave speeds in material direction N.
/// @param  rho_R  density [kg/m^3]
/// @param  N      unit normal in the reference configuration [-]
/// @return c_p >= c_s1 >= c_s2 > 0, since every material here is polyconvex
/// @pre    J > 0 (a state that is not a number gives NaN, which the health check reports)
template <class T>
DIPTYCH_INLINE WaveSpeeds<T> wave_speeds(const Response<T>& r,
                                         const Deformation<T>& X,
                                         double rho_R,
                                         const Vector<T>& N) {
  const SymmetricTensor<T> M = shear_tensor(r, X.F, N);
  const Vector<T> h = algebra::product(X.H, N);
  const Vector<T> f = algebra::product(X.F, N);
  const T a0 = algebra::quadratic(r.A_tot, N);
  const T tr_M = algebra::trace(M);
  // In the plane normal to h, M = tr_M/2 I + D has the eigenvalues tr_M/2 -+ sqrt(D:D/2). (The root
  // of tr_M^2/4 - m1 m2 would lose half the digits where the two shear waves coincide.)
  const T half = 0.5 * tr_M;
  const T along_h = half / algebra::dot(h, h);
  SymmetricTensor<T> D = M;
  for (int i = 0; i < 3; ++i) {
    D(i, i) -= half;
    for (int j = i; j < 3; ++j)
      D(i, j) += along_h * h[i] * h[j];
  }
  const T root = algebra::square_root(0.5 * algebra::contract(D, D));
  const RankTwo<T> t = rank_two_eigenvalues(r, f, h);
  const double inverse_rho = 1.0 / rho_R;
  WaveSpeeds<T> c;
  c.c_p = algebra::square_root(inverse_rho * (a0 + tr_M + t.larger));
  // isochoric materials: M = 0 and the shear pair is a0, a0 + t.smaller (t.smaller <= 0)
  c.c_s1 = algebra::square_root(inverse_rho * (a0 + half + root));
  c.c_s2 = algebra::square_root(inverse_rho * (a0 + half - root + t.smaller));
  return c;
}

/// Largest speeds over all directions N: exact (to the accuracy of largest_eigenvalue_bound, from
/// above) for W_FJ = 0, an upper bound otherwise; equal to the exact speeds at F = I.
template <class T>
struct SpeedBounds {
  T c_p;  ///< m/s, largest pressure wave speed over all N
  T c_s;  ///< m/s, largest root mean square of the two shear wave speeds over all N
};
template <class T>
DIPTYCH_INLINE SpeedBounds<T> speed_bounds(
    const Response<T>& r, const Deformation<T>& X, double rho_R, bool has_H, bool has_W_FJ) {
  const SymmetricTensor<T> C = algebra::transpose_times_self(X.F);
  const SymmetricTensor<T> G = algebra::transpose_times_self(X.H);
  SymmetricTensor<T> K_p = r.A_tot + r.W_JJ * G;
  SymmetricTensor<T> K_s = 2.0 * r.A_tot;
  if (has_H) {
    const SymmetricTensor<T> SC = algebra::cross(r.S_tot, C);
    K_p = K_p + SC;
    K_s = K_s + SC;
  }
  T rho_cp2 = algebra::largest_eigenvalue_bound(K_p);
  // the W_FJ part: 2 W_FJ f.h + |W_FJ| sqrt(|f|^2 |h|^2 - J^2), f.h = J for every N, and by
  // Kantorovich's inequality 4 (|f|^2 |h|^2 - J^2) <= tr C tr G - 9 J^2
  // (Where W_JJ |h|^2 + 2 W_FJ J < 0, along a large stretch, a direction needs more than its own
  // gram, but at most 3/4 of the largest: scanned over all stretch ratios at kappa = 0.)
  if (has_W_FJ) {
    const T gram = algebra::larger(algebra::trace(C) * algebra::trace(G) - 9.0 * X.J * X.J, T{});
    rho_cp2 = rho_cp2 + 2.0 * r.W_FJ * X.J +
              algebra::magnitude(r.W_FJ) * 0.5 * algebra::square_root(gram);
  }
  const double inverse_rho = 1.0 / rho_R;
  return {algebra::square_root(inverse_rho * rho_cp2),
          algebra::square_root(0.5 * inverse_rho * algebra::largest_eigenvalue_bound(K_s))};
}

/// Impedance Z(N) = (rho_R Q(N))^(1/2), closed form  [kg/(m^2 s)].
/// @tparam has_H true: W_FJ = 0, the pressure wave is polarised along h = H N;
///               false: M = 0 and Q = a0 I + rank two.
template <bool has_H, class T>
DIPTYCH_INLINE SymmetricTensor<T> impedance(const Response<T>& r,
                                            const Deformation<T>& X,
                                            double rho_R,
                                            const Vector<T>& N) {
  const T a0 = algebra::quadratic(r.A_tot, N);
  const Vector<T> h = algebra::product(X.H, N);
  SymmetricTensor<T> Z;
  if constexpr (has_H) {
    const SymmetricTensor<T> M = shear_tensor(r, X.F, N);
    const T h2 = algebra::dot(h, h);
    const T tr_M = algebra::trace(M);
    const T m1m2 = algebra::trace(algebra::cofactor(M));
    // plane block B = rho (a0 I + adj M), tr B and det B in the plane
    const T tr_B = rho_R * (2.0 * a0 + tr_M);
    const T det_B = rho_R * rho_R * (a0 * (a0 + tr_M) + m1m2);
    const T root_det = algebra::square_root(det_B);
    const T scale = 1.0 / algebra::square_root(tr_B + 2.0 * root_det);
    const T z_p = algebra::square_root(rho_R * (a0 + tr_M + r.W_JJ * h2));
    const T in_plane = scale * (rho_R * (a0 + tr_M) + root_det);
    const T inverse_h2 = 1.0 / h2;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        const T nn = h[i] * h[j] * inverse_h2;
        Z(i, j) = (z_p - in_plane) * nn - scale * rho_R * M(i, j);
        if (i == j) Z(i, j) += in_plane;
      }
    }
  } else {
    // sqrt(a0 + T) = sqrt(a0) I + alpha T + beta T^2 on the three eigenvalues 0, t1, t2 of T
    const Vector<T> f = algebra::product(X.F, N);
    const RankTwo<T> t = rank_two_eigenvalues(r, f, h);
    const T s0 = algebra::square_root(rho_R * a0);
    const T s1 = algebra::square_root(rho_R * (a0 + t.larger));
    const T s2 = algebra::square_root(rho_R * (a0 + t.smaller));
    const T beta = -1.0 / ((s1 + s2) * (s1 + s0) * (s2 + s0));
    const T alpha = 1.0 / (s1 + s0) - beta * rho_R * t.larger;
    SymmetricTensor<T> R;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        R(i, j) = rho_R * (r.W_JJ * h[i] * h[j] + r.W_FJ * (f[i] * h[j] + h[i] * f[j]));
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        const T R2 = R(i, 0) * R(0, j) + R(i, 1) * R(1, j) + R(i, 2) * R(2, j);
        Z(i, j) = alpha * R(i, j) + beta * R2;
        if (i == j) Z(i, j) += s0;
      }
    }
  }
  return Z;
}

}  // namespace diptych::physics
