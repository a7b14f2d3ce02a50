#include "common/time/moving_body_archive.hpp"

#include "common/scheme/body/body_archive.hpp"
#include "common/scheme/ranks/division.hpp"

#include <string>

namespace diptych::time {

namespace {

using algebra::Archive;

/// Rows: the copy of v that ends a record, which the table of fields does not list.
template <int Dim>
void copy_velocities(scheme::Body<Dim>& body) {
  const int first = scheme::NodeRecord<Dim>::v(body.options.exact_impedance);
  const scheme::Blocks untouched = body.division ? body.division->untouched.read : scheme::Blocks();
  scheme::for_touched(untouched, 0, body.n_stored, [&](std::int64_t a) {
    for (int i = 0; i < Dim; ++i)
      body.records.set(a, first + i, body.v.at(a, i));
  });
}

template <int Dim>
void archive_body(MovingBody<Dim>& moving, Archive& archive) {
  using scheme::Role;
  scheme::Body<Dim>& body = moving.body;
  scheme::archive_fields(body, Role::unknown, archive);
  scheme::archive_fields(body, Role::derived, archive);
  if (archive.is_loading() && !body.in_runs()) copy_velocities(body);
  scheme::archive_fields(body, Role::accumulated, archive);
}

void archive_clock(Clock& clock, Archive& archive) {
  archive.real("clock/time", "s", clock.time);
  archive.integer("clock/step", clock.step);
  archive.real("clock/first dt", "s", clock.first_dt);
  archive.real("clock/largest dt", "s", clock.largest_dt);
  archive.real("clock/swing share", "-", clock.swing_share);
  archive.real("clock/swing energy", "J", clock.swing_energy);
  archive.real("clock/swing work", "J", clock.swing_work);
  archive.integer("clock/swings until", clock.swings_until);
}

void archive_audit(scheme::Audit& audit, Archive& archive) {
  archive.real("audit/external work", "J", audit.external_work);
  archive.real("audit/numerical dissipation", "J", audit.numerical_dissipation);
  archive.real("audit/viscous dissipation", "J", audit.viscous_dissipation);
  archive.real("audit/contact loss", "J", audit.contact_loss);
  archive.real("audit/projection work", "J", audit.projection_work);
  archive.vector("audit/linear impulse", "N s", audit.impulse.linear);
  archive.vector("audit/angular impulse", "N m s", audit.impulse.angular);
}

void archive_interventions(scheme::Interventions& acts, Archive& archive) {
  archive.integer("interventions/projections", acts.projections);
  archive.integer("interventions/resynchronisations", acts.resynchronisations);
  archive.integer("interventions/limited pairs", acts.limited_pairs);
}

void archive_loads(scheme::LoadRates& rates, Archive& archive) {
  archive.real("loads/power", "W", rates.power);
  archive.vector("loads/force", "N", rates.force);
  archive.vector("loads/torque", "N m", rates.torque);
}

/// Vectors that are as many as those of a boundary that was just made, or none yet.
void archive_boundary(scheme::AppliedBoundary& boundary, Archive& archive) {
  scheme::BoundaryState state;
  boundary.keep(state);
  state.in_step.archive(archive);
  const auto n_targets = static_cast<std::int64_t>(state.target.size());
  archive.vectors("boundary/target", "m/s", state.target, n_targets);
  const auto n_forces = static_cast<std::int64_t>(state.forces.size());
  archive.vectors("boundary/forces", "N", state.forces, n_forces);
  archive.real("boundary/time of body loads", "s", state.body_loads);
  std::vector<std::int64_t> closed(state.closed.begin(), state.closed.end());
  archive.integers("boundary/closed", closed, static_cast<std::int64_t>(closed.size()));
  if (!archive.is_loading()) return;
  state.closed.assign(closed.begin(), closed.end());
  boundary.restore(state);
}

template <int Dim>
void archive_results(scheme::Sweeps<Dim>& sweeps, Archive& archive) {
  scheme::SweepResults results = sweeps.results();
  archive.real("sweeps/stable dt", "s", results.stable_dt);
  archive.real("sweeps/numerical power", "W", results.numerical_power);
  archive.real("sweeps/viscous dissipation", "J", results.viscous_dissipation);
  archive.real("sweeps/least J", "-", results.least_J);
  if (archive.is_loading()) sweeps.set_results(results);
}

}  // namespace

template <int Dim>
void archive(MovingBody<Dim>& moving, Archive& archive) {
  archive_body(moving, archive);
  archive_clock(moving.clock, archive);
  archive_audit(moving.audit, archive);
  archive_interventions(moving.interventions, archive);
  archive_loads(moving.load_rates, archive);
  archive.vector("initial angular momentum", "N m s", moving.initial_angular_momentum);
  archive_boundary(moving.boundary, archive);
  archive_results(moving.sweeps, archive);
}

template void archive(MovingBody<2>&, Archive&);
template void archive(MovingBody<3>&, Archive&);

}  // namespace diptych::time
