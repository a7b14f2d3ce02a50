#pragma once
/// The divergence theorem on first-order cells. Test: tests/meshes/deformed_cells_test.cpp

namespace diptych::meshes {

/// What the cone from the origin to a face has of the volume that outward faces enclose: with m the
/// mean of the corners, the flux of x through the bilinear face of four corners is exactly
/// 1/2 m . ((x_3 - x_1) x (x_4 - x_2)), and a third of it is that volume.
/// @param a, b, c, d  corners, m; of a triangle the fourth is its first
template <class T>
T volume_under_face(const T (&a)[3], const T (&b)[3], const T (&c)[3], const T (&d)[3]) {
  T e[3], f[3], m[3];
  for (int i = 0; i < 3; ++i) {
    e[i] = c[i] - a[i];
    f[i] = d[i] - b[i];
    m[i] = (a[i] + b[i]) + (c[i] + d[i]);
  }
  return (1.0 / 24) * (m[0] * (e[1] * f[2] - e[2] * f[1]) + m[1] * (e[2] * f[0] - e[0] * f[2]) +
                       m[2] * (e[0] * f[1] - e[1] * f[0]));
}

/// The same of an edge in the plane, of area.
template <class T>
T area_under_edge(const T (&a)[3], const T (&b)[3]) {
  return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

}  // namespace diptych::meshes
