#pragma once
/// Whether a boundary group stands for a curved surface. Test: tests/meshes/curved_groups_test.cpp

#include "meshes/mesh.hpp"

namespace diptych::meshes {

/// Faces whose normals turn by as much or more are of different planes, in degrees: those of a
/// hexagon, whatever the rounding.
inline constexpr double edge_of_planes = 60 - 1e-6;

/// Faces that meet at a node of a curved group turn a little, those that meet at an edge between
/// planes by much.  @return largest turn below edge_of_planes at a node of the group, in degrees
/// @pre mesh.boundary_faces are filled and outward
double largest_bend(const Mesh& mesh, const BoundaryGroup& group);

}  // namespace diptych::meshes
