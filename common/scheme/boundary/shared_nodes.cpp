#include "common/scheme/boundary/shared_nodes.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace diptych::scheme {

namespace {

struct Prescribed {
  VectorFunction velocity;
  const BoundaryPatch* patch = nullptr;
};

[[noreturn]] void refuse(
    const Vec3& X, const BoundaryPatch& held, const Prescribed& moved, double speed, double t) {
  throw base::InputError(fmt::format(
      "groups '{}' and '{}' share the node at ({:g}, {:g}, {:g}): the first holds it in a "
      "direction "
      "in "
      "which the second moves it with {:.6g} m/s at t = {:g} s; give the second a velocity that is "
      "zero there, or the first one the same velocity",
      held.name, moved.patch->name, X[0], X[1], X[2], speed, t));
}

}  // namespace

void check_shared_nodes(const PairGraph& graph,
                        std::span<const PlacedCondition> conditions,
                        std::span<const double> instants) {
  constexpr double rounding = 1e-9;  // of the largest velocity that is looked at
  std::map<std::int32_t, Prescribed> prescribed;
  double largest = 0;
  for (const PlacedCondition& placed : conditions) {
    for (const NodeConstraint& c : placed.condition->constraints(graph, *placed.patch)) {
      if (!c.velocity) continue;
      prescribed[c.node] = {c.velocity, placed.patch};
    }
  }
  if (prescribed.empty()) return;
  struct Conflict {
    std::int32_t node;
    const BoundaryPatch* held;
    double speed, t;
  };
  std::vector<Conflict> conflicts;
  for (const PlacedCondition& placed : conditions) {
    for (const NodeConstraint& c : placed.condition->constraints(graph, *placed.patch)) {
      const auto found = prescribed.find(c.node);
      if (c.velocity || found == prescribed.end()) continue;
      for (const double t : instants) {
        const Vec3 v = found->second.velocity(graph.X[c.node], t);
        largest = std::max(largest, v.norm());
        for (const Vec3& direction : c.directions)
          conflicts.push_back({c.node, placed.patch, std::abs(v.dot(direction.normalized())), t});
      }
    }
  }
  for (const Conflict& one : conflicts) {
    if (one.speed > rounding * largest)
      refuse(graph.X[one.node], *one.held, prescribed[one.node], one.speed, one.t);
  }
}

}  // namespace diptych::scheme
