#include "common/scheme/boundary/applied_boundary.hpp"

#include "common/algebra/face_areas.hpp"
#include "common/base/error.hpp"
#include "common/parallel/agreement.hpp"
#include "common/parallel/reduction.hpp"
#include "common/scheme/boundary/node_vector.hpp"
#include "common/scheme/boundary/patch_faces.hpp"
#include "common/scheme/boundary/resolved_load.hpp"
#include "common/scheme/boundary/stage_begin.hpp"
#include "common/scheme/boundary/telling_places.hpp"
#include "common/scheme/graph/centroid.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace diptych::scheme {

namespace {

/// Builds the projector of one node from all its constraints; prescribed velocities first.
class NodeProjector {
 public:
  void add(const NodeConstraint& constraint, const Vec3& X) {
    if (constraint.velocity) {
      if (velocity_ && !same_velocity(constraint.velocity, X)) {
        throw base::InputError(fmt::format(
            "two boundary conditions prescribe different velocities at the node at ({:g}, {:g}, "
            "{:g}); let only one of them hold the nodes that they share",
            X[0], X[1], X[2]));
      }
      velocity_ = constraint.velocity;
    }
    for (Vec3 d : constraint.directions) {
      d.normalize();
      for (int pass = 0; pass < 2; ++pass) {
        for (const Vec3& q : basis_)
          d -= q.dot(d) * q;
      }
      if (d.norm() > 1e-6) basis_.push_back(d.normalized());
    }
  }
  Mat3 keep() const {
    Mat3 P = Mat3::Identity();
    if (basis_.size() == 3) return Mat3::Zero();
    for (const Vec3& q : basis_)
      P -= q * q.transpose();
    for (int k = 0; k < 9; ++k) {
      if (std::abs(P(k / 3, k % 3)) < 1e-15) P(k / 3, k % 3) = 0;
    }
    return P;
  }
  const VectorFunction& velocity() const { return velocity_; }

 private:
  bool same_velocity(const VectorFunction& other, const Vec3& X) const {
    const Vec3 a = velocity_(X, 0), b = other(X, 0);
    return (a - b).norm() <= 1e-12 * (a.norm() + b.norm());
  }
  std::vector<Vec3> basis_;
  VectorFunction velocity_;
};

}  // namespace

AppliedBoundary::AppliedBoundary(const PairGraph& graph,
                                 std::vector<PlacedCondition> conditions,
                                 VectorFunction body_force,
                                 bool body_force_depends_on_time)
    : conditions_(std::move(conditions)),
      loads_depend_on_time_(body_force && body_force_depends_on_time),
      X_(graph.X),
      Omega_(graph.Omega),
      X_user_(graph.X) {
  const Vec3 centroid = centroid_of(graph);
  for (Vec3& X : X_)
    X -= centroid;
  std::map<std::int32_t, NodeProjector> projectors;
  for (const bool with_velocity : {true, false}) {
    for (const PlacedCondition& placed : conditions_) {
      for (const NodeConstraint& c : placed.condition->constraints(graph, *placed.patch)) {
        if (static_cast<bool>(c.velocity) == with_velocity) {
          projectors[c.node].add(c, graph.X[c.node]);
        }
      }
    }
  }
  for (const auto& [node, projector] : projectors) {
    constrained_.push_back(
        {node, graph.Omega[node], graph.X[node], projector.keep(), projector.velocity()});
    has_velocities_ |= static_cast<bool>(projector.velocity());
  }
  if (body_force) {
    body_force_ = body_force.placed(X_user_);
    add_telling_places(X_user_, telling_places_);
  }
  place_velocities();
  place_loads(graph);
  std::vector<std::int64_t> chunks;
  for (const ConstrainedNode& c : constrained_)
    chunks.push_back(chunk_of_node(c.node));
  chunks_of_constrained_ = parallel::ChunksOfList(chunks);
  place_walls(graph);
  std::vector<char> loaded(graph.X.size(), body_force_ ? 1 : 0);
  for (const PlacedCondition& placed : conditions_) {
    if (!placed.condition->loads()) continue;
    loads_depend_on_time_ |= placed.condition->depends_on_time();
    for (const std::int32_t node : placed.patch->nodes)
      loaded[node] = 1;
  }
  mark_loaded(loaded);
}

