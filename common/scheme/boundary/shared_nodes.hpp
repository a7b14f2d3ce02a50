#pragma once
/// Groups that share nodes and ask different things of them.
/// Test: tests/common/scheme/prescribed_velocity_test.cpp

#include "common/scheme/boundary/boundary_condition.hpp"

#include <memory>
#include <span>

namespace diptych::scheme {

/// A condition with the patch it acts on.
struct PlacedCondition {
  std::unique_ptr<BoundaryCondition> condition;
  const BoundaryPatch* patch = nullptr;  ///< of the graph, which outlives this
};

/// @param instants  at which prescribed velocities are looked at  [s]
/// @param speed     of waves, of which rounding is a share  [m/s]
/// @throws base::InputError where two of them differ at a node, or where one condition gives a node
///         a velocity along a direction in which another one holds it; beside what holds a normal
///         or a tangent alone, a tenth of it, as normals of facets are those of a surface
void check_shared_nodes(const PairGraph& graph,
                        std::span<const PlacedCondition> conditions,
                        std::span<const double> instants,
                        double speed);

}  // namespace diptych::scheme
