#pragma once
/// Instants at which steps end because of what a case prescribes in time (notes 5.7): where
/// tractions, pressures, body forces and velocities of supports jump, wherever steps could not
/// follow them otherwise and, of leapfrog, where what sets in or stops at once acts for few steps.
/// Test: tests/common/run/step_ends_test.cpp

#include "common/cases/case.hpp"

#include <span>
#include <vector>

namespace diptych::run {

/// A step ends at `before` and the next one begins at `after`: the same but at a jump, or where
/// that is as good as an instant of output  [s].
struct StepEnd {
  double before = 0, after = 0;
  bool is_jump = false;
};

/// @param dt      of steps that nothing hinders  [s]
/// @param places  at which actions that depend on place and time together are looked at  [m]
/// @return ascending; instants that are as good as one, or as good as an instant of output, are one
/// @throws base::InputError where something changes faster than steps can follow at a sensible cost
std::vector<StepEnd> step_ends(const cases::Case& setup,
                               double dt,
                               std::span<const algebra::Vec3> places);

/// What a run begins with is of this instant: 0, or right behind a jump there, as of "t > 0 ? 1 :
/// 0", whose value at 0 lasts for no time  [s]
double start_of(const cases::Case& setup);

}  // namespace diptych::run
