#pragma once
/// Closed surfaces inside a body: where cells are missing, or where it is hollow.
/// Test: tests/meshes/cavities_test.cpp

#include "meshes/mesh.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

struct Cavity {
  std::int64_t n_faces = 0;
  double volume = 0;        ///< m^3 (m^2 in 2-D), > 0
  Vec3 centre{0, 0, 0};     ///< mean of the corners of its faces, m
  bool is_grouped = false;  ///< a boundary group has one of its faces
};

/// In the order of their first faces. Surfaces that share a node are one.
/// @pre mesh.boundary_faces are filled and outward
std::vector<Cavity> cavities_of(const Mesh& mesh);

}  // namespace diptych::meshes
