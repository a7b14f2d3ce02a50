/// A step of the strong-stability-preserving Runge-Kutta schemes in the form of Shu and Osher
/// (J. Comput. Phys. 77, 1988): coefficients in schemes/, each with its source.

#include "common/scheme/sweeps/update.hpp"
#include "common/time/step_begin.hpp"

namespace diptych::time {

namespace {

template <int Dim>
void combine_motion(scheme::Body<Dim>& body, const scheme::StageCombination& stage) {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         scheme::update_motion(body, stage, begin, end);
                       });
}

/// How the internal variables follow at the end of a stage (notes 5.2, 5.3).
template <int Dim>
scheme::Relaxation relaxation_of(const MovingBody<Dim>& moving, double elapsed, bool last) {
  using Rule = scheme::Relaxation::Rule;
  const Rule rule = !moving.has_branches()                       ? Rule::frozen
                    : last && moving.integrator.gauss_relaxation ? Rule::gauss
                                                                 : Rule::linear;
  return {rule, last, elapsed, moving.sweeps.material().branches()};
}

}  // namespace

template <int Dim>
double ssp_step(MovingBody<Dim>& moving, double t_limit) {
  auto& [body, sweeps, boundary, integrator, keeps, audit, load_rates, L_0, clock, acts] = moving;
  const scheme::Audit audit_0 = audit;
  const size_t n_stages = integrator.stages.size();
  double dt = 0, fraction = 0;  // of the step that has passed when a stage begins
  const auto combination = [&](size_t i) -> scheme::StageCombination {
    const SspStage& stage = moving.integrator.stages[i];
    return {stage.alpha, stage.beta, stage.part * dt, i == 0, i + 1 == n_stages};
  };
  for (size_t i = 0; i < n_stages; ++i) {
    const SspStage& now = integrator.stages[i];
    const bool first = i == 0, last = i + 1 == n_stages;
    sweeps.sum_forces(body, first);  // (18a) + D_ab, step bound
    acts.limited_pairs += sweeps.limited_pairs();
    if (first) {
      dt = choose_dt(moving, t_limit);
      boundary.begin_step(clock.time, dt);
    }
    load_rates = boundary.add_loads(body, clock.time + fraction * dt);
    scheme::Audit rate = audit_rates(moving);
    rate.external_work += boundary.power_against_forces(body);
    const scheme::StageCombination stage = combination(i);
    audit = audit.combined(stage.alpha, audit_0, stage.beta, stage.dt, rate);
    combine_motion(body, stage);
    audit.impulse.angular += boundary.lag_of_moment(body, stage, fraction);
    if (last) keep_angular_momentum(moving);
    book(moving, last ? boundary.constrain(body, clock.time + now.time * dt)
                      : boundary.constrain_stage(body, stage, combination(i + 1), fraction));
    // (18b-d); what comes between two steps may need the forces of the one that ends
    sweeps.strain_rates(body, relaxation_of(moving, now.time * dt, last), &stage, 0,
                        last ? scheme::Following::nothing : scheme::Following::forces);
    if (!is_sound(moving)) break;
    fraction = now.time;
  }
  audit.viscous_dissipation += sweeps.viscous_dissipation();
  acts.resynchronisations += body.options.unknowns != scheme::Unknowns::F ? 1 : 0;
  return dt;
}

template double ssp_step(MovingBody<2>&, double);
template double ssp_step(MovingBody<3>&, double);

}  // namespace diptych::time
