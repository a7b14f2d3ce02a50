#include "common/scheme/boundary/load_conditions.hpp"
#include "common/scheme/boundary/rigid_wall.hpp"
#include "common/scheme/boundary/velocity_conditions.hpp"

namespace diptych::scheme {

const base::Registry<BoundaryMaker>& boundary_menu() {
  static const auto menu = base::Registry<BoundaryMaker>("boundary condition")
                               .add("fixed", make_fixed)
                               .add("velocity", make_velocity)
                               .add("symmetry", make_symmetry)
                               .add("skew-symmetry", make_skew_symmetry)
                               .add("rigid-wall", make_rigid_wall)
                               .add("traction", make_traction)
                               .add("pressure", make_pressure);
  return menu;
}

std::vector<NodeConstraint> BoundaryCondition::constraints(const PairGraph&,
                                                           const BoundaryPatch&) const {
  return {};
}

Vec3 BoundaryCondition::force(const LoadedNode&, double) const {
  return Vec3::Zero();
}

Vec3 unit_normal(const Vec3& area) {
  Vec3 n = area.normalized();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(n[i]) < 1e-12) n[i] = 0;
  }
  return n.normalized();
}

}  // namespace diptych::scheme
