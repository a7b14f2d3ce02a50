#pragma once
/// Values between nodes: what a field is at a place, from those at the nodes around it.
/// Test: tests/common/run/interpolation_test.cpp

#include "common/run/checkerboard.hpp"

namespace diptych::run {

/// Sum of the sizes of weights that interpolate: 2 at most in the cell at a corner of a box.
inline constexpr double most_size_of_weights = 2.5;

/// Weights of nodes whose sum is one.
struct Interpolation {
  std::vector<std::int32_t> nodes;  ///< ascending
  std::vector<double> weights;      ///< [nodes]
};

/// What places between nodes ask of the mesh.
struct MeshAround {
  NodesAround nodes;
  /// Nodes of the cells that hold a place; none where it is outside the body.
  std::function<std::vector<std::int32_t>(const Vec3& place)> cells_at;
};

/// The nodes next to a place, of those that share a cell with `corners`: all that are as near as
/// rounding tells, so that a place in the middle of a cell has its neighbours on all sides.
std::vector<std::int32_t> nearest_nodes(const Vec3& place,
                                        const std::vector<Vec3>& X,
                                        const std::vector<std::int32_t>& corners,
                                        const NodesAround& around);

/// Exact for quadratics where the nodes within three rings of cells determine them, else for linear
/// fields; of those weights the least, nearer nodes counting more (moving least squares). The
/// nearest node alone where the place is at it, and where there are no others. Where weights are
/// large, the place is hardly inside, or the nodes hardly determine such a field: wider rings, then
/// linear fields are tried.
/// @param X        [n_nodes] m
/// @param nearest  nearest_nodes() of `place`
/// @param spacing  of the nodes there  [m]
Interpolation interpolation_at(const Vec3& place,
                               const std::vector<Vec3>& X,
                               int dimension,
                               const std::vector<std::int32_t>& nearest,
                               double spacing,
                               const NodesAround& around);

}  // namespace diptych::run
