#pragma once
/// The state that a run begins with.

#include "common/cases/case.hpp"
#include "common/scheme/body/body.hpp"

namespace diptych::run {

/// u and v from their expressions, F as the discrete gradient (18b) of u (or as given), H and J
/// from F, internal variables virgin or relaxed.
/// @throws base::InputError where J is not positive at a node
template <int Dim>
void set_initial_state(const cases::InitialCase& initial, double kappa_f, scheme::Body<Dim>& body);

}  // namespace diptych::run