void AppliedBoundary::place_velocities() {
  for (size_t k = 0; k < constrained_.size(); ++k) {
    const VectorFunction& velocity = constrained_[k].velocity;
    if (!velocity) continue;
    auto found = std::find_if(velocities_.begin(), velocities_.end(),
                              [&](const auto& known) { return known.velocity.is_same(velocity); });
    if (found == velocities_.end())
      found = velocities_.insert(velocities_.end(), PrescribedVelocities{velocity, {}, nullptr});
    found->nodes.push_back(k);
  }
  for (PrescribedVelocities& prescribed : velocities_) {
    std::vector<Vec3> X;
    for (const size_t k : prescribed.nodes)
      X.push_back(constrained_[k].X);
    add_telling_places(X, telling_places_);
    prescribed.placed = prescribed.velocity.placed(X);
  }
}

namespace {

bool is_same_load(const BoundaryValues& a, const BoundaryValues& b) {
  return (a.vector && a.vector.is_same(b.vector)) || (a.scalar && a.scalar.is_same(b.scalar));
}

}  // namespace

void AppliedBoundary::place_loads(const PairGraph& graph) {
  std::vector<std::pair<const BoundaryValues*, SeenLoad>> all;
  for (const PlacedCondition& placed : conditions_) {
    GivenLoads& given = given_.emplace_back();
    const BoundaryValues* const values = placed.condition->given();
    if (values == nullptr) continue;
    std::vector<Vec3> X;
    for (const std::int32_t node : placed.patch->nodes)
      X.push_back(X_user_[static_cast<size_t>(node)]);
    add_telling_places(X, telling_places_);
    given.sizes = areas_as_numbers(graph, *placed.patch);
    const std::vector<PatchFace> faces = faces_of(*placed.patch);
    SeenLoad& seen = all.emplace_back(values, SeenLoad{}).second;
    if (values->vector) given.vector = resolved_load(values->vector, X, given.sizes, faces, seen);
    if (values->scalar) given.scalar = resolved_load(values->scalar, X, given.sizes, faces, seen);
  }
  // on one of several groups of a condition it may have none
  for (const auto& load : all) {
    const bool is_seen = std::any_of(all.begin(), all.end(), [&](const auto& other) {
      return other.second.within_faces && is_same_load(*load.first, *other.first);
    });
    const auto& on_nodes_alone = load.second.on_nodes_alone;
    if (on_nodes_alone && !is_seen) throw base::InputError(no_area_for(*on_nodes_alone));
  }
}

void AppliedBoundary::mark_loaded(const std::vector<char>& loaded) {
  loaded_nodes_.clear();
  slot_of_node_.assign(loaded.size(), -1);
  for (size_t a = 0; a < loaded.size(); ++a) {
    if (!loaded[a]) continue;
    slot_of_node_[a] = static_cast<std::int32_t>(loaded_nodes_.size());
    loaded_nodes_.push_back(static_cast<std::int32_t>(a));
  }
  forces_.assign(loaded_nodes_.size(), Vec3::Zero());
  std::vector<std::int64_t> chunks;
  for (const std::int32_t a : loaded_nodes_)
    chunks.push_back(chunk_of_node(a));
  chunks_of_loaded_ = parallel::ChunksOfList(chunks);
  list_held_loads();
}

void AppliedBoundary::follow(std::shared_ptr<KnownLoads> known) {
  body_loads_ = BodyLoads(std::move(known), X_, Omega_);
  loads_depend_on_time_ = true;
}

