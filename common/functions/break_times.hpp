#pragma once
/// Instants at which expressions of time jump: where a comparison, a sign or a rounding of what
/// depends on time alone has another result. Steps that end there lose no pulse, however short, and
/// see each load on one side of its jump only. Test: tests/common/functions/break_times_test.cpp

#include "common/functions/expressions.hpp"

#include <vector>

namespace diptych::functions {

/// The first double after each jump, ascending, of those in (begin, end]. Missed is what changes
/// and changes back between two neighbours of `samples_of_break` instants and of those at which
/// arguments of comparisons, abs, min and max change their order: not pulses between two constants.
std::vector<double> break_times(const std::vector<Expression>& expressions,
                                double begin,
                                double end);

inline constexpr int samples_of_break = 1024;

}  // namespace diptych::functions
