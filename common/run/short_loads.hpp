#pragma once
/// Steps while loads act that set in or stop at once, for some steps (notes 5.7).
/// Test: tests/common/run/step_ends_test.cpp

#include "common/functions/expressions.hpp"
#include "common/run/step_ends.hpp"

#include <span>
#include <vector>

namespace diptych::run {

/// Adds ends of steps where an action beside a jump, t = 0 among them, acts for few steps: its
/// square over the largest on that side of the jump, integrated, is the time t for which it does.
/// Leapfrog's energy is off by dt^2/8 sum m |a|^2 while a load acts (notes 5.6). A traction p
/// brings p^2 t/(rho c) in a time t, and that term is dt^2 p^2/(4 rho h): they are as 1 to 200
/// where steps are no longer than sqrt(t dt/50), with the stable step dt for h/c; of what changes
/// while it acts, no longer than t/8 either. Runge-Kutta steps are short for 100 dt more.
/// What joins place and time has steps of its own.
/// @param ends    ascending, to which they are added
/// @param dt      of steps that nothing hinders  [s]
/// @param end     of the run  [s]
/// @param places  at which actions that depend on the place are looked at  [m]
void add_ends_of_short_loads(std::vector<StepEnd>& ends,
                             double dt,
                             double end,
                             const std::vector<functions::Expression>& actions,
                             std::span<const algebra::Vec3> places,
                             bool is_leapfrog);

}  // namespace diptych::run
