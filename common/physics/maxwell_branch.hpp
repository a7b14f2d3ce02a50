#pragma once
/// A Maxwell branch (5), (6) with internal variables A = C_v^-1 and S = G_v^-1:
///   W^a = xi^a (C:A - 3 - 2 ln J - ln det A) + zeta^a (G:S - 3 - 4 ln J - ln det S),
/// its conjugate stresses (11), and its dissipation (12) with (13) corrected (notes 1.1):
///   Sigma_A = xi^a (C - A^-1), Sigma_S = zeta^a (G - S^-1),
///   D = xi^a/tau_C [tr(CA) + tr((CA)^-1) - 6] + zeta^a/tau_G [tr(GS) + tr((GS)^-1) - 6] >= 0.
/// Conditions: tau > 0, xi^a >= 0, zeta^a >= 0, A and S symmetric positive definite.

#include "common/physics/response.hpp"

namespace diptych::physics {

struct MaxwellBranch {
  double xi = 0;     ///< Pa, xi^a = beta_C xi
  double tau_C = 1;  ///< s
  double zeta = 0;   ///< Pa, zeta^a = beta_G zeta
  double tau_G = 1;  ///< s
};

template <class T>
struct BranchState {
  SymmetricTensor<T> A;  ///< C_v^-1
  SymmetricTensor<T> S;  ///< G_v^-1
};

/// Adds the branch's conjugate stresses (11) and acoustic coefficients.
template <bool has_H, class T>
DIPTYCH_INLINE void add_branch_response(const MaxwellBranch& branch,
                                        const BranchState<T>& state,
                                        const Deformation<T>& X,
                                        Response<T>& r) {
  const double b = 2.0 * (branch.xi + (has_H ? 2.0 * branch.zeta : 0.0));
  const T inverse_J = 1.0 / X.J;
  r.Sigma_F = r.Sigma_F + (2.0 * branch.xi) * algebra::product(X.F, state.A);
  r.A_tot = r.A_tot + (2.0 * branch.xi) * state.A;
  r.Sigma_J -= b * inverse_J;
  r.W_JJ += b * inverse_J * inverse_J;
  if constexpr (has_H) {
    r.Sigma_H = r.Sigma_H + (2.0 * branch.zeta) * algebra::product(X.H, state.S);
    r.S_tot = r.S_tot + (2.0 * branch.zeta) * state.S;
  }
}

/// Branch energy density (6)  [Pa]
template <bool has_H, class T>
DIPTYCH_INLINE T branch_energy(const MaxwellBranch& branch,
                               const BranchState<T>& state,
                               const Deformation<T>& X) {
  const T ln_J = algebra::natural_log(X.J);
  const auto C = algebra::transpose_times_self(X.F);
  T W = branch.xi * (algebra::contract(C, state.A) - 3.0 - 2.0 * ln_J -
                     algebra::natural_log(algebra::determinant(state.A)));
  if constexpr (has_H) {
    const auto G = algebra::transpose_times_self(X.H);
    W += branch.zeta * (algebra::contract(G, state.S) - 3.0 - 4.0 * ln_J -
                        algebra::natural_log(algebra::determinant(state.S)));
  }
  return W;
}

/// tr(CA) + tr((CA)^-1) - 6, >= 0, as (C - A^-1) : (A - C^-1): a product of two small tensors,
/// where the sum would leave only the rounding of its three terms at small strains.
/// @param  C, A  symmetric positive definite
template <class T>
DIPTYCH_INLINE T distance_from_equilibrium(const SymmetricTensor<T>& C,
                                           const SymmetricTensor<T>& inverse_C,
                                           const SymmetricTensor<T>& A) {
  const SymmetricTensor<T> inverse_A = algebra::inverse(A);
  return algebra::contract(C + (-1.0) * inverse_A, A + (-1.0) * inverse_C);
}

/// Dissipation (12) of the branch with (13) corrected  [W/m^3], >= 0. C and G are those that A and
/// S relax to, from F alone: an evolved H off by d from cof F would add d^2/tau.
template <bool has_H, class T>
DIPTYCH_INLINE T branch_dissipation(const MaxwellBranch& branch,
                                    const BranchState<T>& state,
                                    const RightTensors<T>& X) {
  T D = (branch.xi / branch.tau_C) * distance_from_equilibrium(X.C, X.inverse_C, state.A);
  if constexpr (has_H) {
    D += (branch.zeta / branch.tau_G) * distance_from_equilibrium(X.G, X.inverse_G, state.S);
  }
  return D;
}

}  // namespace diptych::physics
