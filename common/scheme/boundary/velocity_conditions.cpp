/// Conditions on the velocity: fixed, velocity, symmetry, skew-symmetry.

#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

namespace {

class PrescribedVelocity : public BoundaryCondition {
 public:
  explicit PrescribedVelocity(VectorFunction velocity) : velocity_(std::move(velocity)) {}
  std::vector<NodeConstraint> constraints(const PairGraph&,
                                          const BoundaryPatch& patch) const override {
    std::vector<NodeConstraint> list;
    for (const std::int32_t node : patch.nodes) {
      list.push_back({node, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, velocity_});
    }
    return list;
  }

 private:
  VectorFunction velocity_;  ///< empty: fixed
};

/// No normal velocity, free tangentially (also a frictionless roller).
class Symmetry : public BoundaryCondition {
 public:
  std::vector<NodeConstraint> constraints(const PairGraph&,
                                          const BoundaryPatch& patch) const override {
    std::vector<NodeConstraint> list;
    for (size_t k = 0; k < patch.nodes.size(); ++k) {
      list.push_back({patch.nodes[k], {unit_normal(patch.area[k])}, {}});
    }
    return list;
  }
};

/// No tangential velocity, no normal traction.
class SkewSymmetry : public BoundaryCondition {
 public:
  std::vector<NodeConstraint> constraints(const PairGraph&,
                                          const BoundaryPatch& patch) const override {
    std::vector<NodeConstraint> list;
    for (size_t k = 0; k < patch.nodes.size(); ++k) {
      const Vec3 n = unit_normal(patch.area[k]);
      int least = 0;
      for (int i = 1; i < 3; ++i) {
        if (std::abs(n[i]) < std::abs(n[least])) least = i;
      }
      const Vec3 t = n.cross(Vec3::Unit(least)).normalized();
      list.push_back({patch.nodes[k], {t, n.cross(t)}, {}});
    }
    return list;
  }
};

std::unique_ptr<BoundaryCondition> make_fixed(const BoundaryValues&) {
  return std::make_unique<PrescribedVelocity>(VectorFunction{});
}
std::unique_ptr<BoundaryCondition> make_velocity(const BoundaryValues& values) {
  return std::make_unique<PrescribedVelocity>(values.vector);
}
std::unique_ptr<BoundaryCondition> make_symmetry(const BoundaryValues&) {
  return std::make_unique<Symmetry>();
}
std::unique_ptr<BoundaryCondition> make_skew_symmetry(const BoundaryValues&) {
  return std::make_unique<SkewSymmetry>();
}

using enum BoundaryKind::Takes;
using enum BoundaryKind::Acts;

}  // namespace

BoundaryKind fixed_condition() {
  return {make_fixed, nothing, hold};
}
BoundaryKind velocity_condition() {
  return {make_velocity, vector, hold};
}
BoundaryKind symmetry_condition() {
  return {make_symmetry, nothing, constrain, "normal velocity zero, tangentially free"};
}
BoundaryKind skew_symmetry_condition() {
  return {make_skew_symmetry, nothing, constrain, "tangential velocity zero, normally free"};
}

}  // namespace diptych::scheme
