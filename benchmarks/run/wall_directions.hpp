#pragma once
/// That rigid walls stand before the sides that they are for. Test:
/// tests/harness/wall_directions_test.cpp

#include "common/cases/case.hpp"
#include "meshes/mesh.hpp"

namespace diptych::harness {

/// @throws base::InputError where faces of a wall's groups look along its normal and none against
///         it: it points away from the body, which would pass the wall. Not asked of bodies that
///         are displaced to begin with, whose sides may have turned
void require_walls_before_sides(const cases::Case& setup, const meshes::Mesh& mesh);

}  // namespace diptych::harness
