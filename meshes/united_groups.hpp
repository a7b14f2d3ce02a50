#pragma once
/// Groups that are named together and have faces in common, which what acts on all of them, or is
/// summed over them, would count twice. Test: tests/meshes/united_groups_test.cpp

#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::meshes {

/// Of the group that has the faces of all of these.
std::string united_name(const std::vector<std::string>& names);

/// Adds this group to the mesh, once, where two of them have faces in common; names of groups that
/// the mesh does not have are passed over.
/// @throws base::InputError where a group of the mesh has its name and other faces
void unite_overlapping(const std::vector<std::string>& names, Mesh& mesh);

}  // namespace diptych::meshes
