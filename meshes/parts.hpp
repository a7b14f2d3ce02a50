#pragma once
/// Parts of a mesh that share no node, or no face. Test: tests/meshes/parts_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>

namespace diptych::meshes {

/// How many share no node.
std::int64_t n_parts(const Mesh& mesh);

/// How many share no face (in 2-D no edge).
std::int64_t n_parts_by_faces(const Mesh& mesh);

}  // namespace diptych::meshes
