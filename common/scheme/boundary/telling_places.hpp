#pragma once
/// Some places of many at which a function shows what it does. Test:
/// tests/common/run/step_ends_test.cpp

#include "common/algebra/vectors.hpp"

#include <span>
#include <vector>

namespace diptych::scheme {

using algebra::Vec3;

/// Adds those of X that lie outermost along an axis, then ten of which each is farthest from all
/// before it.
void add_telling_places(std::span<const Vec3> X, std::vector<Vec3>& places);

}  // namespace diptych::scheme
