#pragma once
/// The centroid of an undeformed body: moments are taken about it.

#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::scheme {

/// sum Omega_a X_a / sum Omega_a  [m]
inline Vec3 centroid_of(const PairGraph& graph) {
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    sum += graph.Omega[a] * graph.X[a];
    volume += graph.Omega[a];
  }
  return sum / volume;
}

}  // namespace diptych::scheme
