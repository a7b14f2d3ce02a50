#pragma once
/// Jacobian at a corner of a cell.

namespace diptych::meshes {

/// a x b . c of the edges at a corner, in their right-handed order; in the plane a x b.
/// @tparam Edge  three components: a vector, or an array of values of one cell or of eight
template <class Edge>
auto corner_jacobian(bool is_plane, const Edge& a, const Edge& b, const Edge& c) {
  const auto third = a[0] * b[1] - a[1] * b[0];
  if (is_plane) return third;
  return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + third * c[2];
}

}  // namespace diptych::meshes
