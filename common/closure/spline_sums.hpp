#pragma once
/// Sums over the splines that nodes feel, for the preconditioner of spline_levels.hpp.

#include "common/algebra/four.hpp"

#include <array>
#include <cstdint>

namespace diptych::closure {

using algebra::Four;
using algebra::Vec3;
using SplineIndex = std::array<int, 3>;

/// The splines of the finest level that a node feels.
struct NodeSplines {
  std::int64_t first = 0;  ///< index of the lowest spline
  double value[3][3];      ///< by direction
};

/// h/3 times their slopes, where fields have gradients.
struct NodeSlopes {
  double value[3][3];
};

/// grid[first...] += w r over the splines of a node, value = {x, y, z} per direction.
void spread_nodes(const std::int32_t* begin,
                  const std::int32_t* end,
                  const NodeSplines* splines,
                  const SplineIndex& n,
                  int n_z,
                  const Vec3* r,
                  Four* grid);

/// z += the splines of nodes [begin, end).
void gather_nodes(std::int64_t begin,
                  std::int64_t end,
                  const NodeSplines* splines,
                  const SplineIndex& n,
                  int n_z,
                  const Four* grid,
                  Vec3* z);

/// The same of fields with gradients, 1 + d vectors a node.
void spread_nodes_with_slopes(const std::int32_t* begin,
                              const std::int32_t* end,
                              const NodeSplines* splines,
                              const NodeSlopes* slopes,
                              const SplineIndex& n,
                              int d,
                              const Vec3* r,
                              Four* grid);

void gather_nodes_with_slopes(std::int64_t begin,
                              std::int64_t end,
                              const NodeSplines* splines,
                              const NodeSlopes* slopes,
                              const SplineIndex& n,
                              int d,
                              const Four* grid,
                              Vec3* z);

}  // namespace diptych::closure
