#pragma once
/// Makers of the conditions on the velocity.

#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

std::unique_ptr<BoundaryCondition> make_fixed(const BoundaryValues& values);
std::unique_ptr<BoundaryCondition> make_velocity(const BoundaryValues& values);
std::unique_ptr<BoundaryCondition> make_symmetry(const BoundaryValues& values);
std::unique_ptr<BoundaryCondition> make_skew_symmetry(const BoundaryValues& values);

}  // namespace diptych::scheme
