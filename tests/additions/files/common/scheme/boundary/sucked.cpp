/// A follower load of the opposite sign of a pressure.

#include "common/scheme/boundary/boundary_condition.hpp"

namespace diptych::scheme {

namespace {

class Suction : public BoundaryCondition {
 public:
  explicit Suction(const BoundaryValues& values) : values_(values) {}
  bool loads() const override { return true; }
  bool follows_surface() const override { return true; }
  bool depends_on_time() const override { return true; }
  Vec3 force(const LoadedNode& node, double t) const override {
    return values_.scalar(node.X, t) * node.deformed_area;
  }

 private:
  BoundaryValues values_;
};

std::unique_ptr<BoundaryCondition> make_suction(const BoundaryValues& values) {
  return std::make_unique<Suction>(values);
}

}  // namespace

BoundaryKind sucked_condition() {
  return {make_suction, BoundaryKind::Takes::scalar, BoundaryKind::Acts::load, "pulls outwards"};
}

}  // namespace diptych::scheme
