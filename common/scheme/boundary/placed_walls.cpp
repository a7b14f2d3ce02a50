/// Which nodes the walls of a body may push.

#include "common/scheme/boundary/applied_boundary.hpp"

#include <algorithm>

namespace diptych::scheme {

/// Walls push nodes only along the directions that the other conditions leave free.
void AppliedBoundary::place_walls(const PairGraph& graph) {
  for (const PlacedCondition& placed : conditions_) {
    const std::optional<RigidWall> wall = placed.condition->wall();
    if (!wall) continue;
    for (const std::int32_t node : placed.patch->nodes) {
      const auto held = std::lower_bound(
          constrained_.begin(), constrained_.end(), node,
          [](const ConstrainedNode& c, std::int32_t other) { return c.node < other; });
      const bool is_held = held != constrained_.end() && held->node == node;
      const Mat3 keep = is_held ? held->keep : Mat3(Mat3::Identity());
      walls_.add(*wall, {node, graph.Omega[node], graph.X[node], X_[node], keep, placed.patch});
    }
  }
  walls_.list_chunks();
}

}  // namespace diptych::scheme
