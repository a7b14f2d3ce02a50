#pragma once
/// Makers of the conditions that load nodes with forces.

#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

std::unique_ptr<BoundaryCondition> make_traction(const BoundaryValues& values);
std::unique_ptr<BoundaryCondition> make_pressure(const BoundaryValues& values);

}  // namespace diptych::scheme
