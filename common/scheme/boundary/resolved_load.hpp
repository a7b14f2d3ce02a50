#pragma once
/// Loads at nodes whose forces are right where the load changes within a face: a traction on a
/// strip, a jump between two nodes, what travels. Nodes see a load at their own places, so a strip
/// between two of them would give no force at all, another one twice its own. On faces that the
/// nodes do not resolve the difference to what nodes can see goes to the corners by their shape
/// functions:
///   f_a = f(X_a) + 1/A_a sum over these faces of int (f - sum_b f(X_b) phi_b) phi_a dA,
/// so that the force is that of the integral. Linear f changes nothing, and what is smooth is left
/// to the nodes, whose areas are of higher order than such integrals. Source: notes 3.6. Test:
/// tests/common/scheme/resolved_load_test.cpp

#include "common/scheme/boundary/field_function.hpp"
#include "common/scheme/boundary/patch_faces.hpp"

#include <optional>
#include <string>

namespace diptych::scheme {

/// How a load acts on a patch, at the instants at which it is looked at.
struct SeenLoad {
  bool within_faces = false;
  /// A node at which a load acts that does not depend on time, though no place within a face sees
  /// it: it has hardly an area, and the nodes carry none of it.
  std::optional<Vec3> on_nodes_alone;
};

/// @param load   Pa; nodes alone see what does not depend on the place
/// @param X      [nodes] m
/// @param area   [nodes] their shares of it  [m^2]
/// @param faces  of which the nodes are the corners
/// @param seen   receives how it acts there
/// @throws base::InputError where the load has no value
template <class Value>
std::unique_ptr<PlacedField<Value>> resolved_load(const FieldFunction<Value>& load,
                                                  std::span<const Vec3> X,
                                                  std::span<const double> area,
                                                  std::span<const PatchFace> faces,
                                                  SeenLoad& seen);

/// What is said of a load that acts on nodes alone on all patches that it is for.
std::string no_area_for(const Vec3& node);

}  // namespace diptych::scheme
