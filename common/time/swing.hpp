#pragma once
/// The swing of leapfrog's energy (notes 5.6). What a step keeps of a linear body is
///   K + W - dt^2/8 sum m |a|^2,
/// so that the energy K + W is off by the last term, and for good by what that has been when a body
/// set off with it: one that is let go with a stress that its surface does not carry, or whose load
/// stops at once. Steps in which it would be more than the body is held to are shorter, those that
/// it has grown to more in are made again, and the next steps are looked at. While they are, they
/// do not become larger again: what is kept changes with dt, and a step that followed a swinging
/// |a| would pump. Test: tests/common/run/budget_of_start_test.cpp

#include "common/time/moving_body.hpp"

namespace diptych::time {

/// Steps from one that may swing, in which it is looked at.
inline constexpr std::int64_t steps_of_swing = 20;

/// sum m |a|^2 of the free directions of all nodes, from the force field  [N^2/kg]
template <int Dim>
double squared_accelerations(const scheme::Body<Dim>& body,
                             const scheme::AppliedBoundary& boundary);

/// dt^2/8 sum (m a - f).a of the state with the step that it allows, of either sign: the work of
/// loads f, which they do in kicks, has its own share (notes 6)  [J]
template <int Dim>
double swing_of(const MovingBody<Dim>& moving);

/// The least part of the stable step that it is shortened to: a load that sets in on a body that
/// holds next to nothing brings less in its first steps than they swing by.
inline constexpr double least_part_of_step = 0.125;

/// Looks at the next steps of a body that holds this energy  [J]; 0: is at rest, and not looked at.
/// @param work  external, until now  [J]
inline void begin_swing(Clock& clock, double share, double energy, double work) {
  clock.swing_share = share;
  clock.swing_energy = energy;
  clock.swing_work = work;
  clock.swings_until = energy > 0 ? clock.step + steps_of_swing : 0;
}

/// Before a step, where it is looked at: limits its size, clock.largest_dt.
template <int Dim>
void limit_swing(MovingBody<Dim>& moving);

/// After a step of size dt, where it is looked at: the size with which it is to be made again; 0:
/// it is good.
template <int Dim>
double shorter_for_swing(const MovingBody<Dim>& moving, double dt);

}  // namespace diptych::time
