#include "common/scheme/sweeps/update.hpp"

namespace diptych::scheme {

template <int Dim>
DIPTYCH_CLONES void update_motion(State<Dim>& state,
                                  const SweepGraph<Dim>& graph,
                                  double rho_R,
                                  const StageCombination& stage,
                                  std::int64_t begin,
                                  std::int64_t end) {
  const algebra::FlushToZero flush(state.shape.single);
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes inverse_mass =
        (1 / rho_R) * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    Lanes v[Dim], T[Dim];
    state.v.template get_each<Dim>(
        b, 0, [&](int i, const Lanes& value) DIPTYCH_INLINE_LAMBDA { v[i] = value; });
    state.T.template get_each<Dim>(
        b, 0, [&](int i, const Lanes& value) DIPTYCH_INLINE_LAMBDA { T[i] = value; });
    combine<Dim>(state.u, 0, state.u_0, 0, stage, b,
                 [&](int i) DIPTYCH_INLINE_LAMBDA { return v[i]; });
    combine<Dim>(state.v, 0, state.v_0, 0, stage, b,
                 [&](int i) DIPTYCH_INLINE_LAMBDA { return inverse_mass * T[i]; });
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
  const algebra::FlushToZero flush(state.shape.single);
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes scale = (dt / rho_R) * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int i = 0; i < Dim; ++i)
      state.v.put(b, i, state.v.get(b, i) + scale * state.T.get(b, i));
    if (!keep_F) continue;
    put_tensor<Dim>(state.F_0, b, 0, get_tensor<Dim>(state.F, b, 0));
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
