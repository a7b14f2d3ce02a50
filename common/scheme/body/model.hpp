#pragma once
/// A body's material with its Maxwell branches and density.

#include "common/physics/maxwell_branch.hpp"

#include <vector>

namespace diptych::scheme {

template <class Material>
struct Model {
  Material material;
  double rho_R = 0;                              ///< kg/m^3
  std::vector<physics::MaxwellBranch> branches;  ///< any number
};

}  // namespace diptych::scheme
