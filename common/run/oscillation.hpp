#pragma once
/// Period, decrement and mean of an oscillation, from samples over time.
/// Crossings of the mean, upwards, count the periods; a crossing counts once the signal has been a
/// tenth of its last swing away from the mean on both sides, so that ripples do not. The mean is
/// taken over whole periods, less that of a damped sine of the same amplitude and decrement: what
/// is left is where the oscillation comes to rest. Amplitudes are half the way from the trough to
/// the crest of a period, extremes by the parabola through three samples. Test:
/// tests/common/run/oscillation_test.cpp

#include <optional>
#include <span>

namespace diptych::run {

struct Oscillation {
  int n_periods = 0;
  double period = 0;     ///< s, mean of the whole periods
  double mean = 0;       ///< where it comes to rest
  double amplitude = 0;  ///< of the first whole period
  /// ln of the ratio of the amplitudes of successive periods, mean; none with one period
  std::optional<double> decrement;
};

/// @param times, values  of equal size, ascending in time
/// @return nothing where there is no whole period
std::optional<Oscillation> oscillation_of(std::span<const double> times,
                                          std::span<const double> values);

}  // namespace diptych::run
