#include "common/scheme/sweeps/sweeps.hpp"

#include "common/scheme/ranks/exchange.hpp"
#include "common/scheme/sweeps/frames.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::scheme {

namespace {

template <int Dim, class Work>
void for_blocks(const Body<Dim>& body, Share share, const Work& work) {
  for_chunks_of(body, share,
                [&](std::int64_t begin, std::int64_t end, std::int64_t) { work(begin, end); });
}

}  // namespace

template <int Dim>
Sweeps<Dim>::Sweeps(const Body<Dim>& body,
                    std::shared_ptr<const MaterialModel> material,
                    const SweepOptions& options,
                    double geometric_rate)
    : material_(std::move(material)),
      options_(options),
      momentum_(momentum_function<Dim>(options.dissipation, material_->has_H())),
      strain_rates_(strain_rate_function<Dim>()),
      face_(face_correction_sweeps<Dim>()),
      geometric_rate_(geometric_rate),
      undeformed_speed_(material_->undeformed_speed()) {
  const std::vector<double> none(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  of_chunks_ = {none, none, none, none, none, none};
  if (options.dissipation.reconstruction == Reconstruction::symmetric)
    moments_ = moments_function<Dim>(options.dissipation.impedance, material_->has_H());
}

template <int Dim>
MomentumSweep<Dim> Sweeps<Dim>::momentum_sweep(Body<Dim>& body, bool with_bound) {
  return {body,
          options_.dissipation_factor,
          with_bound,
          of_chunks_.numerical_power.data(),
          of_chunks_.largest_rate.data(),
          of_chunks_.limited_pairs.data()};
}

template <int Dim>
void Sweeps<Dim>::sum_forces(Body<Dim>& body, bool with_step) {
  const Speeds speeds = options_.time_step.speeds;
  if (made_ != (with_step ? Following::forces_and_step : Following::forces)) {
    const auto sweep = momentum_sweep(body, wants_bound(with_step));
    sweep_with(body, {&Body<Dim>::records, &Body<Dim>::frames},
               [&](Share share) { scheme::sum_forces(sweep, momentum_, share); });
    parallel::Reduction reduction(body.part());
    sum_of_forces(reduction);
    reduction.finish();
  }
  made_ = Following::nothing;
  if (body.bulk) {
    body.bulk->evaluate(body, *material_);
    body.bulk->add_forces(body);
  }
  if (body.hourglass) body.hourglass->add_forces(body);
  if (with_step && speeds == Speeds::bound) {
    for_chunks_of(body, Share::whole, [&](auto begin, auto end, auto chunk) {
      of_chunks_.largest_rate[static_cast<size_t>(chunk)] =
          geometric_rate_ * largest_speed(body, begin, end);
    });
  }
  if (with_step) results_.stable_dt = options_.time_step.limit() / largest_rate(body);
}

/// What is added up of the forces.
template <int Dim>
void Sweeps<Dim>::sum_of_forces(parallel::Reduction& reduction) {
  reduction.sum(of_chunks_.numerical_power, results_.numerical_power);
  if (options_.dissipation.limiter != PairLimiter::none)
    reduction.sum(of_chunks_.limited_pairs, limited_pairs_);
}

/// The same of the strain rates.
template <int Dim>
void Sweeps<Dim>::sum_of_strain_rates(parallel::Reduction& reduction, bool with_old_power) {
  reduction.least(of_chunks_.least_J, results_.least_J);
  reduction.sum(of_chunks_.viscous_dissipation, results_.viscous_dissipation);
  if (with_old_power) reduction.sum(of_chunks_.old_power, old_power_);
}

template <int Dim>
void Sweeps<Dim>::remember_forces(Body<Dim>& body) const {
  if (body.bulk) body.bulk->evaluate(body, *material_);
  if (body.hourglass) body.hourglass->evaluate(body);
}

/// See scheme/time_step.hpp; NaN where a node has none  [1/s]
template <int Dim>
double Sweeps<Dim>::largest_rate(const Body<Dim>& body) const {
  if (options_.time_step.speeds == Speeds::linearised) return geometric_rate_ * undeformed_speed_;
  double rate = 0;
  parallel::Reduction reduction(body.part());
  reduction.largest(of_chunks_.largest_rate, rate);
  reduction.finish();
  return rate;
}

/// Whether forces can follow strain rates chunk by chunk: where no other pass changes the records.
template <int Dim>
bool Sweeps<Dim>::is_one_pass(const Body<Dim>& body) const {
  return body.in_runs() && options_.face_correction == 0 && !body.options.has_frames &&
         moments_ == nullptr;
}

template <int Dim>
void Sweeps<Dim>::sum_stage(Body<Dim>& body, bool with_bound, const MakeRecords& make_records) {
  const MomentumSweep<Dim> forces = momentum_sweep(body, with_bound);
  if (!body.division) {
    sum_forces_of_stage(forces, momentum_, make_records);
    return;
  }
  const auto work = [&](StageShare share) {
    sum_forces_of_stage(forces, momentum_, make_records, share);
  };
  while_bringing(body, {&Body<Dim>::v}, [&] { work(StageShare::secluded); });
  work(StageShare::border);
  while_bringing(body, {&Body<Dim>::records}, [&] { work(StageShare::inner); });
  work(StageShare::outer);
}

template <int Dim>
void Sweeps<Dim>::strain_rates(Body<Dim>& body,
                               const Relaxation& relaxation,
                               const StageCombination* stage,
                               double drift,
                               Following following) {
  const double kappa_f = options_.face_correction;
  const StrainRateSweep<Dim> sweep{body,
                                   *material_,
                                   relaxation,
                                   kappa_f,
                                   stage,
                                   drift,
                                   of_chunks_.viscous_dissipation.data(),
                                   of_chunks_.least_J.data(),
                                   drift != 0 ? of_chunks_.old_power.data() : nullptr};
  parallel::Reduction reduction(body.part());
  made_ = is_one_pass(body) ? following : Following::nothing;
  if (made_ != Following::nothing) {
    sum_stage(body, wants_bound(following == Following::forces_and_step),
              [&](auto begin, auto end, auto chunk) { strain_rates_(sweep, begin, end, chunk); });
    sum_of_strain_rates(reduction, drift != 0);
    sum_of_forces(reduction);
    reduction.finish();
    return;
  }
  if (kappa_f != 0) {
    sweep_with(body, {&Body<Dim>::v}, [&](Share share) {
      for_blocks(body, share, [&](auto begin, auto end) { face_.gradients(body, begin, end); });
    });
  }
  sweep_with(body, {kappa_f != 0 ? &Body<Dim>::gradients : &Body<Dim>::v},
             [&](Share share) { evaluate_strain_rates(sweep, share); });
  sum_of_strain_rates(reduction, drift != 0);
  reduction.finish();
  if (kappa_f != 0) {
    sweep_with(body, {&Body<Dim>::stresses}, [&](Share share) {
      for_blocks(body, share,
                 [&](auto begin, auto end) { face_.stresses(body, kappa_f, begin, end); });
    });
  }
  if (body.options.has_frames)
    for_blocks(body, Share::whole, [&](auto begin, auto end) { set_frames(body, begin, end); });
  if (moments_ == nullptr) return;
  if (body.hourglass) {
    old_hourglass_power_ = drift != 0 ? body.hourglass->power(body) : 0;
    body.hourglass->evaluate(body);
  }
  sweep_with(body, {&Body<Dim>::records},
             [&](Share share) { sum_moments(momentum_sweep(body, false), moments_, share); });
  if (body.hourglass) body.hourglass->add_moments(body);
  take_moments(body);
}

template <int Dim>
std::int64_t Sweeps<Dim>::limited_pairs() const {
  return std::llround(limited_pairs_);
}

template <int Dim>
double Sweeps<Dim>::old_numerical_power(const Body<Dim>& body, double loads) const {
  const double bulk = body.bulk ? body.bulk->power(body) : 0;
  const double hourglass = body.hourglass ? old_hourglass_power_ : 0;
  return loads + bulk + hourglass - old_power_;
}

template <int Dim>
void Sweeps<Dim>::set_results(const SweepResults& results) {
  results_ = results;
  made_ = Following::nothing;
}

template class Sweeps<2>;
template class Sweeps<3>;

}  // namespace diptych::scheme
