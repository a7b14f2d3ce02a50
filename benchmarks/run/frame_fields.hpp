#pragma once
/// What a frame of the field output holds at every node. Test: tests/harness/frame_fields_test.cpp

#include "common/io/field_writer.hpp"
#include "common/run/solver.hpp"

#include <cstdint>
#include <vector>

namespace diptych::harness {

/// Displacement, velocity, deformation gradient, first Piola-Kirchhoff and Cauchy stress (nine
/// components each, row by row), von Mises stress, J, pressure. Plane strain gives all components.
/// @param order  [node] its number in the user's mesh, which the fields have
std::vector<io::NodeField> frame_fields(const scheme::Snapshot& state,
                                        const std::vector<std::int32_t>& order);

}  // namespace diptych::harness
