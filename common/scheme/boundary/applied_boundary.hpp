#pragma once
/// All boundary conditions and body forces of a body, gathered per node: velocity constraints as a
/// projection on the intersection of what is prescribed, loads as forces. Acts on the state after
/// every stage and on the force field before every update, and tells the audit what it did.

#include "common/scheme/body/body.hpp"
#include "common/scheme/body/stage_combination.hpp"
#include "common/scheme/boundary/body_loads.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/boundary/rigid_wall.hpp"
#include "common/scheme/boundary/shared_nodes.hpp"
#include "common/scheme/boundary/velocities_in_step.hpp"
#include "common/scheme/budget/angular_momentum.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/ranks/untouched.hpp"

#include <vector>

namespace diptych::scheme {

/// What a boundary knows of a step, apart from the state of the body.
struct BoundaryState {
  VelocitiesInStep in_step;
  std::vector<Vec3> target;  ///< m/s, prescribed, as last applied
  std::vector<Vec3> forces;  ///< N, loads, as last applied
  double body_loads = 0;     ///< s, time of those of a known motion
  std::vector<char> closed;  ///< [nodes at walls]
};

class AppliedBoundary {
 public:
  AppliedBoundary() = default;
  /// @param body_force N/m^3 per reference volume, empty: none
  /// @throws base::InputError where two conditions prescribe different velocities at a node
  AppliedBoundary(const PairGraph& graph,
                  std::vector<PlacedCondition> conditions,
                  VectorFunction body_force,
                  bool body_force_depends_on_time);

  /// Adds the body force of a known motion, and its stress for conditions that need it.
  void follow(std::shared_ptr<KnownLoads> known);

  bool has_walls() const { return !walls_.empty(); }
  /// @throws base::InputError where the body, as it begins, stands behind a rigid wall
  template <int Dim>
  void require_in_front_of_walls(const Body<Dim>& body) const {
    walls_.require_in_front(body);
  }
  bool has_loads() const { return !loaded_nodes_.empty() || body_loads_.is_there(); }

  /// Some of the nodes that loads and prescribed velocities act on  [m]
  const std::vector<Vec3>& telling_places() const { return telling_places_; }

  /// Copies what the boundary knows into `state`, and back.
  void keep(BoundaryState& state) const;
  void restore(const BoundaryState& state);

  /// Among ranks: takes what the owners of nodes know of them, so that keep() has it all.
  void complete(const parallel::Part& part);

  /// Among ranks: has the loads that never change, which no archive keeps, on the rank's own nodes.
  template <int Dim>
  void begin_constant_loads(const Body<Dim>& body, double t) {
    if (!loads_depend_on_time_) evaluate_loads(body, t);
  }

  /// Among ranks: gives back what it keeps of these blocks, which are of others.
  void release(const Blocks& untouched) {
    const auto give_back = [&](auto& of_nodes) {
      give_back_blocks(of_nodes.data(), std::ssize(of_nodes), algebra::n_lanes, untouched);
    };
    give_back(X_);
    give_back(Omega_);
    give_back(X_user_);
    give_back(slot_of_node_);
  }

  /// Takes the prescribed velocities of the step from t to t + dt.
  void begin_step(double t, double dt);

  /// Overwrites the prescribed velocity components by their values at time t: the end or the middle
  /// of the step, or the start of the run.
  /// At the end of a step rigid walls also let go and catch nodes.
  /// @return impulse of the constraint forces: sum rho Omega (v after - v before), its moment; the
  ///         work of impacts and, at the end of a step, what the kinetic energy of the prescribed
  ///         velocities has grown by: the rest of their work is power_against_forces()
  template <int Dim>
  ConstraintAction constrain(Body<Dim>& body, double t);
  /// Where a step has ended just before a jump in time: supports move as they do at t, behind it.
  /// @return impulse and what their kinetic energy grows by
  template <int Dim>
  ConstraintAction jump(Body<Dim>& body, double t);

  /// Overwrites them by what the stage alpha v^n + beta (v + dt v') makes of the rate at the
  /// beginning of the stage (fraction of the step). The exact values at the time of the stage would
  /// differ from what the free nodes have then by O(dt^2), and so strain the body beside them.
  /// @param next  the stage that follows: walls look ahead to the end of the step
  template <int Dim>
  ConstraintAction constrain_stage(Body<Dim>& body,
                                   const StageCombination& stage,
                                   const StageCombination& next,
                                   double fraction);

  /// Moment of the stage's constraint forces about where their nodes were when it began, at which
  /// forces have their rates, less that about where they are now, where constrain() and
  /// constrain_stage() book it. Without it moments of supports that move are of first order in dt.
  /// @pre  as for stage_begin(): before projection and constraints  @return N m s
  template <int Dim>
  Vec3 lag_of_moment(const Body<Dim>& body, const StageCombination& stage, double fraction) const;

  /// What held directions keep of the kinetic energy that a projection of the velocities, just
  /// made, has given: the constraints that follow it overwrite them  [J]
  template <int Dim>
  double withheld(const Body<Dim>& body, const Projection& made) const;

