/// Conditions on the velocity: fixed, velocity, symmetry, skew-symmetry.

#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/boundary/patch_faces.hpp"

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

/// One for each plane around a node, as of groups that meet there.
/// @param directions  that are held, of the normal of a plane
template <class Directions>
std::vector<NodeConstraint> of_planes(const PairGraph& graph,
                                      const BoundaryPatch& patch,
                                      const Directions& directions) {
  const std::vector<std::vector<Vec3>> normals = normals_of_planes(graph, patch);
  std::vector<NodeConstraint> list;
  for (size_t k = 0; k < normals.size(); ++k) {
    for (const Vec3& n : normals[k])
      list.push_back({patch.nodes[k], directions(n), {}});
  }
  return list;
}

/// No normal velocity, free tangentially (also a frictionless roller).
class Symmetry : public BoundaryCondition {
 public:
  std::vector<NodeConstraint> constraints(const PairGraph& graph,
                                          const BoundaryPatch& patch) const override {
    return of_planes(graph, patch, [](const Vec3& n) { return std::vector<Vec3>{n}; });
  }
};

/// No tangential velocity, no normal traction.
class SkewSymmetry : public BoundaryCondition {
 public:
  std::vector<NodeConstraint> constraints(const PairGraph& graph,
                                          const BoundaryPatch& patch) const override {
    return of_planes(graph, patch, [](const Vec3& n) {
      int least = 0;
      for (int i = 1; i < 3; ++i) {
        if (std::abs(n[i]) < std::abs(n[least])) least = i;
      }
      const Vec3 t = n.cross(Vec3::Unit(least)).normalized();
      return std::vector<Vec3>{t, n.cross(t)};
    });
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
  return {
      make_symmetry, nothing, constrain,
      "normal velocity zero, tangentially free; the normal is that of the undeformed side: along "
      "curved ones for slides small beside the radius"};
}
BoundaryKind skew_symmetry_condition() {
  return {make_skew_symmetry, nothing, constrain, "tangential velocity zero, normally free"};
}

}  // namespace diptych::scheme
