#include "common/scheme/update.hpp"

namespace diptych::scheme {

namespace {

/// q <- alpha q_0 + beta (q + dt rate), component k of block b, as q_0 + beta (q - q_0 + dt rate):
/// what does not change stays the same to the last bit, and momentum gathers no rounding.
DIPTYCH_INLINE void combine(algebra::BlockField& q,
                            algebra::BlockField& q_0,
                            const StageCombination& stage,
                            std::int64_t b,
                            int k,
                            const Lanes& rate) {
  double* now = q.block(b) + k * n_lanes;
  double* old = q_0.block(b) + k * n_lanes;
  const Lanes value = algebra::load(now);
  if (stage.first) algebra::store(old, value);
  const Lanes base = stage.first ? value : algebra::load(old);
  const Lanes change = stage.dt * rate;
  algebra::store(now,
                 stage.alpha == 0 ? value + change : base + stage.beta * ((value - base) + change));
}

/// The components of a cofactor as stored, in order.
template <int Dim>
DIPTYCH_INLINE Lanes component_of_H(const Tensor<Lanes>& H, int k) {
  return Dim == 2 && k == 4 ? H(2, 2) : H(k / Dim, k % Dim);
}

}  // namespace

template <int Dim>
DIPTYCH_CLONES void update_stage(State<Dim>& state,
                                 const SweepGraph<Dim>& graph,
                                 double rho_R,
                                 const StageCombination& stage,
                                 std::int64_t begin,
                                 std::int64_t end) {
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes inverse_mass =
        (1 / rho_R) * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    if (state.unknowns != Unknowns::F) {
      const Deformation<Lanes> X = load_deformation(state, b);
      const Tensor<Lanes> L = algebra::load_tensor<Dim>(state.L.block(b), 0);
      combine(state.J, state.J_0, stage, b, 0, algebra::contract(X.H, L));
      if (state.unknowns == Unknowns::FHJ) {
        const Tensor<Lanes> rate = algebra::cross(X.F, L);
        for (int k = 0; k < algebra::Layout<Dim>::n_H; ++k) {
          combine(state.H, state.H_0, stage, b, k, component_of_H<Dim>(rate, k));
        }
      }
    }
    const double* L = state.L.block(b);
    if (stage.first && !state.L_0.empty()) {
      for (int k = 0; k < Dim * Dim; ++k) {
        algebra::store(state.L_0.block(b) + k * n_lanes, algebra::load(L + k * n_lanes));
      }
    }
    for (int k = 0; k < Dim * Dim; ++k) {
      combine(state.F, state.F_0, stage, b, k, algebra::load(L + k * n_lanes));
    }
    for (int i = 0; i < Dim; ++i) {
      const Lanes v = algebra::load(state.v.block(b) + i * n_lanes);
      combine(state.u, state.u_0, stage, b, i, v);
      const Lanes T = algebra::load(state.T.block(b) + i * n_lanes);
      combine(state.v, state.v_0, stage, b, i, inverse_mass * T);
    }
  }
}

template <int Dim>
DIPTYCH_CLONES void kick(State<Dim>& state,
                         const SweepGraph<Dim>& graph,
                         double rho_R,
                         double dt,
                         bool keep_F,
                         std::int64_t begin,
                         std::int64_t end) {
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes scale = (dt / rho_R) * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int i = 0; i < Dim; ++i) {
      double* v = state.v.block(b) + i * n_lanes;
      algebra::store(v, algebra::load(v) + scale * algebra::load(state.T.block(b) + i * n_lanes));
    }
    if (!keep_F) continue;
    for (int k = 0; k < Dim * Dim; ++k) {
      algebra::store(state.F_0.block(b) + k * n_lanes,
                     algebra::load(state.F.block(b) + k * n_lanes));
    }
  }
}

template <int Dim>
DIPTYCH_CLONES void publish_velocity(State<Dim>& state, std::int64_t begin, std::int64_t end) {
  for (std::int64_t b = begin; b < end; ++b) {
    for (int i = 0; i < Dim; ++i)
      state.velocity.put(b, i, algebra::load(state.v.block(b) + i * n_lanes));
  }
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                   \
  template void update_stage(State<Dim>&, const SweepGraph<Dim>&, double, const StageCombination&, \
                             std::int64_t, std::int64_t);                                          \
  template void kick(State<Dim>&, const SweepGraph<Dim>&, double, double, bool, std::int64_t,      \
                     std::int64_t);                                                                \
  template void publish_velocity(State<Dim>&, std::int64_t, std::int64_t);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
