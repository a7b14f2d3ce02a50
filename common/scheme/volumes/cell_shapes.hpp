#pragma once
/// Volumes of eight cells at once and their derivatives by the corners (notes 3.9). Faces of four
/// corners are the bilinear ones of the first-order cells: with m = 1/4 sum x the flux of x through
/// such a face is exactly 1/2 m . ((x_3 - x_1) x (x_4 - x_2)), so a cell, of any shape, has
///   V = 1/6 sum_faces m . ((x_3 - x_1) x (x_4 - x_2)).
/// A triangle is a face whose fourth corner is its first. Test:
/// tests/common/scheme/volumes_test.cpp

#include "common/algebra/layout.hpp"

#include <array>

namespace diptych::scheme {

using algebra::Lanes;

/// Faces of a cell with n corners in space, outward.
template <int n>
struct CellFaces;
template <>
struct CellFaces<4> {
  static constexpr std::array<std::array<int, 4>, 4> faces{
      {{0, 2, 1, 0}, {0, 1, 3, 0}, {1, 2, 3, 1}, {0, 3, 2, 0}}};
};
template <>
struct CellFaces<6> {
  static constexpr std::array<std::array<int, 4>, 5> faces{
      {{0, 2, 1, 0}, {3, 4, 5, 3}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
};
template <>
struct CellFaces<8> {
  static constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
};

/// Corners of eight cells, from the first corner of each: a body far away loses no digits.
template <int Dim, int n>
struct CellCorners {
  Lanes x[n][Dim];  ///< m
};

/// dV/dx of each corner  [m^(Dim-1)]
template <int Dim, int n>
struct CellGradient {
  Lanes x[n][Dim];
};

DIPTYCH_INLINE void cross(const Lanes (&a)[3], const Lanes (&b)[3], Lanes (&c)[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/// @return V  [m^Dim]; adds dV/dx to `gradient` where it is not null
template <int n>
DIPTYCH_INLINE Lanes cell_volume(const CellCorners<3, n>& cell, CellGradient<3, n>* gradient) {
  Lanes six_volumes{};
#pragma GCC unroll 6
  for (const auto& face : CellFaces<n>::faces) {
    Lanes e[3], f[3], sum[3], area[3];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      e[i] = cell.x[face[2]][i] - cell.x[face[0]][i];
      f[i] = cell.x[face[3]][i] - cell.x[face[1]][i];
      sum[i] = 0.25 *
               (cell.x[face[0]][i] + cell.x[face[1]][i] + cell.x[face[2]][i] + cell.x[face[3]][i]);
    }
    cross(e, f, area);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
      six_volumes += sum[i] * area[i];
    if (gradient == nullptr) continue;
    Lanes by_e[3], by_f[3];
    cross(f, sum, by_e);
    cross(sum, e, by_f);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Lanes quarter = (1.0 / 24) * area[i];
      gradient->x[face[0]][i] += quarter - (1.0 / 6) * by_e[i];
      gradient->x[face[2]][i] += quarter + (1.0 / 6) * by_e[i];
      gradient->x[face[1]][i] += quarter - (1.0 / 6) * by_f[i];
      gradient->x[face[3]][i] += quarter + (1.0 / 6) * by_f[i];
    }
  }
  return (1.0 / 6) * six_volumes;
}

/// Polygons in the plane.
template <int n>
DIPTYCH_INLINE Lanes cell_volume(const CellCorners<2, n>& cell, CellGradient<2, n>* gradient) {
  Lanes two_areas{};
#pragma GCC unroll 4
  for (int k = 0; k < n; ++k) {
    const auto& next = cell.x[(k + 1) % n];
    const auto& before = cell.x[(k + n - 1) % n];
    two_areas += cell.x[k][0] * next[1] - cell.x[k][1] * next[0];
    if (gradient == nullptr) continue;
    gradient->x[k][0] += 0.5 * (next[1] - before[1]);
    gradient->x[k][1] += 0.5 * (before[0] - next[0]);
  }
  return 0.5 * two_areas;
}

}  // namespace diptych::scheme
