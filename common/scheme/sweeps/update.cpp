#include "common/scheme/sweeps/update.hpp"

namespace diptych::scheme {

template <int Dim>
DIPTYCH_CLONES void update_motion(Body<Dim>& body,
                                  const StageCombination& stage,
                                  std::int64_t begin,
                                  std::int64_t end) {
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes inverse_mass =
        (1 / body.options.rho_R) * algebra::load(body.graph.inverse_Omega.data() + b * n_lanes);
    Lanes v[Dim], T[Dim];
    body.v.template get_each<Dim>(
        b, 0, [&](int i, const Lanes& value) DIPTYCH_INLINE_LAMBDA { v[i] = value; });
    body.T.template get_each<Dim>(
        b, 0, [&](int i, const Lanes& value) DIPTYCH_INLINE_LAMBDA { T[i] = value; });
    combine<Dim>(body.u, 0, body.u_0, 0, stage, b,
                 [&](int i) DIPTYCH_INLINE_LAMBDA { return v[i]; });
    combine<Dim>(body.v, 0, body.v_0, 0, stage, b,
                 [&](int i) DIPTYCH_INLINE_LAMBDA { return inverse_mass * T[i]; });
  }
}

template <int Dim>
DIPTYCH_CLONES void kick(
    Body<Dim>& body, double dt, bool keep_F, std::int64_t begin, std::int64_t end) {
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes scale =
        (dt / body.options.rho_R) * algebra::load(body.graph.inverse_Omega.data() + b * n_lanes);
    for (int i = 0; i < Dim; ++i)
      body.v.put(b, i, body.v.get(b, i) + scale * body.T.get(b, i));
    if (!keep_F) continue;
    put_tensor<Dim>(body.F_0, b, 0, get_tensor<Dim>(body.F, b, 0));
  }
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                \
  template void update_motion(Body<Dim>&, const StageCombination&, std::int64_t, std::int64_t); \
  template void kick(Body<Dim>&, double, bool, std::int64_t, std::int64_t);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