  /// Adds the loads at time t to state.T. @return their power and their force and torque
  template <int Dim>
  LoadRates add_loads(Body<Dim>& body, double t);

  /// Power of the loads that add_loads put in last, with the velocities as they are now  [W]
  template <int Dim>
  double power_of_loads(const Body<Dim>& body) const;

  /// sum f.a over what directions are free, f: the loads that add_loads put in last, but for those
  /// of a known motion, a: accelerations by the force field (loads included)  [W/s]. In a kick of
  /// dt the load's power at the mean of the velocities before and after is that after it less
  /// dt/2 times this.
  template <int Dim>
  double power_gain_of_loads(const Body<Dim>& body) const;

  /// Power with which the prescribed velocities, as they are, move against the force field (loads
  /// included)  [W]. Zero where all of them are.
  template <int Dim>
  double power_against_forces(const Body<Dim>& body) const;

  /// What supports and walls take from the sum of |T|^2/m over all nodes, whose rest is that of
  /// m |a|^2  [N^2/kg]
  template <int Dim>
  double squared_reactions(const Body<Dim>& body) const;

  /// Force of the constraints on these nodes (ascending), from the force field (loads included):
  /// what keeps their velocities as prescribed, and what walls exert  [N]
  template <int Dim>
  Vec3 reaction(const Body<Dim>& body, const std::vector<std::int32_t>& nodes) const;

 private:
  struct ConstrainedNode {
    std::int32_t node = 0;
    double Omega = 0;         ///< m^3
    Vec3 X;                   ///< m
    Mat3 keep;                ///< projector on the free directions
    VectorFunction velocity;  ///< empty: zero
  };
  /// One velocity at all constrained nodes that follow it.
  struct PrescribedVelocities {
    VectorFunction velocity;
    std::vector<size_t> nodes;  ///< into constrained_
    std::unique_ptr<PlacedField<Vec3>> placed;
  };
  /// What a condition gives at the nodes of its patch; null or empty: nothing.
  struct GivenLoads {
    std::unique_ptr<PlacedField<Vec3>> vector;
    std::unique_ptr<PlacedField<double>> scalar;
    std::vector<double> sizes;  ///< of the nodes' areas, areas_as_numbers  [m^2]
  };
  std::vector<ConstrainedNode> constrained_;
  std::vector<PrescribedVelocities> velocities_;
  parallel::ChunksOfList chunks_of_constrained_;
  bool has_velocities_ = false;  ///< whether any of them is prescribed other than zero
  VelocitiesInStep in_step_;     ///< of constrained_
  std::vector<Vec3> target_;     ///< [constrained_] m/s, as last applied
  WallContacts walls_;
  std::vector<PlacedCondition> conditions_;
  std::vector<GivenLoads> given_;                  ///< [conditions_]
  std::unique_ptr<PlacedField<Vec3>> body_force_;  ///< at all nodes, or null
  BodyLoads body_loads_;                           ///< of a known motion
  bool loads_depend_on_time_ = false;
  bool loads_are_current_ = false;
  std::vector<std::int32_t> loaded_nodes_;  ///< ascending
  parallel::ChunksOfList chunks_of_loaded_;
  std::vector<Vec3> forces_;  ///< [loaded_nodes_] N
  std::vector<Vec3> X_;       ///< [n_nodes] m, centred: moments are about the centroid
  std::vector<double> Omega_;
  std::vector<Vec3> telling_places_;
  std::vector<Vec3> X_user_;                ///< [n_nodes] m, as functions see them
  std::vector<std::int32_t> slot_of_node_;  ///< [n_nodes] into loaded_nodes_, -1
  /// Of nodes with loads that are constrained, too; ascending.
  struct HeldLoad {
    size_t loaded = 0, constrained = 0;  ///< into loaded_nodes_, constrained_
  };
  std::vector<HeldLoad> held_loads_;
  parallel::ChunksOfList chunks_of_held_loads_;

  void place_velocities();
  void place_loads(const PairGraph& graph);
  void place_walls(const PairGraph& graph);
  void mark_loaded(const std::vector<char>& loaded);
  void list_held_loads();
  std::vector<Vec3> prescribed(double t) const;
  template <int Dim>
  double kinetic_work(const Body<Dim>& body) const;
  template <int Dim>
  Impulse overwrite(Body<Dim>& body) const;
  template <int Dim>
  Vec3 force_on(const Body<Dim>& body, std::int64_t k, double fraction) const;
  template <int Dim>
  std::vector<Vec3> deformed_areas(const Body<Dim>& body, const BoundaryPatch& patch) const;
  template <int Dim>
  void evaluate_loads(const Body<Dim>& body, double t);
  /// @param areas  [conditions_] deformed ones of those that follow the surface
  void evaluate_own_loads(const parallel::Part& part,
                          const std::vector<std::vector<Vec3>>& areas,
                          double t);
};

}  // namespace diptych::scheme