/// Prescribed parts of the velocities of the constrained nodes at time t.
std::vector<Vec3> AppliedBoundary::prescribed(double t) const {
  std::vector<Vec3> values(constrained_.size(), Vec3::Zero());
  for (const PrescribedVelocities& prescribed : velocities_) {
    const std::vector<Vec3> v = prescribed.placed->at(t);
    for (size_t i = 0; i < v.size(); ++i) {
      const size_t k = prescribed.nodes[i];
      values[k] = v[i] - constrained_[k].keep * v[i];
    }
  }
  return values;
}

void AppliedBoundary::complete(const parallel::Part& part) {
  walls_.complete(part);
  std::vector<std::int32_t> chunk_of;
  for (const std::int32_t a : loaded_nodes_)
    chunk_of.push_back(static_cast<std::int32_t>(chunk_of_node(a)));
  part.complete(forces_, chunk_of);
}

void AppliedBoundary::keep(BoundaryState& state) const {
  state.in_step = in_step_;
  state.target = target_;
  if (loads_depend_on_time_) state.forces = forces_;  // others never change
  state.body_loads = body_loads_.time();
  walls_.keep(state.closed);
}

void AppliedBoundary::restore(const BoundaryState& state) {
  in_step_ = state.in_step;
  target_ = state.target;
  if (loads_depend_on_time_) forces_ = state.forces;
  body_loads_.move_to(state.body_loads);
  walls_.restore(state.closed);
}

void AppliedBoundary::begin_step(double t, double dt) {
  if (has_velocities_) {
    in_step_.begin_step(t, dt, [this](double instant) { return prescribed(instant); });
  } else {
    in_step_.begin_step(t, dt);
  }
}

template <int Dim>
ConstraintAction AppliedBoundary::constrain(Body<Dim>& body, double t) {
  const bool has_step = in_step_.step() > 0;
  const bool at_end = has_step && t == in_step_.end();
  const bool in_middle = has_step && t == in_step_.middle();
  if (has_velocities_) {
    target_ = at_end ? in_step_.at_end() : in_middle ? in_step_.at_middle() : prescribed(t);
  }
  ConstraintAction action{overwrite(body), at_end ? kinetic_work(body) : 0};
  if (in_middle && !at_end) {
    walls_.hold_in_middle(body, in_step_.step(), action);
  } else {
    walls_.settle(body, action);
  }
  return action;
}

template <int Dim>
ConstraintAction AppliedBoundary::jump(Body<Dim>& body, double t) {
  if (!has_velocities_ || in_step_.step() == 0) return {};
  target_ = prescribed(t);
  in_step_.jump(t, target_);
  const ConstraintAction action{overwrite(body), kinetic_work(body)};
  in_step_.jump(t, target_);  // the rate is not that of the jump
  return action;
}

/// What the kinetic energy of the prescribed velocities has grown by in the step, whatever they did
/// in between  [J]
template <int Dim>
double AppliedBoundary::kinetic_work(const Body<Dim>& body) const {
  if (!has_velocities_) return 0;
  return parallel::sum_over<double>(
      body.part(), chunks_of_constrained_, [&](std::int64_t k, double& work) {
        const ConstrainedNode& c = constrained_[k];
        work += 0.5 * body.options.rho_R * c.Omega * in_step_.growth_of_square(k);
      });
}

template <int Dim>
ConstraintAction AppliedBoundary::constrain_stage(Body<Dim>& body,
                                                  const StageCombination& stage,
                                                  const StageCombination& next,
                                                  double fraction) {
  for (size_t k = 0; has_velocities_ && k < target_.size(); ++k)
    target_[k] = stage.alpha * in_step_.at_begin()[k] +
                 stage.beta * (target_[k] + stage.dt * in_step_.rate(k, fraction));
  ConstraintAction action{overwrite(body), 0};
  walls_.hold(body, stage, next, action);
  return action;
}

