#pragma once
/// Frictionless contact of nodes with fixed rigid planes (notes 3.6), by impulses.
///
/// A node is open or closed. Within a step a closed node keeps v_n = 0 and an open one is free; at
/// the end of the step
///   - a closed node whose force pulls it off the wall (traction would be tensile) is let go,
///   - an open node that would reach the wall in less than half a step is caught: v_n becomes 0.
/// Catching takes 1/2 m v_n^2 from the node and nothing ever gives energy: the impact of a body
/// loses the kinetic energy of the layer of nodes that hits, a fraction that falls with h (the
/// waves that carry the rest are the scheme's own). A caught node stays within |v_n| dt / 2 of the
/// plane, on either side; it is not moved there, which would need work.
///
/// Bouncing nodes back instead would keep the energy of the layer but leave it as noise of the
/// shortest waves, and a penalty has a stiffness to choose and shortens the stable step.
/// Test: tests/common/scheme/rigid_wall_test.cpp

#include "common/scheme/body/body.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/budget/audit.hpp"

#include <vector>

namespace diptych::scheme {

/// A node that may touch a wall.
struct WallCandidate {
  std::int32_t node = 0;
  double Omega = 0;  ///< m^3
  Vec3 X;            ///< m
  Vec3 X_centred;    ///< m, for moments
  Mat3 keep;         ///< projector on the directions that other conditions leave free
};

class WallContacts {
 public:
  /// A node that the wall cannot push, since it is held, is left out.
  /// @throws base::InputError where the node already has another wall
  void add(const RigidWall& wall, const WallCandidate& candidate);
  bool empty() const { return nodes_.empty(); }

  /// Copies which nodes are closed into `closed`, and back.
  void keep(std::vector<char>& closed) const;
  void restore(const std::vector<char>& closed);

  /// Within a step: closed nodes keep v_n = 0. Adds the impulse.
  template <int Dim>
  void hold(Body<Dim>& body, ConstraintAction& action) const;

  /// At the end of a step of dt: lets go and catches. Adds impulse and work.
  template <int Dim>
  void settle(Body<Dim>& body, double dt, ConstraintAction& action);

  /// Force of the wall on those of these nodes (ascending) that are closed  [N]
  template <int Dim>
  Vec3 force(const Body<Dim>& body, const std::vector<std::int32_t>& nodes) const;

 private:
  struct WallNode {
    WallCandidate body;
    RigidWall wall;
    Vec3 push;  ///< free direction with push . normal = 1
    bool closed = false;
  };
  std::vector<WallNode> nodes_;

  template <int Dim>
  static double stop(const WallNode& w, Body<Dim>& body, ConstraintAction& action);
};

}  // namespace diptych::scheme
