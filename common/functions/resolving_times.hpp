#pragma once
/// Instants that steps have to end at, besides jumps, so that what expressions do within a step is
/// not lost: pulses and swings shorter than a few steps. Test:
/// tests/common/functions/resolving_times_test.cpp

#include "common/functions/break_times.hpp"

namespace diptych::functions {

/// Steps of dt, each between two breaks, are halved where an expression is off a straight line by
/// more than `least_bend` of its largest value, until it is off by no more than `resolved_bend`.
/// The ends of what is shorter than a step are the result: none where steps of dt see all that
/// happens, as they do of a wave of 15 steps a period. Looked at is what depends on time alone,
/// four times a step, or of `most_steps` steps of a longer run, a tenth as many at a place.
struct ResolvingTimes {
  std::vector<double> times;  ///< ascending
  /// Expressions swing so fast that following them would take more than `most_per_step` times as
  /// many steps, `most_parts` parts of steps, or parts of a 4096th of a step without end: `times`
  /// then ends before.
  /// Not so what takes no more than `followed_anyway` parts a step, waves of four steps a period
  /// and more: steps follow it without aliases, and a run of so many of them has no times.
  bool are_too_many = false;
};
/// @param place  as of break_times
ResolvingTimes resolving_times(const std::vector<Expression>& expressions,
                               const BreakTimes& breaks,
                               double begin,
                               double end,
                               double dt,
                               const std::optional<Vec3>& place = std::nullopt);

inline constexpr double least_bend = 0.02, resolved_bend = 0.01;
inline constexpr double most_steps = 1e5, most_per_step = 100, most_parts = 1e6;
inline constexpr double followed_anyway = 4.5;

}  // namespace diptych::functions
