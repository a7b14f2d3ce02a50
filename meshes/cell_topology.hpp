#pragma once
/// Faces, edges and corners of the cell types, in local node numbers (Gmsh order).
/// A cell is positively oriented where the Jacobian at its corners is positive: triangles and
/// quadrilaterals counter-clockwise; nodes 0, 1, 2 (, 3) of a solid counter-clockwise when seen
/// from the remaining nodes. Test: tests/meshes/cell_topology_test.cpp.

#include "meshes/mesh.hpp"

#include <array>
#include <span>

namespace diptych::meshes {

/// Nodes of a face of a positively oriented cell, oriented outwards (see BoundaryFace).
struct LocalFace {
  int n_nodes = 0;
  std::array<int, 4> nodes{};
};

/// A corner and its neighbours along the edges, in right-handed order (2-D: two neighbours).
struct LocalCorner {
  int node = 0;
  std::array<int, 3> neighbours{};
};

using LocalEdge = std::array<int, 2>;

std::span<const LocalFace> faces_of(CellType type);
std::span<const LocalEdge> edges_of(CellType type);
std::span<const LocalCorner> corners_of(CellType type);

/// Whether it is a triangle or a tetrahedron.
bool is_simplex(CellType type);

/// "triangle", "quadrilateral", ... for messages and case files.
const char* name_of(CellType type);

/// The most faces that a cell of any type has.
inline constexpr int most_faces = 6;

}  // namespace diptych::meshes
