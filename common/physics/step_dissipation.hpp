#pragma once
/// What the internal variables of a branch dissipate over a whole step, for every dt/tau
/// (notes 6.1). With B = C^-1, M = A - B and psi = C:A - 3 - ln det CA >= 0, W = xi psi,
///   D = xi [ psi^n - psi^(n+1) + int M : C' ds - phi delta ],
/// which is the branch energy that is released at held C and, where C moves, the power of the
/// stress that a relaxed branch would not have. M solves M' = -z M - B' exactly for a B' that is
/// quadratic in s = t/dt. Nothing here is a power at an instant times dt, which is off by orders
/// where tau << dt. The same with G, S and zeta.
/// Conditions: C and A symmetric positive definite at both ends.
/// Test: tests/common/physics/step_dissipation_test.cpp

#include "common/physics/deformation.hpp"

namespace diptych::physics {

/// Weights of int M : C' ds over a step. Rates B' and C' are the series of Legendre polynomials
/// P_0, P_1, P_2 of 2s - 1 with coefficients beta_k, gamma_k.
struct ExcessWeights {
  double start[3] = {1, 0, 0};  ///< int e^(-zs) P_k ds: of M^n : gamma_k
  double lag = 0.5;             ///< of -beta_0 : gamma_0
  double lag_01 = 1.0 / 6;      ///< of -(beta_0 : gamma_1 - beta_1 : gamma_0)
  double lag_11 = 0;            ///< of -beta_1 : gamma_1
};

/// @param z dt/tau >= 0
ExcessWeights excess_weights(double z);

/// C or G, with its inverse B, over a step.
template <class T>
struct MetricPath {
  struct End {
    SymmetricTensor<T> C, inverse, cofactor;
    T det;
  };
  End begin, end;
  SymmetricTensor<T> gamma[3];  ///< C' = sum gamma_k P_k; 1 and 2 are zero where ends have no rates
  SymmetricTensor<T> beta[2];   ///< B' = sum beta_k P_k
  T defect;                     ///< delta = ln det C^(n+1)/C^n - int (B^n + int B') : C' ds
};

/// ln(1 + x), to rounding of x. Series of the inverse hyperbolic tangent where all |x| are below
/// 1/4: |x/(2 + x)|^21/21 < 1e-19.
template <class T>
DIPTYCH_INLINE T log_of_one_plus(const T& x) {
  if (!algebra::all_below(algebra::magnitude(x), 0.25)) return algebra::natural_log_1p(x);
  const T r = x / (2.0 + x), r2 = r * r;
  T sum = T{} + 1.0 / 19;
#pragma GCC unroll 9
  for (int k = 17; k > 0; k -= 2)
    sum = sum * r2 + 1.0 / k;
  return 2.0 * r * sum;
}

/// The three invariants of C X, added, and the first of them, without the identity in C A = I + C M
/// that would take their digits.
template <class T>
struct ProductInvariants {
  T first, sum;
  DIPTYCH_INLINE ProductInvariants(const typename MetricPath<T>::End& C,
                                   const SymmetricTensor<T>& X) {
    const SymmetricTensor<T> cof = algebra::cofactor(X);
    first = algebra::contract(C.C, X);
    sum = first + algebra::contract(C.cofactor, cof) +
          C.det * (X(0, 0) * cof(0, 0) + X(0, 1) * cof(0, 1) + X(0, 2) * cof(0, 2));
  }
};

/// Sets what of a path follows from its ends and from gamma_1, gamma_2, beta_1.
template <class T>
DIPTYCH_INLINE void close_path(MetricPath<T>& path) {
  using algebra::contract;
  path.gamma[0] = path.end.C + (-1.0) * path.begin.C;
  path.beta[0] = path.end.inverse + (-1.0) * path.begin.inverse;
  const typename MetricPath<T>::End inverse{path.begin.inverse, path.begin.C,
                                            (1.0 / path.begin.det) * path.begin.C,
                                            1.0 / path.begin.det};
  const ProductInvariants<T> growth(inverse, path.gamma[0]);
  const ExcessWeights frozen;
  path.defect = (log_of_one_plus(growth.sum) - growth.first) -
                frozen.lag * contract(path.beta[0], path.gamma[0]) -
                frozen.lag_01 *
                    (contract(path.beta[0], path.gamma[1]) - contract(path.beta[1], path.gamma[0]));
}

/// Energy per modulus that goes from a branch over the step, A_begin to A_end  [-]
template <class T>
DIPTYCH_INLINE T released(const ExcessWeights& w,
                          const MetricPath<T>& path,
                          const SymmetricTensor<T>& A_begin,
                          const SymmetricTensor<T>& A_end) {
  using algebra::contract;
  const SymmetricTensor<T> M = A_begin + (-1.0) * path.begin.inverse;
  const ProductInvariants<T> before(path.begin, M);
  const ProductInvariants<T> after(path.end, A_end + (-1.0) * path.end.inverse);
  const T stored =
      (before.first - after.first) + log_of_one_plus((after.sum - before.sum) / (1.0 + before.sum));
  const T moved =
      contract(
          M, w.start[0] * path.gamma[0] + w.start[1] * path.gamma[1] + w.start[2] * path.gamma[2]) -
      (w.lag * contract(path.beta[0], path.gamma[0]) +
       w.lag_01 * (contract(path.beta[0], path.gamma[1]) - contract(path.beta[1], path.gamma[0])) +
       w.lag_11 * contract(path.beta[1], path.gamma[1]));
  return stored + moved - w.start[0] * path.defect;
}

/// C over a step, and G = cof C where has_H.
template <class T>
struct StepPaths {
  MetricPath<T> C, G;
};

/// From F at both ends and, with_rates, dt dF/dt there: third order; without, second.
template <bool has_H, class T>
DIPTYCH_INLINE StepPaths<T> step_paths(const RightTensors<T>& begin,
                                       const RightTensors<T>& end,
                                       bool with_rates,
                                       const Tensor<T>& F_begin,
                                       const Tensor<T>& rate_begin,
                                       const Tensor<T>& F_end,
                                       const Tensor<T>& rate_end) {
  using algebra::contract;
  const auto det = [](const RightTensors<T>& X) DIPTYCH_INLINE_LAMBDA {
    return X.C(0, 0) * X.G(0, 0) + X.C(0, 1) * X.G(0, 1) + X.C(0, 2) * X.G(0, 2);
  };
  StepPaths<T> paths;
  const auto straight = [](MetricPath<T>& path) DIPTYCH_INLINE_LAMBDA {
    path.gamma[1] = path.gamma[2] = path.beta[1] = SymmetricTensor<T>{};
  };
  straight(paths.C);
  if constexpr (has_H) {
    straight(paths.G);
  } else {
    paths.G = MetricPath<T>{};
  }
  const T det_0 = det(begin), det_1 = det(end);
  paths.C.begin = {begin.C, begin.inverse_C, begin.G, det_0};
  paths.C.end = {end.C, end.inverse_C, end.G, det_1};
  if constexpr (has_H) {
    paths.G.begin = {begin.G, begin.inverse_G, det_0 * begin.C, det_0 * det_0};
    paths.G.end = {end.G, end.inverse_G, det_1 * end.C, det_1 * det_1};
  }
  if (with_rates) {
    // (ln det C)' = B : C';  B = G/det C and G^-1 = C/det C
    const auto of_C = [](const Tensor<T>& F, const Tensor<T>& rate) DIPTYCH_INLINE_LAMBDA {
      SymmetricTensor<T> C;
      for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
          C(i, j) = T{};
          for (int k = 0; k < 3; ++k)
            C(i, j) += F(k, i) * rate(k, j) + rate(k, i) * F(k, j);
        }
      }
      return C;
    };
    const auto C_0 = of_C(F_begin, rate_begin), C_1 = of_C(F_end, rate_end);
    const auto G_0 = algebra::cross(begin.C, C_0), G_1 = algebra::cross(end.C, C_1);
    const T log_0 = contract(begin.inverse_C, C_0), log_1 = contract(end.inverse_C, C_1);
    const T share_0 = 1.0 / det_0, share_1 = 1.0 / det_1;
    const auto expand = [](MetricPath<T>& path, const SymmetricTensor<T>& first,
                           const SymmetricTensor<T>& last, const SymmetricTensor<T>& inverse_first,
                           const SymmetricTensor<T>& inverse_last) DIPTYCH_INLINE_LAMBDA {
      path.gamma[1] = 0.5 * (last + (-1.0) * first);
      path.gamma[2] = 0.5 * (first + last) + (-1.0) * (path.end.C + (-1.0) * path.begin.C);
      path.beta[1] = 0.5 * (inverse_last + (-1.0) * inverse_first);
    };
    expand(paths.C, C_0, C_1, share_0 * G_0 + (-log_0) * begin.inverse_C,
           share_1 * G_1 + (-log_1) * end.inverse_C);
    if constexpr (has_H) {
      expand(paths.G, G_0, G_1, share_0 * C_0 + (-log_0) * begin.inverse_G,
             share_1 * C_1 + (-log_1) * end.inverse_G);
    }
  }
  close_path(paths.C);
  if constexpr (has_H) close_path(paths.G);
  return paths;
}

}  // namespace diptych::physics
