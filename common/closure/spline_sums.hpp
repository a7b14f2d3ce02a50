#pragma once
/// Sums over the splines that nodes feel, for the preconditioner of spline_levels.hpp.

#include "common/algebra/four.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych::closure {

using algebra::Four;
using algebra::Vec3;
using SplineIndex = std::array<int, 3>;

/// The splines of degree P of the finest level that a node feels, P + 1 per direction.
template <int P>
struct NodeSplines {
  std::int64_t first = 0;  ///< index of the lowest spline
  double value[3][P + 1];  ///< by direction
};

/// h/3 times their slopes, where fields have gradients.
template <int P>
struct NodeSlopes {
  double value[3][P + 1];
};

/// Of fields of one vector a node, and of those with gradients.
inline constexpr int quadratic = 2, quartic = 4;

/// The relation between two scales: a spline as a sum of those of a half or a third of its spacing.
struct Refinement {
  int factor = 1, first = 0;        ///< child s of spline j is spline factor * j + first + s
  std::vector<double> weight{1.0};  ///< of its children
};

/// By direction.
using Refinements = std::array<Refinement, 3>;

/// Plane z of a coarse grid += the sums over the children of its splines.
void restrict_plane(const Refinements& to,
                    const SplineIndex& n_fine,
                    const Four* fine,
                    const SplineIndex& n_coarse,
                    int z,
                    Four* coarse);

/// Plane z of a fine grid += what the splines of a coarse one are there.
void refine_plane(const Refinements& to,
                  const SplineIndex& n_coarse,
                  const Four* coarse,
                  const SplineIndex& n_fine,
                  int z,
                  Four* fine);

/// grid[first...] += w r over the splines of a node, value = {x, y, z} per direction.
void spread_nodes(const std::int32_t* begin,
                  const std::int32_t* end,
                  const NodeSplines<quadratic>* splines,
                  const SplineIndex& n,
                  int n_z,
                  const Vec3* r,
                  Four* grid);

/// z += the splines of nodes [begin, end).
void gather_nodes(std::int64_t begin,
                  std::int64_t end,
                  const NodeSplines<quadratic>* splines,
                  const SplineIndex& n,
                  int n_z,
                  const Four* grid,
                  Vec3* z);

/// The same of fields with gradients, 1 + d vectors a node.
void spread_nodes_with_slopes(const std::int32_t* begin,
                              const std::int32_t* end,
                              const NodeSplines<quartic>* splines,
                              const NodeSlopes<quartic>* slopes,
                              const SplineIndex& n,
                              int d,
                              const Vec3* r,
                              Four* grid);

void gather_nodes_with_slopes(std::int64_t begin,
                              std::int64_t end,
                              const NodeSplines<quartic>* splines,
                              const NodeSlopes<quartic>* slopes,
                              const SplineIndex& n,
                              int d,
                              const Four* grid,
                              Vec3* z);

}  // namespace diptych::closure
