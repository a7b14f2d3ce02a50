#include "common/time/step_begin.hpp"

#include <string>

namespace diptych::time {

using algebra::BlockField;

namespace {

/// n components of every block of [begin, end).
template <class From, class To>
void copy_components(const From& from,
                     int first,
                     To& to,
                     int first_to,
                     int n,
                     std::int64_t begin,
                     std::int64_t end) {
  for (std::int64_t b = begin; b < end; ++b) {
    for (int c = 0; c < n; ++c)
      to.put(b, first_to + c, from.get(b, first + c));
  }
}

}  // namespace

/// use(unknown, where it is kept)
template <int Dim>
template <class Use>
void StepBegin<Dim>::for_both(const Place& place, scheme::Body<Dim>& body, const Use& use) {
  BlockField& kept = place.own >= 0 ? own_[static_cast<size_t>(place.own)] : body.*place.kept;
  if (place.table != nullptr) {
    use(body.*place.table, kept);
  } else {
    use(body.*place.block, kept);
  }
}

template <int Dim>
StepBegin<Dim>::StepBegin(const MovingBody<Dim>& moving)
    : is_leapfrog_(moving.integrator.is_leapfrog()) {
  list_places(moving);
}

template <int Dim>
void StepBegin<Dim>::list_places(const MovingBody<Dim>& moving) {
  const scheme::Body<Dim>& body = moving.body;
  std::string_view last;
  int offset = 0;
  for (const scheme::Field<Dim>& field : body.fields()) {
    // of the last evaluation: what the next step begins with, and what its budget is made of
    const bool is_force = is_leapfrog_ && (field.name == "T" || field.name == "P" ||
                                           field.name == "plain P" || field.name == "moments");
    if (field.role != scheme::Role::unknown && !is_force) continue;
    offset = field.name == last ? offset : 0;  // H_33 stands behind H in plane
    Place place{field.table, field.block, field.first, field.n_components, nullptr, -1, offset};
    for (const scheme::Field<Dim>& kept : body.fields()) {
      if (kept.role == scheme::Role::step_begin && kept.name == std::string(field.name) + "_0")
        place.kept = kept.block;
    }
    // leapfrog with branches has F_0 for itself
    if (is_leapfrog_ && moving.has_branches() && field.name == "F") place.kept = nullptr;
    if (place.kept == nullptr) {
      place.own = static_cast<int>(own_.size());
      place.first_kept = 0;
      own_.emplace_back(body.n_stored, field.n_components, body.is_single());
    }
    places_.push_back(place);
    offset += field.n_components;
    last = field.name;
  }
}

template <int Dim>
void StepBegin<Dim>::copy(scheme::Body<Dim>& body) {
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
        for (const Place& place : places_) {
          if (place.own < 0 && !is_leapfrog_) continue;
          for_both(place, body, [&](const auto& from, BlockField& to) {
            copy_components(from, place.first, to, place.first_kept, place.n, begin, end);
          });
        }
      });
}

template <int Dim>
void StepBegin<Dim>::put_back(scheme::Body<Dim>& body) {
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
        for (const Place& place : places_) {
          for_both(place, body, [&](auto& to, const BlockField& from) {
            copy_components(from, place.first_kept, to, place.first, place.n, begin, end);
          });
        }
      });
}

template <int Dim>
void StepBegin<Dim>::keep(MovingBody<Dim>& moving, double t_limit) {
  limits_.push_back(t_limit);
  if (is_leapfrog_ && is_kept_ && static_cast<std::int64_t>(limits_.size()) <= period) return;
  limits_.assign(1, t_limit);
  is_kept_ = true;
  copy(moving.body);
  audit_ = moving.audit;
  interventions_ = moving.interventions;
  load_rates_ = moving.load_rates;
  clock_ = moving.clock;
  moving.boundary.keep(boundary_);
  if (is_leapfrog_) results_ = moving.sweeps.results();
}

template <int Dim>
void StepBegin<Dim>::restore(MovingBody<Dim>& moving) {
  put_back(moving.body);
  moving.audit = audit_;
  moving.interventions = interventions_;
  moving.load_rates = load_rates_;
  moving.clock = clock_;
  moving.boundary.restore(boundary_);
  if (!is_leapfrog_) {
    moving.sweeps.strain_rates(moving.body, {}, nullptr, 0);
    return;
  }
  moving.sweeps.set_results(results_);
  moving.sweeps.remember_forces(moving.body);
  if (limits_.size() == 1) return;
  const double t_limit = limits_.back();
  limits_.pop_back();
  for (const double limit : limits_)
    attempt_step(moving, limit);
  is_kept_ = false;  // a second failure of the step must not cost as much
  keep(moving, t_limit);
}

template <int Dim>
void StepBegin<Dim>::shorten(MovingBody<Dim>& moving, double dt) {
  moving.clock.largest_dt = dt;
  clock_.largest_dt = dt;  // for what is stepped again from here
}

template <int Dim>
std::int64_t StepBegin<Dim>::bytes() const {
  std::int64_t sum = 0;
  for (const BlockField& field : own_)
    sum += field.bytes();
  return sum;
}

template <int Dim>
void StepBegin<Dim>::release(const scheme::Blocks& untouched) {
  for (BlockField& field : own_)
    scheme::give_back_blocks(field, untouched);
}

template <int Dim>
double attempt_step(MovingBody<Dim>& moving, double t_limit) {
  Clock& clock = moving.clock;
  const double dt =
      moving.integrator.is_leapfrog() ? leapfrog_step(moving, t_limit) : ssp_step(moving, t_limit);
  if (!is_sound(moving)) return dt;
  clock.time = t_limit - (clock.time + dt) <= 1e-12 * dt ? t_limit : clock.time + dt;
  ++clock.step;
  if (clock.step >= clock.swings_until) clock.largest_dt *= growth_after_rejection;
  return dt;
}

template class StepBegin<2>;
template class StepBegin<3>;
template double attempt_step(MovingBody<2>&, double);
template double attempt_step(MovingBody<3>&, double);

}  // namespace diptych::time
