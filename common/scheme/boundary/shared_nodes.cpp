#include "common/scheme/boundary/shared_nodes.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::scheme {

namespace {

/// Velocities of a node at the instants, and who prescribes them.
struct Prescribed {
  std::vector<Vec3> values;
  const BoundaryPatch* patch = nullptr;
};

using OfNodes = std::map<std::int32_t, Prescribed>;

/// NaN where it has no value, of which a run that gets there tells.
std::vector<Vec3> values_at(const PlacedField<Vec3>& field, double t, size_t n) {
  try {
    return field.at(t);
  } catch (const base::Error&) {
    return std::vector<Vec3>(n, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
}

/// Of a condition; nodes of one patch have one function.
std::vector<std::pair<std::int32_t, Prescribed>> velocities_of(const PairGraph& graph,
                                                               const PlacedCondition& placed,
                                                               std::span<const double> instants) {
  std::vector<std::pair<std::int32_t, Prescribed>> all;
  std::vector<Vec3> X;
  VectorFunction velocity;
  for (const NodeConstraint& c : placed.condition->constraints(graph, *placed.patch)) {
    if (!c.velocity) continue;
    velocity = c.velocity;
    all.push_back({c.node, {{}, placed.patch}});
    X.push_back(graph.X[c.node]);
  }
  if (all.empty()) return all;
  const auto field = velocity.placed(X);
  for (const double t : instants) {
    const std::vector<Vec3> values = values_at(*field, t, all.size());
    for (size_t k = 0; k < all.size(); ++k)
      all[k].second.values.push_back(values[k]);
  }
  return all;
}

std::string place_text(const Vec3& X) {
  return fmt::format("({:g}, {:g}, {:g})", X[0], X[1], X[2]);
}

}  // namespace

void check_shared_nodes(const PairGraph& graph,
                        std::span<const PlacedCondition> conditions,
                        std::span<const double> instants,
                        double speed) {
  // what part of a velocity may be along a normal: those of facets differ from those of a surface
  constexpr double along_normal = 0.1;
  OfNodes prescribed;
  std::vector<std::pair<std::int32_t, Prescribed>> again;
  double largest = 0;
  for (const PlacedCondition& placed : conditions) {
    for (auto& [node, of_node] : velocities_of(graph, placed, instants)) {
      for (const Vec3& v : of_node.values)
        largest = std::max(largest, v.norm());
      const auto [known, is_new] = prescribed.emplace(node, of_node);
      if (!is_new) again.emplace_back(node, of_node);
    }
  }
  const double rounding = std::max(1e-9 * largest, 1e-12 * speed);  // 5*sin(pi*x) at x = 1
  for (const auto& [node, second] : again) {
    const Prescribed& first = prescribed.at(node);
    for (size_t i = 0; i < instants.size(); ++i) {
      if (!((first.values[i] - second.values[i]).norm() > rounding)) continue;
      throw base::InputError(fmt::format(
          "two boundary conditions prescribe different velocities at the node at {}: those of "
          "groups '{}' and '{}' at t = {:g} s; let only one of them hold the nodes that they share",
          place_text(graph.X[node]), first.patch->name, second.patch->name, instants[i]));
    }
  }
  if (prescribed.empty()) return;
  for (const PlacedCondition& placed : conditions) {
    for (const NodeConstraint& c : placed.condition->constraints(graph, *placed.patch)) {
      const auto found = prescribed.find(c.node);
      if (c.velocity || found == prescribed.end()) continue;
      const bool holds_all = static_cast<int>(c.directions.size()) == 3;
      for (size_t i = 0; i < instants.size(); ++i) {
        const Vec3& v = found->second.values[i];
        for (const Vec3& direction : c.directions) {
          const double along = std::abs(v.dot(direction.normalized()));
          const double least = holds_all ? 0 : along_normal * v.norm();
          if (!(along > std::max(rounding, least))) continue;
          throw base::InputError(fmt::format(
              "groups '{}' and '{}' share the node at {}: the first holds it in a direction in "
              "which the second moves it with {:.6g} m/s at t = {:g} s; give the second a velocity "
              "that is zero in that direction there",
              placed.patch->name, found->second.patch->name, place_text(graph.X[c.node]), along,
              instants[i]));
        }
      }
    }
  }
}

}  // namespace diptych::scheme
