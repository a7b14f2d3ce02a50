#pragma once
/// How much of a field alternates between neighbours: what linear fits to the neighbours of each
/// node leave of it, over what it differs from its mean (probes of this kind).
/// Test: tests/common/run/checkerboard_test.cpp

#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace diptych::run {

using algebra::Vec3;

/// Adds to `nodes` those that share a cell with node a, in any order, node a and repetitions too.
using NodesAround = std::function<void(std::int32_t a, std::vector<std::int32_t>& nodes)>;

/// Nodes up to so many rings of cells around node a, ascending, with itself.
std::vector<std::int32_t> nodes_within(std::int32_t a, int rings, const NodesAround& around);

class Checkerboard {
 public:
  /// @param X       [n_nodes] m
  /// @param Omega   [n_nodes] m^3 (m^2 in 2-D), for the spacing
  /// @param around  where the nodes that share a cell lie in a plane (3-D) or on a line (2-D), or
  ///                are fewer than a linear field has numbers, the next ring counts too
  Checkerboard(const std::vector<Vec3>& X,
               const std::vector<double>& Omega,
               int dimension,
               const NodesAround& around);

  /// |q - S q| / |q - <q>|, norms and mean with weights: S q of a node is the value there of the
  /// linear field that fits those of its neighbours best, so that a smooth field leaves nothing to
  /// second order, up to the boundary. About one for a field that alternates along every line, 0
  /// for one that is uniform to rounding.
  /// @param q, weights  [n_nodes]; the volumes, 0 at nodes that are left out
  double part_of(std::span<const double> q, std::span<const double> weights) const;

 private:
  std::vector<std::int64_t> first_;      ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour_;  ///< without the node itself
  std::vector<double> weight_;           ///< of the neighbour's value in S q; their sum is one
};

}  // namespace diptych::run
