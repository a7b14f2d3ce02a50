#pragma once
/// Boundary conditions (notes 3.6). A condition acts on a patch: it constrains velocity
/// components of its nodes (strongly, after every stage), or loads its nodes with forces, or both.
/// Adding one: a file here and a line in conditions.def.

#include "common/base/registry.hpp"
#include "common/scheme/boundary/field_function.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::scheme {

using VectorFunction = FieldFunction<Vec3>;
using ScalarFunction = FieldFunction<double>;

/// What the user gave for a condition; unused members are empty.
struct BoundaryValues {
  VectorFunction vector;       ///< traction [Pa] or velocity [m/s]
  ScalarFunction scalar;       ///< pressure [Pa]
  Vec3 point = Vec3::Zero();   ///< m, of a rigid wall
  Vec3 normal = Vec3::Zero();  ///< of a rigid wall, towards the body; any length
  bool known = false;          ///< traction from the stress of a known motion
  bool depends_on_time = false;
};

/// The velocity components a condition prescribes at one node.
struct NodeConstraint {
  std::int32_t node = 0;
  std::vector<Vec3> directions;  ///< unit vectors, need not be orthogonal
  VectorFunction velocity;       ///< empty: zero
};

/// A fixed rigid plane in space; the body is on the side that the normal points to.
struct RigidWall {
  Vec3 point;   ///< m
  Vec3 normal;  ///< unit vector
};

/// A loaded node at one instant.
struct LoadedNode {
  Vec3 X;           ///< m, reference position
  Vec3 area;        ///< m^2, its share of the patch, A_a N_a
  double size = 0;  ///< m^2, the same as a number (areas_as_numbers)
  /// m^2, where the deformed body has it: H A_a N_a, or, where volumes of cells carry the pressure,
  /// its share of the deformed faces. Follower loads only.
  Vec3 deformed_area;
  Mat3 P;  ///< Pa, stress of a known motion, its tractions only
  // the functions of BoundaryCondition::given() here and now
  Vec3 vector = Vec3::Zero();  ///< Pa
  double scalar = 0;           ///< Pa
};

class BoundaryCondition {
 public:
  virtual ~BoundaryCondition() = default;
  /// Constraints on the patch's nodes; none by default.
  virtual std::vector<NodeConstraint> constraints(const PairGraph& graph,
                                                  const BoundaryPatch& patch) const;
  /// The wall that the patch's nodes may touch; none by default.
  virtual std::optional<RigidWall> wall() const { return std::nullopt; }
  /// Whether force() may be non-zero.
  virtual bool loads() const { return false; }
  virtual bool follows_surface() const { return false; }
  virtual bool needs_P() const { return false; }
  virtual bool depends_on_time() const { return false; }
  /// What force() reads as values of the node; null: nothing.
  virtual const BoundaryValues* given() const { return nullptr; }
  /// Force on a node of the patch  [N]
  virtual Vec3 force(const LoadedNode& node, double t) const;
};

/// A condition as case files know it.
struct BoundaryKind {
  enum class Takes { nothing, vector, scalar, plane };  ///< members of BoundaryValues
  enum class Acts {
    load,       ///< forces: with any other kind of load, and with a constraint
    constrain,  ///< some components of the velocity: with loads
    hold,       ///< all of them: alone
    touch       ///< a wall that the group may touch: with loads and constraints
  };
  std::unique_ptr<BoundaryCondition> (*make)(const BoundaryValues& values);
  Takes takes = Takes::nothing;
  Acts acts = Acts::load;
  std::string note{};  ///< what stands behind its name in the reference of keys, or empty
};

#define DIPTYCH_BOUNDARY(name, function) BoundaryKind function##_condition();
#include "common/scheme/boundary/conditions.def"
#undef DIPTYCH_BOUNDARY

/// All of conditions.def by name.
const base::Registry<BoundaryKind>& boundary_menu();

/// Unit normal of a node's share of a patch; components below 1e-12 are rounding and become 0.
Vec3 unit_normal(const Vec3& area);

}  // namespace diptych::scheme
