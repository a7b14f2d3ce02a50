#include "common/scheme/boundary/rigid_wall.hpp"

#include "common/parallel/reduction.hpp"
#include "common/scheme/boundary/node_vector.hpp"
#include "common/scheme/boundary/stage_begin.hpp"

#include <algorithm>
#include <cmath>
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
  return {
      make_rigid_wall, BoundaryKind::Takes::plane, BoundaryKind::Acts::touch,
      "frictionless contact with a fixed rigid plane in space, which the group may touch and "
      "leave (several walls may share nodes where they are at right angles, as in a corner, or "
      "face each other); what a node loses as the wall catches it is negative external work, of "
      "the first order in the spacing"};
}

bool WallContacts::WallNode::acts_apart_from(const WallNode& other) const {
  constexpr double rounding = 1e-5;  // of normals with six digits
  const double cosine =
      along().dot(other.wall.normal) / (other.body.keep * other.wall.normal).norm();
  return std::abs(cosine) < rounding || cosine < -1 + 0.5 * rounding * rounding;
}

void WallContacts::add(const RigidWall& wall, const WallCandidate& candidate) {
  const Vec3 free = candidate.keep * wall.normal;
  const double share = free.dot(wall.normal);  // cos^2 of the angle to the free directions
  if (share < 1e-12) return;
  const WallNode added{candidate, wall, free / share, false};
  const auto [begin, end] = places_of_node_.equal_range(candidate.node);
  for (auto place = begin; place != end; ++place) {
    const WallNode& w = nodes_[place->second];
    const Vec3 &X = candidate.X, &n = w.wall.normal, &m = wall.normal;
    const double between = (w.wall.point - wall.point).dot(m);
    const bool is_one_plane = std::abs(between) <= 1e-9 * std::cbrt(candidate.Omega);
    if (n == m && is_one_plane) return;  // groups share a node
    if (n.dot(m) < -0.5 && is_one_plane) {
      throw base::InputError(fmt::format(
          "two rigid walls that face each other leave the node at ({:g}, {:g}, {:g}) no "
          "room; move their points apart, or hold it with type = \"symmetry\"",
          X[0], X[1], X[2]));
    }
    if (added.acts_apart_from(w)) continue;
    throw base::InputError(fmt::format(
        "two rigid walls, of normals ({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g}), act on "
        "the node at ({:g}, {:g}, {:g}) along directions that are neither at right angles nor "
        "opposite; let the groups of such walls share no node",
        n[0], n[1], n[2], m[0], m[1], m[2], X[0], X[1], X[2]));
  }
  places_of_node_.emplace(candidate.node, nodes_.size());
  nodes_.push_back(added);
}

namespace {

template <int Dim>
double gap_of(const RigidWall& wall, const Vec3& X, const BlockField& u, std::int32_t node) {
  return (X + vector_at<Dim>(u, node) - wall.point).dot(wall.normal);
}

}  // namespace

/// The wall would throw the node out within one step. Depths that rounding makes (of a state in
/// single precision too, or of a mesh file) cost velocities of a millionth of the wave speed.
template <int Dim>
void WallContacts::require_in_front(const Body<Dim>& body) const {
  const WallNode* deepest = nullptr;
  double depth = 0;
  for (const WallNode& w : nodes_) {
    const double gap = gap_of<Dim>(w.wall, w.body.X, body.u, w.body.node);
    const double size =
        std::pow(w.body.Omega, 1.0 / Dim) + vector_at<Dim>(body.u, w.body.node).norm();
    const double rounding = 1e-6 * size + 1e-12 * (w.body.X.norm() + w.wall.point.norm());
    if (-gap <= std::max(depth, rounding)) continue;
    depth = -gap;
    deepest = &w;
  }
  if (deepest == nullptr) return;
  const Vec3& X = deepest->body.X;
  throw base::InputError(fmt::format(
      "group '{}' begins {:.6g} m behind its rigid wall, deepest at the node at ({:g}, {:g}, "
      "{:g}): "
      "move the point of the wall by as much against its normal, or the body along it; the normal "
      "must point towards the body",
      deepest->body.patch->name, depth, X[0], X[1], X[2]));
}

/// Sets v_n by an impulse along the free direction.
template <int Dim>
void WallContacts::set_normal_velocity(const WallNode& w,
                                       double v_n,
                                       Body<Dim>& body,
                                       ConstraintAction& action) {
  const std::int32_t a = w.body.node;
  const Vec3 v = vector_at<Dim>(body.v, a);
  const Vec3 wanted = v + (v_n - v.dot(w.wall.normal)) * w.push;
  for (int i = 0; i < Dim; ++i)
    body.v.set(a, i, wanted[i]);
  const Vec3 change = vector_at<Dim>(body.v, a) - v;  // as the state has it
  const Vec3 impulse = body.options.rho_R * w.body.Omega * change;
  const Vec3 x = w.body.X_centred + vector_at<Dim>(body.u, a);
  action.impulse.linear += impulse;
  action.impulse.angular += x.cross(impulse);
}

