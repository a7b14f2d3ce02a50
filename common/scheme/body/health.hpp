#pragma once
/// What went wrong with a body: messages that name node, place, time, state and the likely cause.

#include "common/base/error.hpp"
#include "common/scheme/body/body.hpp"

#include <string>

namespace diptych::scheme {

/// The first node that is not finite or has J <= 0: node, place, time, state, suspected cause.
/// @param remark  a line behind these, or empty
template <int Dim>
base::BreakdownError breakdown_error(
    const Body<Dim>& body, std::int64_t step, double time, double dt, const std::string& remark);

/// A step that has become too small: how small, the node of the least J, what to try.
/// @param least_share  of the first step: what is too small
template <int Dim>
base::BreakdownError collapse_error(const Body<Dim>& body,
                                    std::int64_t step,
                                    double time,
                                    double dt,
                                    double first_dt,
                                    double least_share);

}  // namespace diptych::scheme
