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

/// The first n of these, which have an entry for each chunk, as their ranks have them.
template <int Dim>
void complete(const Body<Dim>& body, std::initializer_list<std::vector<double>*> arrays, size_t n) {
  body.part().complete(std::span(arrays.begin(), n));
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
      undeformed_speed_(material_->undeformed_speed()),
      viscous_dissipation_(parallel::n_chunks_of(body.n_blocks)),
      old_power_(viscous_dissipation_.size()),
      least_J_(viscous_dissipation_.size()),
      numerical_power_(viscous_dissipation_.size()),
      largest_rate_(viscous_dissipation_.size()),
      limited_pairs_(viscous_dissipation_.size()) {
  if (options.dissipation.reconstruction == Reconstruction::symmetric)
    moments_ = moments_function<Dim>(options.dissipation.impedance, material_->has_H());
}

template <int Dim>
MomentumSweep<Dim> Sweeps<Dim>::momentum_sweep(Body<Dim>& body, bool with_bound) {
  return {body,
          options_.dissipation_factor,
          with_bound,
          numerical_power_.data(),
          largest_rate_.data(),
          limited_pairs_.data()};
}

template <int Dim>
void Sweeps<Dim>::sum_forces(Body<Dim>& body, bool with_step) {
  const Speeds speeds = options_.time_step.speeds;
  if (made_ != (with_step ? Following::forces_and_step : Following::forces)) {
    const auto sweep = momentum_sweep(body, wants_bound(with_step));
    sweep_with(body, {&Body<Dim>::records, &Body<Dim>::frames},
               [&](Share share) { scheme::sum_forces(sweep, momentum_, share); });
    complete(body, {&numerical_power_, &limited_pairs_},
             options_.dissipation.limiter == PairLimiter::none ? 1 : 2);
  }
  made_ = Following::nothing;
  if (body.bulk) {
    body.bulk->evaluate(body, *material_);
    body.bulk->add_forces(body);
  }
  if (body.hourglass) body.hourglass->add_forces(body);
  if (with_step && speeds == Speeds::bound) {
    for_chunks_of(body, Share::whole, [&](auto begin, auto end, auto chunk) {
      largest_rate_[chunk] = geometric_rate_ * largest_speed(body, begin, end);
    });
  }
  if (with_step && speeds != Speeds::linearised) complete(body, {&largest_rate_}, 1);
  if (with_step) stable_dt_ = options_.time_step.limit() / rate();
}

template <int Dim>
void Sweeps<Dim>::remember_forces(Body<Dim>& body) const {
  if (body.bulk) body.bulk->evaluate(body, *material_);
  if (body.hourglass) body.hourglass->evaluate(body);
}

/// See scheme/time_step.hpp  [1/s]
template <int Dim>
double Sweeps<Dim>::rate() const {
  if (options_.time_step.speeds == Speeds::linearised) return geometric_rate_ * undeformed_speed_;
  double rate = 0;
  for (const double r : largest_rate_)
    rate = r >= rate || std::isnan(r) ? r : rate;
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
                                   viscous_dissipation_.data(),
                                   least_J_.data(),
                                   drift != 0 ? old_power_.data() : nullptr};
  made_ = is_one_pass(body) ? following : Following::nothing;
  if (made_ != Following::nothing) {
    sum_stage(body, wants_bound(following == Following::forces_and_step),
              [&](auto begin, auto end, auto chunk) { strain_rates_(sweep, begin, end, chunk); });
    complete(body,
             {&least_J_, &viscous_dissipation_, &numerical_power_, &old_power_, &limited_pairs_},
             options_.dissipation.limiter != PairLimiter::none ? 5
             : drift != 0                                      ? 4
                                                               : 3);
    return;
  }
  if (kappa_f != 0) {
    sweep_with(body, {&Body<Dim>::v}, [&](Share share) {
      for_blocks(body, share, [&](auto begin, auto end) { face_.gradients(body, begin, end); });
    });
  }
  sweep_with(body, {kappa_f != 0 ? &Body<Dim>::gradients : &Body<Dim>::v},
             [&](Share share) { evaluate_strain_rates(sweep, share); });
  complete(body, {&least_J_, &viscous_dissipation_, &old_power_}, drift != 0 ? 3 : 2);
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
double Sweeps<Dim>::numerical_power() const {
  return parallel::sum_in_order(numerical_power_);
}

template <int Dim>
std::int64_t Sweeps<Dim>::limited_pairs() const {
  return std::llround(parallel::sum_in_order(limited_pairs_));
}

template <int Dim>
double Sweeps<Dim>::old_numerical_power(const Body<Dim>& body, double loads) const {
  const double bulk = body.bulk ? body.bulk->power(body) : 0;
  const double hourglass = body.hourglass ? old_hourglass_power_ : 0;
  return loads + bulk + hourglass - parallel::sum_in_order(old_power_);
}

template <int Dim>
double Sweeps<Dim>::viscous_dissipation() const {
  return parallel::sum_in_order(viscous_dissipation_);
}

template <int Dim>
double Sweeps<Dim>::least_J() const {
  double least = 1e300;
  for (const double J : least_J_)
    least = std::isnan(J) ? J : std::isnan(least) ? least : std::min(least, J);
  return least;
}

template <int Dim>
SweepResults Sweeps<Dim>::results() const {
  return {stable_dt_, viscous_dissipation_, least_J_, numerical_power_, largest_rate_};
}

template <int Dim>
void Sweeps<Dim>::set_results(const SweepResults& results) {
  stable_dt_ = results.stable_dt;
  viscous_dissipation_ = results.viscous_dissipation;
  least_J_ = results.least_J;
  numerical_power_ = results.numerical_power;
  largest_rate_ = results.largest_rate;
  made_ = Following::nothing;
}

template class Sweeps<2>;
template class Sweeps<3>;

}  // namespace diptych::scheme
