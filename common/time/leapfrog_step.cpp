/// A step of leapfrog in its kick-drift-kick form (notes 5.6): one evaluation a step.

#include "common/scheme/sweeps/update.hpp"
#include "common/time/step_begin.hpp"
#include "common/time/swing.hpp"

namespace diptych::time {

namespace {

template <int Dim>
void kick(scheme::Body<Dim>& body, double dt, bool keep_F) {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         scheme::kick(body, dt, keep_F, begin, end);
                       });
}

}  // namespace

template <int Dim>
void begin_leapfrog(MovingBody<Dim>& moving) {
  moving.sweeps.sum_forces(moving.body, true);
  moving.load_rates = moving.boundary.add_loads(moving.body, moving.clock.time);
}

template <int Dim>
double leapfrog_step(MovingBody<Dim>& moving, double t_limit) {
  using Rule = scheme::Relaxation::Rule;
  auto& [body, sweeps, boundary, integrator, keeps, audit, load_rates, L_0, clock, acts] = moving;
  limit_swing(moving);
  const double dt = choose_dt(moving, t_limit), t = clock.time;
  boundary.begin_step(t, dt);
  scheme::Audit rate;
  // a load works on the mean of the velocities before and after its kick (notes 5.7)
  const double quarter = dt / 4;
  rate.external_work = -0.5 * quarter * boundary.power_gain_of_loads(body);
  kick(body, dt / 2, moving.has_branches());
  rate.impulse = {0.5 * load_rates.force, 0.5 * load_rates.torque};
  book(moving, boundary.constrain(body, t + dt / 2));
  const double old_loads = boundary.power_of_loads(body);
  rate.external_work += 0.5 * old_loads;
  rate.external_work += 0.5 * boundary.power_against_forces(body);
  const Rule rule = moving.has_branches() ? Rule::linear : Rule::frozen;
  sweeps.strain_rates(body, {rule, true, dt, sweeps.material().branches()}, nullptr, dt,
                      scheme::Following::forces_and_step);
  if (!is_sound(moving)) return dt;
  // D_ab kicks twice, after it is summed and before: of one kick alone the budget is off by its lag
  rate.numerical_dissipation = 0.5 * sweeps.old_numerical_power(body, old_loads);
  sweeps.sum_forces(body, true);
  acts.limited_pairs += sweeps.limited_pairs();
  load_rates = boundary.add_loads(body, t + dt);
  rate.external_work += 0.5 * (load_rates.power + quarter * boundary.power_gain_of_loads(body));
  // the same velocities against the forces of the end: the trapezoid, of second order
  rate.external_work += 0.5 * boundary.power_against_forces(body);
  rate.impulse.linear += 0.5 * load_rates.force;
  rate.impulse.angular += 0.5 * load_rates.torque;
  rate.numerical_dissipation += 0.5 * sweeps.numerical_power();
  kick(body, dt / 2, false);
  audit = audit.combined(0, audit, 1, dt, rate);
  audit.viscous_dissipation += sweeps.viscous_dissipation();
  keep_angular_momentum(moving);
  book(moving, boundary.constrain(body, t + dt));
  return dt;
}

template void begin_leapfrog(MovingBody<2>&);
template void begin_leapfrog(MovingBody<3>&);
template double leapfrog_step(MovingBody<2>&, double);
template double leapfrog_step(MovingBody<3>&, double);

}  // namespace diptych::time
