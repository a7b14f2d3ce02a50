#include "common/time/swing.hpp"

#include "common/parallel/reduction.hpp"
#include "common/scheme/body/node_chunks.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::time {

template <int Dim>
double squared_accelerations(const scheme::Body<Dim>& body,
                             const scheme::AppliedBoundary& boundary) {
  std::vector<double> parts(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
        algebra::Lanes sum{};
        for (std::int64_t b = begin; b < end; ++b) {
          algebra::Lanes T2{};
          body.T.template get_each<Dim>(
              b, 0, [&](int, const algebra::Lanes& T) DIPTYCH_INLINE_LAMBDA { T2 = T2 + T * T; });
          sum = sum + T2 * algebra::load(body.graph.inverse_Omega.data() + b * algebra::n_lanes);
        }
        parts[static_cast<size_t>(chunk)] = algebra::lane_sum(sum) / body.options.rho_R;
      });
  return std::max(0.0,
                  parallel::sum_of_chunks(body.part(), parts) - boundary.squared_reactions(body));
}

namespace {

/// The largest step whose swing is within bounds, by the energy that there was and what has been
/// done on the body since  [s]
template <int Dim>
double allowed_dt(const MovingBody<Dim>& moving) {
  const Clock& clock = moving.clock;
  const double energy =
      clock.swing_energy + std::abs(moving.audit.external_work - clock.swing_work);
  const double sum = squared_accelerations(moving.body, moving.boundary);
  return std::max(std::sqrt(8 * clock.swing_share * energy / sum),
                  least_part_of_step * moving.sweeps.stable_dt());
}

}  // namespace

template <int Dim>
double swing_of(const MovingBody<Dim>& moving) {
  const double dt = std::min(moving.clock.largest_dt, moving.sweeps.stable_dt());
  const double sum = squared_accelerations(moving.body, moving.boundary) -
                     moving.boundary.power_gain_of_loads(moving.body);
  const double swing = dt * dt / 8 * sum;
  return std::isfinite(swing) ? swing : 0;
}

template <int Dim>
void limit_swing(MovingBody<Dim>& moving) {
  Clock& clock = moving.clock;
  if (clock.step >= clock.swings_until) return;
  const double allowed = allowed_dt(moving);
  if (!(allowed < moving.sweeps.stable_dt())) return;
  clock.largest_dt = std::min(clock.largest_dt, allowed);
  clock.swings_until = clock.step + steps_of_swing;
}

template <int Dim>
double shorter_for_swing(const MovingBody<Dim>& moving, double dt) {
  constexpr double least_share = 0.25, rounding = 1e-12;
  if (moving.clock.step > moving.clock.swings_until) return 0;
  const double allowed = allowed_dt(moving);
  return dt > allowed * (1 + rounding) ? std::max(allowed, least_share * dt) : 0;
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                   \
  template double squared_accelerations(const scheme::Body<Dim>&, const scheme::AppliedBoundary&); \
  template double swing_of(const MovingBody<Dim>&);                                                \
  template void limit_swing(MovingBody<Dim>&);                                                     \
  template double shorter_for_swing(const MovingBody<Dim>&, double);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::time