template <int Dim>
Vec3 AppliedBoundary::lag_of_moment(const Body<Dim>& body,
                                    const StageCombination& stage,
                                    double fraction) const {
  if (constrained_.empty() && walls_.empty()) return Vec3::Zero();  // on all ranks
  const auto lag = parallel::sum_over<VectorSum>(
      body.part(), chunks_of_constrained_, [&](std::int64_t k, VectorSum& sum) {
        const ConstrainedNode& c = constrained_[k];
        const StageBegin begin = stage_begin(body, c.node, c.Omega, stage);
        const Vec3 force = force_on(body, k, fraction);
        sum.value +=
            stage.beta * stage.dt * (begin.u - vector_at<Dim>(body.u, c.node)).cross(force);
      });
  return walls_.empty() ? lag.value : Vec3(lag.value + walls_.lag_of_moment(body, stage));
}

template <int Dim>
double AppliedBoundary::withheld(const Body<Dim>& body, const Projection& made) const {
  return parallel::sum_over<double>(
      body.part(), chunks_of_constrained_, [&](std::int64_t k, double& energy) {
        const ConstrainedNode& c = constrained_[k];
        const Vec3 x = X_[c.node] + vector_at<Dim>(body.u, c.node);
        const Vec3 change = made.spin.cross(x - made.centre);
        const Vec3 mean = vector_at<Dim>(body.v, c.node) - 0.5 * change;
        energy += body.options.rho_R * c.Omega * mean.dot(change - c.keep * change);
      });
}

template <int Dim>
Impulse AppliedBoundary::overwrite(Body<Dim>& body) const {
  return parallel::sum_over<Impulse>(
      body.part(), chunks_of_constrained_, [&](std::int64_t k, Impulse& sum) {
        const ConstrainedNode& c = constrained_[k];
        const Vec3 before = vector_at<Dim>(body.v, c.node);
        Vec3 after = c.keep * before;
        if (has_velocities_) after += target_[k];
        for (int i = 0; i < Dim; ++i)
          body.v.set(c.node, i, after[i]);
        after = vector_at<Dim>(body.v, c.node);  // as the state has it
        const Vec3 impulse = body.options.rho_R * c.Omega * (after - before);
        const Vec3 x = X_[c.node] + vector_at<Dim>(body.u, c.node);
        sum.linear += impulse;
        sum.angular += x.cross(impulse);
      });
}

/// Shares of the patch's nodes in its deformed area: of the volumes that carry the pressure, which
/// then a uniform pressure balances exactly; of the nodes' own deformation elsewhere.
template <int Dim>
std::vector<Vec3> AppliedBoundary::deformed_areas(const Body<Dim>& body,
                                                  const BoundaryPatch& patch) const {
  if (body.bulk) return body.bulk->deformed_areas(body, patch);
  std::vector<Vec3> area;
  for (size_t k = 0; k < patch.nodes.size(); ++k) {
    algebra::Tensor<double> F = algebra::identity<double>();
    for (int ij = 0; ij < Dim * Dim; ++ij)
      F(ij / Dim, ij % Dim) += body.F.at(patch.nodes[k], ij);
    area.emplace_back(algebra::to_eigen(algebra::cofactor(F)) * patch.area[k]);
  }
  return area;
}

template <int Dim>
void AppliedBoundary::evaluate_loads(const Body<Dim>& body, double t) {
  std::vector<std::vector<Vec3>> areas(conditions_.size());
  for (size_t c = 0; c < areas.size(); ++c) {
    const PlacedCondition& placed = conditions_[c];
    if (placed.condition->loads() && placed.condition->follows_surface())
      areas[c] = deformed_areas(body, *placed.patch);
  }
  const parallel::Part& part = body.part();
  if (part.is_whole()) {
    evaluate_own_loads(part, areas, t);
  } else {
    parallel::agree_on(part.ranks(), [&] { evaluate_own_loads(part, areas, t); });
  }
  loads_are_current_ = !loads_depend_on_time_;
}

