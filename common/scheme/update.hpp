#pragma once
/// Pointwise updates of v, u, F, H, J of one block of nodes, for the integrators:
///   SSP stage   U <- alpha U_0 + beta (U + dt dU/dt)
///   leapfrog    kick v, drift u, F, H, J with the velocities of the middle of the step.
/// Rates: (18a) as T / (rho_R Omega), (18b) as L, (18c) dH/dt = F x L, (18d) dJ/dt = H : L.

#include "common/scheme/pointwise.hpp"
#include "common/scheme/sweep_graph.hpp"

namespace diptych::scheme {

struct StageCombination {
  double alpha = 0, beta = 1;
  double dt = 0;       ///< s
  bool first = false;  ///< U_0 <- U before the update
};

/// v and u of a stage.
template <int Dim>
void update_motion(State<Dim>& state,
                   const SweepGraph<Dim>& graph,
                   double rho_R,
                   const StageCombination& stage,
                   std::int64_t begin,
                   std::int64_t end);

/// alpha q_0 + beta (q + dt rate), component k of block b, as q_0 + beta (q - q_0 + dt rate): what
/// does not change stays the same to the last bit, and momentum gathers no rounding.
DIPTYCH_INLINE Lanes combined(const Lanes& q,
                              algebra::BlockField& q_0,
                              const StageCombination& stage,
                              std::int64_t b,
                              int k,
                              const Lanes& rate) {
  double* old = q_0.block(b) + k * n_lanes;
  if (stage.first) algebra::store(old, q);
  const Lanes base = stage.first ? q : algebra::load(old);
  const Lanes change = stage.dt * rate;
  return stage.alpha == 0 ? q + change : base + stage.beta * ((q - base) + change);
}

/// q <- that.
DIPTYCH_INLINE void combine(algebra::BlockField& q,
                            algebra::BlockField& q_0,
                            const StageCombination& stage,
                            std::int64_t b,
                            int k,
                            const Lanes& rate) {
  double* now = q.block(b) + k * n_lanes;
  algebra::store(now, combined(algebra::load(now), q_0, stage, b, k, rate));
}

/// F, H, J of a stage by the L of its beginning. Part of the strain-rate sweep, which needs them
/// next and replaces L: one pass of memory instead of two.
template <int Dim>
DIPTYCH_INLINE void update_deformation_of_block(State<Dim>& state,
                                                const StageCombination& stage,
                                                std::int64_t b) {
  const Tensor<Lanes> L = velocity_gradient(state, b);
  if (state.unknowns != Unknowns::F) {
    const Deformation<Lanes> X = load_deformation(state, b);
    combine(state.J, state.J_0, stage, b, 0, algebra::contract(X.H, L));
    if (state.unknowns == Unknowns::FHJ) {
      const Tensor<Lanes> rate = algebra::cross(X.F, L);
      Tensor<Lanes> H{};
#pragma GCC unroll 9
      for (int k = 0; k < algebra::Layout<Dim>::n_H; ++k) {
        const int i = Dim == 2 && k == 4 ? 2 : k / Dim, j = Dim == 2 && k == 4 ? 2 : k % Dim;
        H(i, j) = combined(X.H(i, j), state.H_0, stage, b, k, rate(i, j));
      }
      put_H(state, b, H);
    }
  }
#pragma GCC unroll 9
  for (int k = 0; k < Dim * Dim; ++k) {
    const Lanes rate = L(k / Dim, k % Dim);
    if (stage.first && !state.L_0.empty()) algebra::store(state.L_0.block(b) + k * n_lanes, rate);
    combine(state.F, state.F_0, stage, b, k, rate);
  }
}

/// v <- v + dt T/(rho_R Omega); keeps F_0 <- F where keep_F is set (start of a step with branches).
template <int Dim>
void kick(State<Dim>& state,
          const SweepGraph<Dim>& graph,
          double rho_R,
          double dt,
          bool keep_F,
          std::int64_t begin,
          std::int64_t end);

/// u <- u + dt v, F <- F + dt L; H and J by the same L: exactly cof F and det F, since H is a
/// quadratic and J a cubic polynomial in time when L is constant.
template <int Dim>
DIPTYCH_INLINE void drift_block(State<Dim>& state, double dt, std::int64_t b) {
  for (int i = 0; i < Dim; ++i) {
    double* u = state.u.block(b) + i * n_lanes;
    algebra::store(u, algebra::load(u) + dt * state.v.get(b, i));
  }
  const Tensor<Lanes> L = velocity_gradient(state, b);
  if (state.unknowns != Unknowns::F) {
    const Deformation<Lanes> X = load_deformation(state, b);
    const Tensor<Lanes> H_middle = X.H + algebra::cross(X.F + (0.25 * dt) * L, (0.5 * dt) * L);
    const Tensor<Lanes> H_end = X.H + algebra::cross(X.F + (0.5 * dt) * L, dt * L);
    const Tensor<Lanes> H_mean = (1.0 / 6.0) * (X.H + 4.0 * H_middle + H_end);
    algebra::store(state.J.block(b), X.J + dt * algebra::contract(H_mean, L));
    if (state.unknowns == Unknowns::FHJ) put_H(state, b, H_end);
  }
#pragma GCC unroll 9
  for (int k = 0; k < Dim * Dim; ++k) {
    double* F = state.F.block(b) + k * n_lanes;
    algebra::store(F, algebra::load(F) + dt * L(k / Dim, k % Dim));
  }
}

}  // namespace diptych::scheme
