#pragma once
/// What went wrong with a body: messages that name node, place, time, state and the likely cause.

#include "common/base/error.hpp"
#include "common/scheme/body/body.hpp"

#include <string>

namespace diptych::scheme {

/// The node where a value that is not finite, J <= 0 or an internal variable that is not positive
/// definite arose: node, place, time, state, suspected cause. Sweeps carry it to neighbours and to
/// other fields; it arose in the field that is bad at the fewest nodes, in their middle. Test:
/// tests/common/run/fault_test.cpp
/// @param remark  a line behind these, or empty
template <int Dim>
base::BreakdownError breakdown_error(
    const Body<Dim>& body, std::int64_t step, double time, double dt, const std::string& remark);

/// A step that has become too small (as above where a value is bad): how small, the node of the
/// least J, what to try.
/// @param least_share  of the first step: what is too small
template <int Dim>
base::BreakdownError collapse_error(const Body<Dim>& body,
                                    std::int64_t step,
                                    double time,
                                    double dt,
                                    double first_dt,
                                    double least_share);

}  // namespace diptych::scheme
