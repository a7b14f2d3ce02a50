#pragma once
/// What a mesh may not have been meant to be. Test: tests/harness/mesh_notices_test.cpp

#include "common/cases/case.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// Adds a notice of each: of a file, cavities, parts that share no node, cells that hang together
/// by less than a face; a body of one cell across; symmetries on curved groups.
/// @param level  of the mesh
void note_mesh(const cases::Case& setup,
               const meshes::Mesh& mesh,
               int level,
               std::vector<std::string>& notices);

}  // namespace diptych::harness