/// An expression may have no value at a node of this rank alone.
void AppliedBoundary::evaluate_own_loads(const parallel::Part& part,
                                         const std::vector<std::vector<Vec3>>& areas,
                                         double t) {
  std::fill(forces_.begin(), forces_.end(), Vec3::Zero());
  if (body_force_) {
    const std::vector<Vec3> f = body_force_->at(t);  // then all nodes are loaded
    for (size_t k = 0; k < loaded_nodes_.size(); ++k) {
      if (part.owns(chunk_of_node(loaded_nodes_[k]))) forces_[k] += Omega_[k] * f[k];
    }
  }
  if (body_loads_.is_there()) body_loads_.move_to(t);
  for (size_t c = 0; c < areas.size(); ++c) {
    const PlacedCondition& placed = conditions_[c];
    if (!placed.condition->loads()) continue;
    const auto vector = given_[c].vector ? given_[c].vector->at(t) : std::vector<Vec3>{};
    const auto scalar = given_[c].scalar ? given_[c].scalar->at(t) : std::vector<double>{};
    for (size_t k = 0; k < placed.patch->nodes.size(); ++k) {
      const std::int32_t a = placed.patch->nodes[k];
      if (!part.owns(chunk_of_node(a))) continue;
      LoadedNode node{X_user_[a], placed.patch->area[k], 0, Vec3::Zero(), Mat3::Zero()};
      if (!given_[c].sizes.empty()) node.size = given_[c].sizes[k];
      if (placed.condition->needs_P()) node.P = body_loads_.known().stress(a);
      if (!areas[c].empty()) node.deformed_area = areas[c][k];
      if (!vector.empty()) node.vector = vector[k];
      if (!scalar.empty()) node.scalar = scalar[k];
      forces_[slot_of_node_[a]] += placed.condition->force(node, t);
    }
  }
}

template <int Dim>
LoadRates AppliedBoundary::add_loads(Body<Dim>& body, double t) {
  if (!loads_are_current_) evaluate_loads(body, t);
  LoadRates rates = body_loads_.is_there() ? body_loads_.add_to(body) : LoadRates{};
  rates += parallel::sum_over<LoadRates>(
      body.part(), chunks_of_loaded_, [&](std::int64_t k, LoadRates& sum) {
        const std::int32_t a = loaded_nodes_[k];
        for (int i = 0; i < Dim; ++i)
          body.T.add(a, i, forces_[k][i]);
        sum.power += forces_[k].dot(vector_at<Dim>(body.v, a));
        sum.force += forces_[k];
        sum.torque += (X_[a] + vector_at<Dim>(body.u, a)).cross(forces_[k]);
      });
  return rates;
}

template <int Dim>
double AppliedBoundary::power_of_loads(const Body<Dim>& body) const {
  const double known = body_loads_.is_there() ? body_loads_.power(body) : 0;
  return known + parallel::sum_over<double>(
                     body.part(), chunks_of_loaded_, [&](std::int64_t k, double& power) {
                       power += forces_[k].dot(vector_at<Dim>(body.v, loaded_nodes_[k]));
                     });
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                  \
  template ConstraintAction AppliedBoundary::constrain(Body<Dim>&, double);                       \
  template ConstraintAction AppliedBoundary::jump(Body<Dim>&, double);                            \
  template ConstraintAction AppliedBoundary::constrain_stage(Body<Dim>&, const StageCombination&, \
                                                             const StageCombination&, double);    \
  template double AppliedBoundary::withheld(const Body<Dim>&, const Projection&) const;           \
  template void AppliedBoundary::evaluate_loads(const Body<Dim>&, double);                        \
  template LoadRates AppliedBoundary::add_loads(Body<Dim>&, double);                              \
  template double AppliedBoundary::power_of_loads(const Body<Dim>&) const;                        \
  template Vec3 AppliedBoundary::lag_of_moment(const Body<Dim>&, const StageCombination&, double) \
      const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
