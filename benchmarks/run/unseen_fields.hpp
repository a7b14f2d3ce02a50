#pragma once
/// Fields of a case that its mesh does not see: what changes between the nodes of a cell or a face.
/// Test: tests/harness/unseen_fields_test.cpp

#include "common/cases/case.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// Adds a notice where body force or initial velocity at places within cells, or the velocity of a
/// support within the faces of its group, at places chosen at random but the same each time, are
/// not those that the nodes around give there: by a third of them and more, in the mean over all
/// cells or faces. A jump across one cell in ten is none, a spot between nodes is.
void note_unseen_fields(const cases::Case& setup,
                        const meshes::Mesh& mesh,
                        std::vector<std::string>& notices);

}  // namespace diptych::harness
