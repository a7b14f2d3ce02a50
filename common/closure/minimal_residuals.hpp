#pragma once
/// Minimal residuals for systems that contradict themselves: S y = r with S symmetric positive
/// semi-definite and a part of r that S does not reach, of which conjugate gradients take more and
/// more. Of all y in the Krylov space that one whose residual is least in the norm of the
/// preconditioner; it falls from step to step, solution or none. Source: Paige and Saunders, SIAM
/// J. Numer. Anal. 12 (1975) 617. Test: tests/graphs/closure_repair_test.cpp.

#include "common/closure/conjugate_gradients.hpp"

#include <vector>

namespace diptych::closure {

/// Solves from y = 0 until max_a |r_a| unit_a <= limits.residual, or until the residual stops
/// falling. The three components run side by side.
/// @param precondition  symmetric, positive definite
/// @return steps taken
int minimal_residuals(const FieldOperator& S,
                      const FieldOperator& precondition,
                      const std::vector<double>& unit,
                      const SolveLimits& limits,
                      const Field& r,
                      Field& y);

}  // namespace diptych::closure
