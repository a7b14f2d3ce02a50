#pragma once
/// A body in motion: all that a step reads and changes.

#include "common/scheme/boundary/applied_boundary.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/budget/interventions.hpp"
#include "common/scheme/sweeps/sweeps.hpp"
#include "common/time/integrator.hpp"

#include <limits>

namespace diptych::time {

/// Where a run stands, and how large its steps were.
struct Clock {
  double time = 0;                                              ///< s
  std::int64_t step = 0;                                        ///< steps made
  double first_dt = 0;                                          ///< s
  double largest_dt = std::numeric_limits<double>::infinity();  ///< s, after a rejected step
  double least_share = 1e-7;  ///< of the first step: a smaller one is a breakdown
  // leapfrog: the swing of its energy (swing.hpp)
  double swing_share = 0;         ///< of the energy, that it is held to
  double swing_energy = 0;        ///< J, when it set off; 0: at rest
  double swing_work = 0;          ///< J, external work until then
  std::int64_t swings_until = 0;  ///< step, before which it is looked at
};

template <int Dim>
struct MovingBody {
  scheme::Body<Dim> body;
  scheme::Sweeps<Dim> sweeps;
  scheme::AppliedBoundary boundary;
  Integrator integrator;
  bool keeps_angular_momentum = false;  ///< by the projection of notes 3.7
  scheme::Audit audit{};
  scheme::LoadRates load_rates{};  ///< of the loads as they were added last
  algebra::Vec3 initial_angular_momentum = algebra::Vec3::Zero();  ///< N m s, about the centroid
  Clock clock{};
  scheme::Interventions interventions{};

  bool has_branches() const { return body.options.n_branches > 0; }
};

/// One step of Shu and Osher's form of a Runge-Kutta scheme (notes 5.5), or the stages of it up to
/// the first state that is not sound (step_begin.hpp). @return its size  [s]
/// @throws base::BreakdownError where the step has collapsed
template <int Dim>
double ssp_step(MovingBody<Dim>& moving, double t_limit);

/// One step of leapfrog, kick, drift, kick (notes 5.4), or as far as the drift where that ends in a
/// state that is not sound. @return its size  [s]
/// @throws base::BreakdownError where the step has collapsed
template <int Dim>
double leapfrog_step(MovingBody<Dim>& moving, double t_limit);

/// Forces and loads of the state as it stands, at its time: what leapfrog begins with.
template <int Dim>
void begin_leapfrog(MovingBody<Dim>& moving);

// ---- parts that both steps share

/// The step to make now: stable, no larger than a rejection allows, and the time left divided
/// evenly. @throws base::BreakdownError where it is below the least share of the first
template <int Dim>
double choose_dt(MovingBody<Dim>& moving, double t_limit);

/// What loads and D_ab add to the audit at this instant, by the last sweep.
template <int Dim>
scheme::Audit audit_rates(const MovingBody<Dim>& moving);

/// Books what constraints did to the body when they were applied.
template <int Dim>
void book(MovingBody<Dim>& moving, const scheme::ConstraintAction& action);

/// Gives back the angular momentum that D_ab and the integrator took, before the strain rates see
/// the velocities: F stays the gradient of x. Comes before the constraints of the end of the step,
/// whose impulses are booked: supports feel it like a force of the body. What this changes in the
/// kinetic energy is booked as the work of the projection.
template <int Dim>
void keep_angular_momentum(MovingBody<Dim>& moving);

}  // namespace diptych::time
