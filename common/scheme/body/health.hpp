#pragma once
/// What went wrong with a body: messages that name node, place, time, state and the likely cause.

#include "common/scheme/body/body.hpp"

#include <string>

namespace diptych::scheme {

/// The first node that is not finite or has J <= 0: node, place, time, state, suspected cause.
template <int Dim>
std::string breakdown_report(const Body<Dim>& body, std::int64_t step, double time, double dt);

/// A step that has become too small: how small, and the node of the least J.
template <int Dim>
std::string collapse_report(
    const Body<Dim>& body, std::int64_t step, double time, double dt, double first_dt);

}  // namespace diptych::scheme
