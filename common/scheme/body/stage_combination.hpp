#pragma once
/// What a stage of a Runge-Kutta step makes of the unknowns.

namespace diptych::scheme {

/// U <- alpha U_0 + beta (U + dt dU/dt), U_0 at the beginning of the step.
struct StageCombination {
  double alpha = 0, beta = 1;  ///< alpha + beta = 1
  double dt = 0;               ///< s
  bool first = false;          ///< U_0 <- U before the update
  bool last = false;           ///< H and J follow from the new F: the step ends (notes 3.5)
};

}  // namespace diptych::scheme
