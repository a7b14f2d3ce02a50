#pragma once
/// All boundary conditions and body forces of a body, gathered per node: velocity constraints as a
/// projection on the intersection of what is prescribed, loads as forces. Acts on the state after
/// every stage and on the force field before every update, and tells the audit what it did.

#include "common/scheme/audit.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/boundary/known_loads.hpp"
#include "common/scheme/state.hpp"

#include <vector>

namespace diptych::scheme {

/// A condition with the patch it acts on.
struct PlacedCondition {
  std::unique_ptr<BoundaryCondition> condition;
  const BoundaryPatch* patch = nullptr;  ///< of the graph, which outlives this
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

  bool has_constraints() const { return !constrained_.empty(); }
  bool has_loads() const { return !loaded_nodes_.empty(); }

  /// Overwrites the prescribed velocity components at time t.
  /// @return impulse of the constraint forces: sum rho Omega (v after - v before), and its moment
  template <int Dim>
  Impulse constrain(State<Dim>& state, double rho_R, double t) const;

  /// Adds the loads at time t to state.T. @return their power and their force and torque
  template <int Dim>
  LoadRates add_loads(State<Dim>& state, double t);

  /// Power of the loads that add_loads put in last, with the velocities as they are now  [W]
  template <int Dim>
  double power_of_loads(const State<Dim>& state) const;

  /// Power of the constraint forces, from the force field (loads included) and the acceleration of
  /// the prescribed velocities (difference over a tenth of dt)  [W]. Zero where all prescribed
  /// velocities are.
  template <int Dim>
  double power_of_constraints(const State<Dim>& state, double rho_R, double t, double dt) const;

 private:
  struct ConstrainedNode {
    std::int32_t node = 0;
    double Omega = 0;             ///< m^3
    Vec3 X;                       ///< m
    Mat3 keep;                    ///< projector on the free directions
    VectorFunction velocity;      ///< empty: zero
    VectorFunction acceleration;  ///< empty: by differences
  };
  std::vector<ConstrainedNode> constrained_;
  std::vector<PlacedCondition> conditions_;
  VectorFunction body_force_;
  std::shared_ptr<KnownLoads> known_;  ///< or null
  bool loads_depend_on_time_ = false;
  bool loads_are_current_ = false;
  std::vector<std::int32_t> loaded_nodes_;  ///< ascending
  std::vector<Vec3> forces_;                ///< [loaded_nodes_] N
  std::vector<Vec3> X_;  ///< [n_nodes] m, centred: moments are about the centroid
  std::vector<double> Omega_;
  std::vector<Vec3> X_user_;                ///< [n_nodes] m, as the expressions see them
  std::vector<std::int32_t> slot_of_node_;  ///< [n_nodes] into loaded_nodes_, -1

  void mark_loaded(const std::vector<char>& loaded);
  template <int Dim>
  void evaluate_loads(const State<Dim>& state, double t);
};

}  // namespace diptych::scheme
