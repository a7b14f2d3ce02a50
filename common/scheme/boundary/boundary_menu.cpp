#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

const base::Registry<BoundaryKind>& boundary_menu() {
  static const auto menu = [] {
    base::Registry<BoundaryKind> all("boundary condition");
#define DIPTYCH_BOUNDARY(name, function) all.add(name, function##_condition());
#include "common/scheme/boundary/conditions.def"
#undef DIPTYCH_BOUNDARY
    return all;
  }();
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
