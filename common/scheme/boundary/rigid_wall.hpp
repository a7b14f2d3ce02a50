#pragma once
/// Frictionless contact of nodes with fixed rigid planes (notes 3.6), by impulses.
///
/// A node is open or closed. Within a step a closed node keeps v_n = 0 and an open one is free. An
/// open node that the last stage of a step would carry through the plane is given the normal
/// velocity, before that stage, with which the step ends on the plane: its position needs no change
/// of its own, F remains the gradient of x, and no node is inside the wall at the end of a step. At
/// the end of the step
///   - a closed node whose force pulls it off the wall (traction would be tensile) is let go,
///   - a node that has landed is closed: v_n becomes 0.
/// The wall's work is what the kinetic energy of the node has changed by beyond the work of the
/// other forces on it, with the weights of the stages: about -1/2 m v_n^2 of the node that hits.
/// The impact of a body loses the kinetic energy of the layer of nodes that hits, a fraction that
/// falls with h (the waves that carry the rest are the scheme's own).
///
/// Bouncing nodes back instead would keep the energy of the layer but leave it as noise of the
/// shortest waves, and a penalty has a stiffness to choose and shortens the stable step.
///
/// A node may have several walls where an impulse of one leaves what another one sees as it is
/// (they are at right angles), or where it cannot be at both (they face each other).
/// Test: tests/common/scheme/rigid_wall_test.cpp

#include "common/scheme/body/body.hpp"
#include "common/scheme/body/stage_combination.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/budget/audit.hpp"

#include <unordered_map>
#include <vector>

namespace diptych::scheme {

/// A node that may touch a wall.
struct WallCandidate {
  std::int32_t node = 0;
  double Omega = 0;  ///< m^3
  Vec3 X;            ///< m
  Vec3 X_centred;    ///< m, for moments
  Mat3 keep;         ///< projector on the directions that other conditions leave free
  const BoundaryPatch* patch = nullptr;  ///< that it is of
};

class WallContacts {
 public:
  /// A node that the wall cannot push, since it is held, is left out.
  /// @throws base::InputError where the node has another wall, neither at right angles to this one
  /// nor facing it
  void add(const RigidWall& wall, const WallCandidate& candidate);
  /// To be called once all nodes are there.
  void list_chunks();
  bool empty() const { return nodes_.empty(); }
  /// To be called with the state that a run begins with: within steps no node comes behind a wall.
  /// @throws base::InputError where one stands there by more than rounding, with the deepest
  template <int Dim>
  void require_in_front(const Body<Dim>& body) const;
  /// Among ranks: takes what the owners of nodes know of them.
  void complete(const parallel::Part& part);

  /// Copies which nodes are closed into `closed`, and back.
  void keep(std::vector<char>& closed) const;
  void restore(const std::vector<char>& closed);

  /// After a stage that is not the last: closed nodes keep v_n = 0, and open ones that the next
  /// stage, if it is the last, would carry through the plane land on it. Adds the impulse.
  template <int Dim>
  void hold(Body<Dim>& body,
            const StageCombination& stage,
            const StageCombination& next,
            ConstraintAction& action);

  /// The same in the middle of a step of leapfrog, between kick and drift.
  template <int Dim>
  void hold_in_middle(Body<Dim>& body, double dt, ConstraintAction& action);

  /// AppliedBoundary::lag_of_moment of closed nodes.
  template <int Dim>
  Vec3 lag_of_moment(const Body<Dim>& body, const StageCombination& stage) const;

  /// At the end of a step: lets go and catches. Adds impulse and work.
  template <int Dim>
  void settle(Body<Dim>& body, ConstraintAction& action);

  /// Force of the wall on those of these nodes (ascending) that are closed  [N]
  template <int Dim>
  Vec3 force(const Body<Dim>& body, const std::vector<std::int32_t>& nodes) const;

  /// What these forces take from the sum of |T|^2/m over all nodes  [N^2/kg]
  template <int Dim>
  double squared_forces(const Body<Dim>& body) const;

  /// What they take from sum f.a over nodes with loads f  [W/s]
  /// @param loads           N
  /// @param slot_of_node    [n_nodes] into loads, -1
  template <int Dim>
  double power_gain_withheld(const Body<Dim>& body,
                             const std::vector<Vec3>& loads,
                             const std::vector<std::int32_t>& slot_of_node) const;

 private:
  struct WallNode {
    WallCandidate body;
    RigidWall wall;
    Vec3 push;  ///< free direction with push . normal = 1
    bool closed = false;
    bool lands = false;        ///< in this step
    double v_begin = 0;        ///< m/s along push, at the beginning of the step where it lands
    double work_of_force = 0;  ///< J, of T along push over the step so far

    Vec3 along() const { return push.normalized(); }
    /// Of the same node.
    bool acts_apart_from(const WallNode& other) const;
  };
  std::vector<WallNode> nodes_;  ///< ascending, those of one node together
  std::unordered_multimap<std::int32_t, size_t> places_of_node_;  // in nodes_, while they are added
  parallel::ChunksOfList chunks_;
  StageCombination last_;  ///< that ends the step

  /// act(node, sum of what is done) for the nodes of this rank.
  template <int Dim, class Act>
  void act_on_nodes(Body<Dim>& body, ConstraintAction& action, const Act& act);
  template <int Dim>
  static void set_normal_velocity(const WallNode& w,
                                  double v_n,
                                  Body<Dim>& body,
                                  ConstraintAction& action);
  template <int Dim>
  static void add_work_of_force(WallNode& w, const Body<Dim>& body, const StageCombination& stage);
};

}  // namespace diptych::scheme
