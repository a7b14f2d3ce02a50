#pragma once
/// The area with which a pair dissipates.

#include "common/scheme/graph/pair_graph.hpp"

#include <algorithm>

namespace diptych::scheme {

/// |S_ab|, S_ab = (C_ab - C_ba)/2, of pairs whose area points from a to b; others, which wide
/// derivatives have at a distance, dissipate nothing. A jump between linear reconstructions over
/// such a pair can have the opposite sign of the plain one: of a node at the end of a line of order
/// 4 the pairs of two and three spacings pumped 0.11 c/h into it, and inside they made most of
/// D_ab.
/// No graph of the edge stencil or of the integral one has such pairs. Of SPH the repair of the
/// closure (notes 3.3) may turn the areas of a few of ten thousand pairs at sharp corners of
/// irregular meshes (case spinning-top, at its tip); lattices and rings have none.
/// With SPH that sums by parts only the nearest neighbours along the lines of nodes dissipate
/// (PairGraph::dissipation_metric): what is left of linear reconstructions is not symmetric there,
/// and the least eigenvalue of its symmetric part on a cube of 7^3 nodes is -0.031 c/h with them
/// and -0.20 c/h with all pairs whose area points forward, which pumped a beam of 3 x 3 cells into
/// pieces.
/// Test: tests/graphs/identities_test.cpp
/// @param S_ab    or any positive multiple of it
/// @param X_ab    X_b - X_a
/// @param metric  PairGraph::dissipation_metric
inline double dissipation_area(const Vec3& S_ab, const Vec3& X_ab, const Mat3& metric) {
  return S_ab.dot(X_ab) > 0 && (metric * X_ab).squaredNorm() <= 1 ? S_ab.norm() : 0;
}

/// |S_ab| of the pair of neighbours a and b  [m^2]
inline double area_between(const PairGraph& graph, std::int32_t a, std::int32_t b) {
  const auto first = graph.neighbour.begin();
  const auto found = std::lower_bound(first + graph.row[a], first + graph.row[a + 1], b);
  const std::int64_t p = found - first;
  return 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]).norm();
}

}  // namespace diptych::scheme
