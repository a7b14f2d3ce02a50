#pragma once
/// Shares of the corners in the area vector of a face, int N_a n dA: of an edge of the plane, a
/// triangle, a bilinear quadrilateral. They are the derivatives of the volume behind the face by
/// its corners. Tests: tests/graphs/shape_integrals_test.cpp, tests/common/scheme/volumes_test.cpp

#include "common/algebra/vectors.hpp"

#include <array>

namespace diptych::algebra {

/// @param x  corners, right-handed seen from outside; in the plane the body lies to the left
/// @param n  2 to 4 of them  @return [n] m^2 (m in the plane)
inline std::array<Vec3, 4> face_area_shares(const std::array<Vec3, 4>& x, int n) {
  std::array<Vec3, 4> share{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  if (n == 2) {
    const Vec3 t = x[1] - x[0];
    share[0] = share[1] = 0.5 * Vec3(t[1], -t[0], 0);
  } else if (n == 3) {
    share[0] = share[1] = share[2] = (x[1] - x[0]).cross(x[2] - x[0]) / 6;
  } else {  // x = m + a xi + b eta + d xi eta
    const Vec3 e = 0.25 * (x[2] - x[0]), f = 0.25 * (x[3] - x[1]);
    const Vec3 a = e - f, b = e + f, d = 0.25 * ((x[0] - x[1]) + (x[2] - x[3]));
    const Vec3 middle = a.cross(b), by_xi = a.cross(d) / 3, by_eta = d.cross(b) / 3;
    share[0] = middle - by_xi - by_eta;
    share[1] = middle + by_xi - by_eta;
    share[2] = middle + by_xi + by_eta;
    share[3] = middle - by_xi + by_eta;
  }
  return share;
}

}  // namespace diptych::algebra