/// The velocity with which the stage began follows from what it made of it.
template <int Dim>
void WallContacts::add_work_of_force(WallNode& w,
                                     const Body<Dim>& body,
                                     const StageCombination& stage) {
  const Vec3 along = w.along();
  const double T = vector_at<Dim>(body.T, w.body.node).dot(along);
  const double begin = stage_begin(body, w.body.node, w.body.Omega, stage).v.dot(along);
  if (stage.first) w.work_of_force = 0;
  w.work_of_force = stage.beta * (w.work_of_force + stage.dt * T * begin);
}

/// The walls of a node are worked by one thread, in the order in which the case gives them.
void WallContacts::list_chunks() {
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const WallNode& a, const WallNode& b) { return a.body.node < b.body.node; });
  places_of_node_.clear();
  std::vector<std::int64_t> chunks;
  for (const WallNode& w : nodes_)
    chunks.push_back(chunk_of_node(w.body.node));
  chunks_ = parallel::ChunksOfList(chunks);
}

void WallContacts::complete(const parallel::Part& part) {
  std::vector<char> closed;
  keep(closed);
  std::vector<std::int32_t> chunk_of;
  for (const WallNode& w : nodes_)
    chunk_of.push_back(static_cast<std::int32_t>(chunk_of_node(w.body.node)));
  part.complete(closed, chunk_of);
  restore(closed);
}

template <int Dim, class Act>
void WallContacts::act_on_nodes(Body<Dim>& body, ConstraintAction& action, const Act& act) {
  action += parallel::sum_over<ConstraintAction>(
      body.part(), chunks_,
      [&](std::int64_t k, ConstraintAction& of_chunk) { act(nodes_[k], of_chunk); });
}

void WallContacts::keep(std::vector<char>& closed) const {
  closed.resize(nodes_.size());
  for (size_t k = 0; k < nodes_.size(); ++k)
    closed[k] = nodes_[k].closed ? 1 : 0;
}

void WallContacts::restore(const std::vector<char>& closed) {
  for (size_t k = 0; k < nodes_.size(); ++k) {
    nodes_[k].closed = closed[k] != 0;
    nodes_[k].lands = false;  // it does in a step alone
  }
}

template <int Dim>
void WallContacts::hold(Body<Dim>& body,
                        const StageCombination& stage,
                        const StageCombination& next,
                        ConstraintAction& action) {
  last_ = next;
  act_on_nodes(body, action, [&](WallNode& w, ConstraintAction& of_chunk) {
    if (w.closed) {
      set_normal_velocity(w, 0, body, of_chunk);
      return;
    }
    add_work_of_force(w, body, stage);
    if (!next.last) return;
    const std::int32_t a = w.body.node;
    // alpha gap_0 + beta (gap + dt v_n) >= 0
    const double v_n = vector_at<Dim>(body.v, a).dot(w.wall.normal);
    const double least = -(next.alpha / next.beta * gap_of<Dim>(w.wall, w.body.X, body.u_0, a) +
                           gap_of<Dim>(w.wall, w.body.X, body.u, a)) /
                         next.dt;
    if (v_n >= least) return;
    w.lands = true;
    w.v_begin = vector_at<Dim>(body.v_0, a).dot(w.along());
    set_normal_velocity(w, least, body, of_chunk);
  });
}

template <int Dim>
void WallContacts::hold_in_middle(Body<Dim>& body, double dt, ConstraintAction& action) {
  last_ = {.alpha = 0, .beta = 1, .dt = 0.5 * dt, .first = false, .last = true};  // the second kick
  act_on_nodes(body, action, [&](WallNode& w, ConstraintAction& of_chunk) {
    if (w.closed) {
      set_normal_velocity(w, 0, body, of_chunk);
      return;
    }
    const std::int32_t a = w.body.node;
    const double v_n = vector_at<Dim>(body.v, a).dot(w.wall.normal);
    const double least = -gap_of<Dim>(w.wall, w.body.X, body.u, a) / dt;
    if (v_n >= least) return;
    w.lands = true;
    const Vec3 along = w.along();
    const double T = vector_at<Dim>(body.T, a).dot(along);
    w.v_begin =
        vector_at<Dim>(body.v, a).dot(along) - 0.5 * dt * T / (body.options.rho_R * w.body.Omega);
    set_normal_velocity(w, least, body, of_chunk);
    w.work_of_force = 0.5 * dt * T * vector_at<Dim>(body.v, a).dot(along);
  });
}

