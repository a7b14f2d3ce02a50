#pragma once
/// Areas of boundary faces as weights of the nodes around them on the same side: by the vertex
/// rule, and then changed least so that for all cubics q of the plane of the facet
///   sum_a A_a q(X_a) = int_face q N dA.
/// Test: tests/graphs/quadratic_measure_test.cpp

#include "common/algebra/vectors.hpp"
#include "meshes/mesh.hpp"
#include "meshes/surface.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

/// Share of the nodes in one face.
struct FaceArea {
  std::vector<std::int32_t> nodes;  ///< ascending
  std::vector<Vec3> area;           ///< [nodes] m^2 (m in 2-D), outward
};

/// What faces are: their facets, whose sides are plane, or those of the surface, whose sides are
/// smooth.
enum class Faces { plane, smooth };

/// Of every face. Those of one side are joined by edges and are of the same groups.
std::vector<FaceArea> side_areas(const Mesh& mesh, const Surface& surface, Faces faces);

/// Adds the areas of a face to those of its nodes.
void add_areas(const FaceArea& face, std::vector<Vec3>& area);

/// @return [n_nodes] m^2 (m in 2-D), over all faces
std::vector<Vec3> areas_of_nodes(const std::vector<FaceArea>& faces, size_t n_nodes);

}  // namespace diptych::meshes
