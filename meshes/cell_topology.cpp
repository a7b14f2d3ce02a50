#include "meshes/cell_topology.hpp"

namespace diptych::meshes {

namespace {

constexpr LocalFace edge(int a, int b) {
  return {2, {a, b, 0, 0}};
}
constexpr LocalFace three(int a, int b, int c) {
  return {3, {a, b, c, 0}};
}
constexpr LocalFace four(int a, int b, int c, int d) {
  return {4, {a, b, c, d}};
}

constexpr LocalFace triangle_faces[] = {edge(0, 1), edge(1, 2), edge(2, 0)};
constexpr LocalFace quadrilateral_faces[] = {edge(0, 1), edge(1, 2), edge(2, 3), edge(3, 0)};
constexpr LocalFace tetrahedron_faces[] = {three(0, 2, 1), three(0, 1, 3), three(1, 2, 3),
                                           three(0, 3, 2)};
constexpr LocalFace hexahedron_faces[] = {four(0, 3, 2, 1), four(4, 5, 6, 7), four(0, 1, 5, 4),
                                          four(1, 2, 6, 5), four(2, 3, 7, 6), four(3, 0, 4, 7)};
constexpr LocalFace prism_faces[] = {three(0, 2, 1), three(3, 4, 5), four(0, 1, 4, 3),
                                     four(1, 2, 5, 4), four(2, 0, 3, 5)};

constexpr LocalEdge triangle_edges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr LocalEdge quadrilateral_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr LocalEdge tetrahedron_edges[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr LocalEdge hexahedron_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                          {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr LocalEdge prism_edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                     {5, 3}, {0, 3}, {1, 4}, {2, 5}};

constexpr LocalCorner triangle_corners[] = {{0, {1, 2, 0}}};
constexpr LocalCorner quadrilateral_corners[] = {
    {0, {1, 3, 0}}, {1, {2, 0, 0}}, {2, {3, 1, 0}}, {3, {0, 2, 0}}};
constexpr LocalCorner tetrahedron_corners[] = {{0, {1, 2, 3}}};
constexpr LocalCorner hexahedron_corners[] = {{0, {1, 3, 4}}, {1, {2, 0, 5}}, {2, {3, 1, 6}},
                                              {3, {0, 2, 7}}, {4, {7, 5, 0}}, {5, {4, 6, 1}},
                                              {6, {5, 7, 2}}, {7, {6, 4, 3}}};
constexpr LocalCorner prism_corners[] = {{0, {1, 2, 3}}, {1, {2, 0, 4}}, {2, {0, 1, 5}},
                                         {3, {5, 4, 0}}, {4, {3, 5, 1}}, {5, {4, 3, 2}}};

struct Topology {
  const char* name;
  std::span<const LocalFace> faces;
  std::span<const LocalEdge> edges;
  std::span<const LocalCorner> corners;
};

/// In the order of CellType.
const Topology topologies[] = {
    {"triangle", triangle_faces, triangle_edges, triangle_corners},
    {"quadrilateral", quadrilateral_faces, quadrilateral_edges, quadrilateral_corners},
    {"tetrahedron", tetrahedron_faces, tetrahedron_edges, tetrahedron_corners},
    {"hexahedron", hexahedron_faces, hexahedron_edges, hexahedron_corners},
    {"prism", prism_faces, prism_edges, prism_corners}};

const Topology& topology_of(CellType type) {
  return topologies[static_cast<size_t>(type)];
}

}  // namespace

std::span<const LocalFace> faces_of(CellType type) {
  return topology_of(type).faces;
}

std::span<const LocalEdge> edges_of(CellType type) {
  return topology_of(type).edges;
}

std::span<const LocalCorner> corners_of(CellType type) {
  return topology_of(type).corners;
}

bool is_simplex(CellType type) {
  return type == CellType::triangle || type == CellType::tetrahedron;
}

const char* name_of(CellType type) {
  return topology_of(type).name;
}

}  // namespace diptych::meshes
