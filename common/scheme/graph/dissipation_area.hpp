#pragma once
/// The area with which a pair dissipates.

#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::scheme {

/// |S_ab|, S_ab = (C_ab - C_ba)/2, of pairs whose area points from a to b; others, which wide
/// derivatives have at a distance, dissipate nothing. A jump between linear reconstructions over
/// such a pair can have the opposite sign of the plain one: of a node at the end of a line of order
/// 4 the pairs of two and three spacings pumped 0.11 c/h into it, and inside they made most of
/// D_ab.
/// No graph of the edge stencil or of the integral one has such pairs. Of SPH the repair of the
/// closure (notes 3.3) may turn the areas of a few of ten thousand pairs at sharp corners of
/// irregular meshes (case spinning-top, at its tip); lattices and rings have none.
/// Test: tests/graphs/identities_test.cpp
/// @param S_ab  or any positive multiple of it
/// @param X_ab  X_b - X_a
inline double dissipation_area(const Vec3& S_ab, const Vec3& X_ab) {
  return S_ab.dot(X_ab) > 0 ? S_ab.norm() : 0;
}

}  // namespace diptych::scheme
