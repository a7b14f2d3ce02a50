#pragma once
/// Cells that are alone across a body. Test: tests/meshes/single_cells_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

/// How many hexahedra (quadrilaterals) have two opposite faces on free boundary.
/// @param is_held  [mesh.boundary_faces] those that are not free
/// @pre mesh.boundary_faces are filled
std::int64_t n_single_cells(const Mesh& mesh, const std::vector<char>& is_held);

}  // namespace diptych::meshes
