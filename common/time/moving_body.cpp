#include "common/time/moving_body.hpp"

#include "common/base/error.hpp"
#include "common/scheme/body/health.hpp"
#include "common/scheme/budget/angular_momentum.hpp"
#include "common/scheme/ranks/exchange.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::time {

template <int Dim>
double choose_dt(MovingBody<Dim>& moving, double t_limit) {
  Clock& clock = moving.clock;
  const double left = t_limit - clock.time;
  const double stable = moving.sweeps.stable_dt();  // may be no number: then it is kept
  const double bound = clock.largest_dt < stable ? clock.largest_dt : stable;
  const double n = std::ceil(left / bound * (1 - 1e-12));
  double dt = left / std::max(n, 1.0);
  // a load at the end of the step is that of before a jump, which may be a rounding behind it
  while (n <= 1 && clock.time + dt > t_limit)
    dt = std::nextafter(dt, 0);
  if (clock.step == 0) clock.first_dt = bound;
  // what is left before an instant may be as little as one likes
  if (!(bound > clock.least_share * clock.first_dt) || clock.time + dt == clock.time) {
    scheme::gather_state(moving.body);
    throw scheme::collapse_error(moving.body, clock.step + 1, clock.time, dt, clock.first_dt,
                                 clock.least_share);
  }
  return dt;
}

template <int Dim>
scheme::Audit audit_rates(const MovingBody<Dim>& moving) {
  scheme::Audit rate;
  rate.external_work = moving.load_rates.power;
  rate.impulse = {moving.load_rates.force, moving.load_rates.torque};
  rate.numerical_dissipation = moving.sweeps.numerical_power();
  return rate;
}

template <int Dim>
void book(MovingBody<Dim>& moving, const scheme::ConstraintAction& action) {
  moving.audit.impulse.linear += action.impulse.linear;
  moving.audit.impulse.angular += action.impulse.angular;
  moving.audit.external_work += action.work;
  moving.audit.contact_loss += action.caught;
}

template <int Dim>
void keep_angular_momentum(MovingBody<Dim>& moving) {
  if (!moving.keeps_angular_momentum) return;
  const scheme::Projection made = scheme::project_angular_momentum(
      moving.body, moving.initial_angular_momentum + moving.audit.impulse.angular);
  moving.audit.projection_work += made.gain - moving.boundary.withheld(moving.body, made);
  moving.interventions.projections += made.gain != 0 ? 1 : 0;
}

#define DIPTYCH_INSTANTIATE(Dim)                                         \
  template double choose_dt(MovingBody<Dim>&, double);                   \
  template scheme::Audit audit_rates(const MovingBody<Dim>&);            \
  template void book(MovingBody<Dim>&, const scheme::ConstraintAction&); \
  template void keep_angular_momentum(MovingBody<Dim>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::time
