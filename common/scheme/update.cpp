#include "common/scheme/update.hpp"

namespace diptych::scheme {

template <int Dim>
DIPTYCH_CLONES void update_motion(State<Dim>& state,
                                  const SweepGraph<Dim>& graph,
                                  double rho_R,
                                  const StageCombination& stage,
                                  std::int64_t begin,
                                  std::int64_t end) {
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes inverse_mass =
        (1 / rho_R) * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int i = 0; i < Dim; ++i) {
      const Lanes v = state.v.get(b, i);
      combine(state.u, state.u_0, stage, b, i, v);
      state.v.put(b, i, combined(v, state.v_0, stage, b, i, inverse_mass * state.T.get(b, i)));
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
    for (int i = 0; i < Dim; ++i)
      state.v.put(b, i, state.v.get(b, i) + scale * state.T.get(b, i));
    if (!keep_F) continue;
    for (int k = 0; k < Dim * Dim; ++k) {
      algebra::store(state.F_0.block(b) + k * n_lanes,
                     algebra::load(state.F.block(b) + k * n_lanes));
    }
  }
}

#define DIPTYCH_INSTANTIATE(Dim)                                                              \
  template void update_motion(State<Dim>&, const SweepGraph<Dim>&, double,                    \
                              const StageCombination&, std::int64_t, std::int64_t);           \
  template void kick(State<Dim>&, const SweepGraph<Dim>&, double, double, bool, std::int64_t, \
                     std::int64_t);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