template <int Dim>
Vec3 WallContacts::lag_of_moment(const Body<Dim>& body, const StageCombination& stage) const {
  const auto lag =
      parallel::sum_over<VectorSum>(body.part(), chunks_, [&](std::int64_t k, VectorSum& sum) {
        const WallNode& w = nodes_[k];
        const bool is_let_go = stage.last && vector_at<Dim>(body.v, w.body.node).dot(w.push) > 0;
        if (!w.closed || is_let_go) return;
        const Vec3 along = w.along();
        const Vec3 force = -vector_at<Dim>(body.T, w.body.node).dot(along) * along;
        const Vec3 begin = stage_begin(body, w.body.node, w.body.Omega, stage).u;
        sum.value +=
            stage.beta * stage.dt * (begin - vector_at<Dim>(body.u, w.body.node)).cross(force);
      });
  return lag.value;
}

namespace {

/// What an impact takes from the body  [J]
void take(ConstraintAction& action, double energy) {
  action.work -= energy;
  action.caught += energy;
}

}  // namespace

template <int Dim>
void WallContacts::settle(Body<Dim>& body, ConstraintAction& action) {
  act_on_nodes(body, action, [&](WallNode& w, ConstraintAction& of_chunk) {
    const std::int32_t a = w.body.node;
    const double v_n = vector_at<Dim>(body.v, a).dot(w.wall.normal);
    if (w.closed) {
      // began the step with v_n = 0, so the sign of v_n is that of the force
      w.closed = v_n <= 0;
      if (w.closed) set_normal_velocity(w, 0, body, of_chunk);
      return;
    }
    const double half_mass = 0.5 * body.options.rho_R * w.body.Omega;
    const auto speed = [&] { return vector_at<Dim>(body.v, a).dot(w.along()); };
    if (w.lands) {
      add_work_of_force(w, body, last_);
      w.lands = false;
      w.closed = true;
      set_normal_velocity(w, 0, body, of_chunk);
      take(of_chunk, half_mass * (w.v_begin * w.v_begin - speed() * speed()) + w.work_of_force);
    } else if (v_n < 0 && gap_of<Dim>(w.wall, w.body.X, body.u, a) <= 0) {
      // stands there from the start
      const double before = speed();
      w.closed = true;
      set_normal_velocity(w, 0, body, of_chunk);
      take(of_chunk, half_mass * (before * before - speed() * speed()));
    }
  });
}

template <int Dim>
Vec3 WallContacts::force(const Body<Dim>& body, const std::vector<std::int32_t>& nodes) const {
  const auto sum =
      parallel::sum_over<VectorSum>(body.part(), chunks_, [&](std::int64_t k, VectorSum& force) {
        const WallNode& w = nodes_[k];
        if (!w.closed || !std::binary_search(nodes.begin(), nodes.end(), w.body.node)) return;
        // with what other conditions answer along the directions that they hold
        const double push = vector_at<Dim>(body.T, w.body.node).dot(w.push);
        force.value -= push * (w.body.keep * w.wall.normal);
      });
  return sum.value;
}

template <int Dim>
double WallContacts::squared_forces(const Body<Dim>& body) const {
  return parallel::sum_over<double>(body.part(), chunks_, [&](std::int64_t k, double& sum) {
    const WallNode& w = nodes_[k];
    if (!w.closed) return;
    // what it takes of the square of the part of T that other conditions leave free
    const double push = vector_at<Dim>(body.T, w.body.node).dot(w.along());
    sum += push * push / (body.options.rho_R * w.body.Omega);
  });
}

template <int Dim>
double WallContacts::power_gain_withheld(const Body<Dim>& body,
                                         const std::vector<Vec3>& loads,
                                         const std::vector<std::int32_t>& slot_of_node) const {
  if (nodes_.empty()) return 0;
  return parallel::sum_over<double>(body.part(), chunks_, [&](std::int64_t k, double& sum) {
    const WallNode& w = nodes_[k];
    const std::int32_t slot = slot_of_node[static_cast<size_t>(w.body.node)];
    if (!w.closed || slot < 0) return;
    const double held = (w.body.keep * vector_at<Dim>(body.T, w.body.node)).dot(w.wall.normal);
    sum +=
        held * loads[static_cast<size_t>(slot)].dot(w.push) / (body.options.rho_R * w.body.Omega);
  });
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                 \
  template void WallContacts::require_in_front(const Body<Dim>&) const;                          \
  template void WallContacts::hold(Body<Dim>&, const StageCombination&, const StageCombination&, \
                                   ConstraintAction&);                                           \
  template void WallContacts::hold_in_middle(Body<Dim>&, double, ConstraintAction&);             \
  template Vec3 WallContacts::lag_of_moment(const Body<Dim>&, const StageCombination&) const;    \
  template void WallContacts::settle(Body<Dim>&, ConstraintAction&);                             \
  template Vec3 WallContacts::force(const Body<Dim>&, const std::vector<std::int32_t>&) const;   \
  template double WallContacts::squared_forces(const Body<Dim>&) const;                          \
  template double WallContacts::power_gain_withheld(const Body<Dim>&, const std::vector<Vec3>&,  \
                                                    const std::vector<std::int32_t>&) const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
