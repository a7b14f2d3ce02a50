#pragma once
/// Pointwise updates of v, u, F, H, J of one block of nodes, for the integrators:
///   SSP stage   U <- alpha U_0 + beta (U + dt dU/dt)
///   leapfrog    kick v, drift u, F, H, J with the velocities of the middle of the step.
/// Rates: (18a) as T / (rho_R Omega), (18b) as L, (18c) dH/dt = F x L, (18d) dJ/dt = H : L.

#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/body/stage_combination.hpp"

namespace diptych::scheme {

/// v and u of a stage.
template <int Dim>
void update_motion(Body<Dim>& body,
                   const StageCombination& stage,
                   std::int64_t begin,
                   std::int64_t end);

/// q <- alpha q_0 + beta (q + dt rate), components c.. of q and c_0.. of q_0 of block b, as
/// q_0 + beta (q - q_0 + dt rate): what does not change stays the same to the last bit, and
/// momentum gathers no rounding.
/// @param rate  of component k < n: rate(k)
template <int n, class Storage, class Rate>
DIPTYCH_INLINE void combine(Storage& q,
                            int c,
                            algebra::BlockField& q_0,
                            int c_0,
                            const StageCombination& stage,
                            std::int64_t b,
                            const Rate& rate) {
  Lanes now[n], base[n];
  q.template get_each<n>(b, c,
                         [&](int k, const Lanes& value) DIPTYCH_INLINE_LAMBDA { now[k] = value; });
  if (stage.first) {
    q_0.put_each<n>(b, c_0, [&](int k) DIPTYCH_INLINE_LAMBDA { return now[k]; });
#pragma GCC unroll 9
    for (int k = 0; k < n; ++k)
      base[k] = now[k];
  } else {
    q_0.get_each<n>(b, c_0,
                    [&](int k, const Lanes& value) DIPTYCH_INLINE_LAMBDA { base[k] = value; });
  }
#pragma GCC unroll 9
  for (int k = 0; k < n; ++k) {
    const Lanes change = stage.dt * rate(k);
    now[k] =
        stage.alpha == 0 ? now[k] + change : base[k] + stage.beta * ((now[k] - base[k]) + change);
  }
  q.template put_each<n>(b, c, [&](int k) DIPTYCH_INLINE_LAMBDA { return now[k]; });
}

/// F, H, J of a stage by the L of its beginning. Part of the strain-rate sweep, which needs them
/// next and replaces L: one pass of memory instead of two. The last stage restarts H and J from the
/// new F: their error of a step stays in the step (notes 3.5).
template <int Dim>
DIPTYCH_INLINE void update_deformation_of_block(Body<Dim>& body,
                                                const StageCombination& stage,
                                                std::int64_t b) {
  const Tensor<Lanes> L = velocity_gradient(body, b);
  if (body.options.unknowns != Unknowns::F && !stage.last) {
    const Deformation<Lanes> X = load_deformation(body, b);
    combine<1>(body.J, 0, body.J_0, 0, stage, b,
               [&](int) DIPTYCH_INLINE_LAMBDA { return algebra::contract(X.H, L); });
    if (body.options.unknowns == Unknowns::FHJ) {
      const Tensor<Lanes> rate = algebra::cross(X.F, L);
      combine<Dim * Dim>(body.records, NodeRecord<Dim>::H, body.H_0, 0, stage, b,
                         [&](int k) DIPTYCH_INLINE_LAMBDA { return rate(k / Dim, k % Dim); });
      if constexpr (Dim == 2) {
        combine<1>(body.H_33, 0, body.H_0, 4, stage, b,
                   [&](int) DIPTYCH_INLINE_LAMBDA { return rate(2, 2); });
      }
    }
  }
  if (stage.first && !body.L_0.empty()) put_tensor<Dim>(body.L_0, b, 0, L);
  combine<Dim * Dim>(body.F, 0, body.F_0, 0, stage, b,
                     [&](int k) DIPTYCH_INLINE_LAMBDA { return L(k / Dim, k % Dim); });
  if (body.options.unknowns == Unknowns::F || !stage.last) return;
  const Deformation<Lanes> X = physics::deformation_of(get_tensor<Dim>(body.F, b, 0, 1));
  body.J.put(b, 0, X.J - 1.0);
  if (body.options.unknowns == Unknowns::FHJ) put_H(body, b, X.H);
}

/// v <- v + dt T/(rho_R Omega); keeps F_0 <- F where keep_F is set (start of a step with branches).
template <int Dim>
void kick(Body<Dim>& body, double dt, bool keep_F, std::int64_t begin, std::int64_t end);

/// u <- u + dt v, F <- F + dt L; H and J by the same L: exactly cof F and det F, since H is a
/// quadratic and J a cubic polynomial in time when L is constant.
template <int Dim>
DIPTYCH_INLINE void drift_block(Body<Dim>& body, double dt, std::int64_t b) {
  for (int i = 0; i < Dim; ++i)
    body.u.put(b, i, body.u.get(b, i) + dt * body.v.get(b, i));
  const Tensor<Lanes> L = velocity_gradient(body, b);
  if (body.options.unknowns != Unknowns::F) {
    const Deformation<Lanes> X = load_deformation(body, b);
    const Tensor<Lanes> H_middle = X.H + algebra::cross(X.F + (0.25 * dt) * L, (0.5 * dt) * L);
    const Tensor<Lanes> H_end = X.H + algebra::cross(X.F + (0.5 * dt) * L, dt * L);
    const Tensor<Lanes> H_mean = (1.0 / 6.0) * (X.H + 4.0 * H_middle + H_end);
    body.J.put(b, 0, body.J.get(b, 0) + dt * algebra::contract(H_mean, L));
    if (body.options.unknowns == Unknowns::FHJ) put_H(body, b, H_end);
  }
  put_tensor<Dim>(body.F, b, 0, get_tensor<Dim>(body.F, b, 0) + dt * L);
}

}  // namespace diptych::scheme
