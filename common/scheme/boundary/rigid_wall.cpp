#include "common/scheme/boundary/rigid_wall.hpp"

#include "common/scheme/boundary/node_vector.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::scheme {

namespace {

class Wall : public BoundaryCondition {
 public:
  explicit Wall(const BoundaryValues& values) : wall_{values.point, values.normal.normalized()} {}
  std::optional<RigidWall> wall() const override { return wall_; }

 private:
  RigidWall wall_;
};

std::unique_ptr<BoundaryCondition> make_rigid_wall(const BoundaryValues& values) {
  return std::make_unique<Wall>(values);
}

}  // namespace

BoundaryKind rigid_wall_condition() {
  return {make_rigid_wall, BoundaryKind::Takes::plane, BoundaryKind::Acts::touch,
          "frictionless contact with a fixed rigid plane in space, which the group may touch and "
          "leave"};
}

void WallContacts::add(const RigidWall& wall, const WallCandidate& candidate) {
  const Vec3 free = candidate.keep * wall.normal;
  const double share = free.dot(wall.normal);  // cos^2 of the angle to the free directions
  if (share < 1e-12) return;
  for (const WallNode& w : nodes_) {
    if (w.body.node != candidate.node) continue;
    if (w.wall.point == wall.point && w.wall.normal == wall.normal) return;  // groups share a node
    const Vec3& X = candidate.X;
    throw base::InputError(fmt::format(
        "two rigid walls act on the node at ({:g}, {:g}, {:g}); let the groups of walls share no "
        "node",
        X[0], X[1], X[2]));
  }
  nodes_.push_back({candidate, wall, free / share, false});
}

/// Sets v_n = 0 by an impulse along the free direction. @return change of the kinetic energy  [J]
template <int Dim>
double WallContacts::stop(const WallNode& w, Body<Dim>& body, ConstraintAction& action) {
  const std::int32_t a = w.body.node;
  const Vec3 v = vector_at<Dim>(body.v, a);
  const Vec3 wanted = v - v.dot(w.wall.normal) * w.push;
  for (int i = 0; i < Dim; ++i)
    body.v.set(a, i, wanted[i]);
  const Vec3 change = vector_at<Dim>(body.v, a) - v;  // as the state has it
  const Vec3 impulse = body.options.rho_R * w.body.Omega * change;
  const Vec3 x = w.body.X_centred + vector_at<Dim>(body.u, a);
  action.impulse.linear += impulse;
  action.impulse.angular += x.cross(impulse);
  return impulse.dot(v + 0.5 * change);
}

void WallContacts::keep(std::vector<char>& closed) const {
  closed.resize(nodes_.size());
  for (size_t k = 0; k < nodes_.size(); ++k)
    closed[k] = nodes_[k].closed ? 1 : 0;
}

void WallContacts::restore(const std::vector<char>& closed) {
  for (size_t k = 0; k < nodes_.size(); ++k)
    nodes_[k].closed = closed[k] != 0;
}

template <int Dim>
void WallContacts::hold(Body<Dim>& body, ConstraintAction& action) const {
  for (const WallNode& w : nodes_) {
    if (w.closed) stop(w, body, action);
  }
}

template <int Dim>
void WallContacts::settle(Body<Dim>& body, double dt, ConstraintAction& action) {
  for (WallNode& w : nodes_) {
    const double v_n = vector_at<Dim>(body.v, w.body.node).dot(w.wall.normal);
    if (w.closed) {
      // began the step with v_n = 0, so the sign of v_n is that of the force
      w.closed = v_n <= 0;
      if (w.closed) stop(w, body, action);
      continue;
    }
    const Vec3 x = w.body.X + vector_at<Dim>(body.u, w.body.node);
    const double gap = (x - w.wall.point).dot(w.wall.normal);
    if (v_n < 0 && gap + 0.5 * v_n * dt <= 0) {
      w.closed = true;
      action.work += stop(w, body, action);
    }
  }
}

template <int Dim>
Vec3 WallContacts::force(const Body<Dim>& body, const std::vector<std::int32_t>& nodes) const {
  Vec3 sum = Vec3::Zero();
  for (const WallNode& w : nodes_) {
    if (!w.closed || !std::binary_search(nodes.begin(), nodes.end(), w.body.node)) continue;
    sum -= vector_at<Dim>(body.T, w.body.node).dot(w.push) * w.wall.normal;
  }
  return sum;
}

#define DIPTYCH_INSTANTIATE(Dim)                                             \
  template void WallContacts::hold(Body<Dim>&, ConstraintAction&) const;     \
  template void WallContacts::settle(Body<Dim>&, double, ConstraintAction&); \
  template Vec3 WallContacts::force(const Body<Dim>&, const std::vector<std::int32_t>&) const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
