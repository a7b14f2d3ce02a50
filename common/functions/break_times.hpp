#pragma once
/// Instants at which expressions of time jump: where a comparison, a sign, a rounding or a turn of
/// what depends on time alone has another result. Steps that end there lose no pulse, however
/// short, and see each load on one side of its jump only. Test:
/// tests/common/functions/break_times_test.cpp

#include "common/functions/expressions.hpp"

#include <optional>
#include <vector>

namespace diptych::functions {

inline constexpr int samples_of_break = 1024;

/// Instants in (begin, end], ascending: the first double after each.
struct BreakTimes {
  std::vector<double> jumps;
  std::vector<double> kinks;  ///< of abs, min and max, and where arguments of comparisons are equal
};

/// Missed is what changes and changes back between two neighbours of `n_samples` instants and of
/// those at which arguments of comparisons, abs, min and max change their order: not pulses
/// between two constants.
/// @param place  where expressions are looked at; none: at what depends on time alone in them  [m]
BreakTimes break_times(const std::vector<Expression>& expressions,
                       double begin,
                       double end,
                       int n_samples = samples_of_break,
                       const std::optional<Vec3>& place = std::nullopt);

/// Jumps and kinks, and before each an instant that is `part` of the way from the one before (from
/// `begin`), in pairs: what acts between two of them is seen.
/// @param most  pairs; of more breaks some are taken, evenly
std::vector<double> instants_around(const BreakTimes& breaks,
                                    double begin,
                                    double part,
                                    size_t most);

}  // namespace diptych::functions
