#pragma once
/// Which cells hold a place. Test: tests/meshes/cell_at_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

/// Nodes of the cells that hold a place, ascending, or, where none does, of those that it is
/// outside of by no more than a tenth of their width: a place on a curved side may be outside its
/// facets, and between cells whose faces are warped. Empty where it is outside the body.
std::vector<std::int32_t> nodes_of_cells_at(const Mesh& mesh, const Vec3& place);

}  // namespace diptych::meshes
