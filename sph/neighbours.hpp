#pragma once
/// Neighbour search: own cell lists, one per octave of the support radius, so that graded clouds
/// cost no more than even ones. Test: tests/graphs/neighbours_test.cpp.

#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <vector>

namespace diptych::sph {

using algebra::Vec3;

struct Rows {
  std::vector<std::int64_t> row;        ///< [n + 1]
  std::vector<std::int32_t> neighbour;  ///< ascending in each row, without the particle itself
};

/// All pairs with |X_b - X_a| < (radius_a + radius_b)/2: the same answer for (a,b) and (b,a).
/// @param X      [n] m, finite
/// @param radius [n] m, > 0
Rows find_neighbours(const std::vector<Vec3>& X, const std::vector<double>& radius);

}  // namespace diptych::sph
