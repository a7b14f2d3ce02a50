/// Forces on a patch: dead traction per reference area, traction of a known motion, follower
/// pressure.

#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

namespace {

/// t_B of (18a), Pa per reference area.
class Traction : public BoundaryCondition {
 public:
  explicit Traction(const BoundaryValues& values) : values_(values) {}
  bool loads() const override { return true; }
  bool depends_on_time() const override { return values_.depends_on_time; }
  const BoundaryValues* given() const override { return &values_; }
  Vec3 force(const LoadedNode& node, double) const override { return node.size * node.vector; }

 private:
  BoundaryValues values_;
};

/// t_B = P N of a known motion.
class KnownTraction : public BoundaryCondition {
 public:
  bool loads() const override { return true; }
  bool needs_P() const override { return true; }
  bool depends_on_time() const override { return true; }
  Vec3 force(const LoadedNode& node, double) const override { return node.P * node.area; }
};

/// A pressure on the deformed surface: t_B = -p H N per reference area.
class Pressure : public BoundaryCondition {
 public:
  explicit Pressure(const BoundaryValues& values) : values_(values) {}
  bool loads() const override { return true; }
  bool follows_surface() const override { return true; }
  bool depends_on_time() const override { return true; }
  const BoundaryValues* given() const override { return &values_; }
  Vec3 force(const LoadedNode& node, double) const override {
    return -node.scalar * node.deformed_area;
  }

 private:
  BoundaryValues values_;
};

std::unique_ptr<BoundaryCondition> make_traction(const BoundaryValues& values) {
  if (values.known) return std::make_unique<KnownTraction>();
  return std::make_unique<Traction>(values);
}
std::unique_ptr<BoundaryCondition> make_pressure(const BoundaryValues& values) {
  return std::make_unique<Pressure>(values);
}

using enum BoundaryKind::Takes;
using enum BoundaryKind::Acts;

}  // namespace

BoundaryKind traction_condition() {
  return {make_traction, vector, load, "dead, per undeformed area"};
}
BoundaryKind pressure_condition() {
  return {make_pressure, scalar, load, "follows the surface"};
}

}  // namespace diptych::scheme
