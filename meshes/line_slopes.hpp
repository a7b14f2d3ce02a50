#pragma once
/// Slopes of a field at the nodes of an undistorted block, for the reconstruction of jumps between
/// neighbours a, b on a line of nodes:
///   jump_ab = v_b - v_a - 1/2 (G_a + G_b)(X_b - X_a),
///   G_a = sum_b (v_b - v_a) (x) weight_ab.
/// With d_i = v_{i+1} - v_i they are, from the end of a line on,
///   (3 d_0 - d_1)/2,  (3 d_0 + 6 d_1 - d_2)/8,  (-d_{i-2} + 5 d_{i-1} + 5 d_i - d_{i+1})/8, ..
/// so that the jumps of a line are D^T D d/16 with the second differences D: a fifth difference of
/// v inside, which vanishes for polynomials of degree four, a third at the two ends. Hence sum d_i
/// jump_i = |D d|^2/16 >= 0 on every line, and for waves of length 2 h it is d_i^2, as without
/// slopes. Where pairs near the ends have other areas s_i than the middle of the line they are
/// changed such that s_i jump_i is what it would be with the same area everywhere. On lines of
/// three nodes D d is a first difference: (d_0 - d_1)/4.
/// Source: notes 3.4; undivided differences of this form as dissipation beside operators that sum
/// by parts: Mattsson, Svard, Nordstrom, J. Sci. Comput. 21 (2004) 57. Test:
/// tests/graphs/line_slopes_test.cpp

#include "common/algebra/shared_vectors.hpp"
#include "meshes/structured_block.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace diptych::meshes {

/// Rows of weights, as a pair graph has them: structurally symmetric, ascending.
struct LineSlopes {
  std::vector<std::int64_t> row;        ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour;  ///< [n_pairs]
  algebra::SharedVectors weight;        ///< [n_pairs] 1/m
};

/// Weights of v_j - v_i in the slope of a node i of a line, j and weight, in units of 1/spacing.
using SlopeRow = std::vector<std::pair<int, double>>;

/// Of all nodes of a line. @param area  of its pairs, one fewer than it has nodes; the same but
/// near the ends, within three pairs
std::vector<SlopeRow> slopes_of_line(const std::vector<double>& area);

/// @param edges  of a cell, as columns  [m]
/// @param area   area(a, b) of neighbouring nodes, in any unit
LineSlopes line_slopes(const StructuredBlock& block,
                       const Mat3& edges,
                       const std::function<double(std::int32_t, std::int32_t)>& area);

}  // namespace diptych::meshes
