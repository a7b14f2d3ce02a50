#pragma once
/// Parts of a mesh that share no node. Test: tests/meshes/parts_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>

namespace diptych::meshes {

/// How many there are.
std::int64_t n_parts(const Mesh& mesh);

}  // namespace diptych::meshes
