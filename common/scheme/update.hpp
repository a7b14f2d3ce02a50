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

template <int Dim>
void update_stage(State<Dim>& state,
                  const SweepGraph<Dim>& graph,
                  double rho_R,
                  const StageCombination& stage,
                  std::int64_t begin,
                  std::int64_t end);

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
    algebra::store(u, algebra::load(u) + dt * algebra::load(state.v.block(b) + i * n_lanes));
  }
  const Tensor<Lanes> L = algebra::load_tensor<Dim>(state.L.block(b), 0);
  if (state.unknowns != Unknowns::F) {
    const Deformation<Lanes> X = load_deformation(state, b);
    const Tensor<Lanes> H_middle = X.H + algebra::cross(X.F + (0.25 * dt) * L, (0.5 * dt) * L);
    const Tensor<Lanes> H_end = X.H + algebra::cross(X.F + (0.5 * dt) * L, dt * L);
    const Tensor<Lanes> H_mean = (1.0 / 6.0) * (X.H + 4.0 * H_middle + H_end);
    algebra::store(state.J.block(b), X.J + dt * algebra::contract(H_mean, L));
    if (state.unknowns == Unknowns::FHJ) algebra::store_H<Dim>(state.H.block(b), H_end);
  }
  for (int k = 0; k < Dim * Dim; ++k) {
    double* F = state.F.block(b) + k * n_lanes;
    algebra::store(F, algebra::load(F) + dt * L(k / Dim, k % Dim));
  }
}

/// Copies v into the array that the strain-rate sweep gathers from.
template <int Dim>
void publish_velocity(State<Dim>& state, std::int64_t begin, std::int64_t end);

}  // namespace diptych::scheme
