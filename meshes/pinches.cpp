#include "meshes/pinches.hpp"

#include "meshes/joined.hpp"

#include <algorithm>
#include <array>

namespace diptych::meshes {

namespace {

/// A corner of a boundary face counts as 4 times the face and its place in it.
constexpr std::int64_t stride = 4;

/// An edge of a boundary face, and its corners there.
struct FaceEdge {
  std::array<std::int32_t, 2> nodes{};  ///< ascending
  std::array<std::int64_t, 2> corners{};
};

std::vector<FaceEdge> edges_of_faces(const Mesh& mesh) {
  std::vector<FaceEdge> edges;
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    const auto first = static_cast<std::int64_t>(f) * stride;
    for (int i = 0; i < face.n_nodes; ++i) {
      const int j = (i + 1) % face.n_nodes;
      FaceEdge edge{{face.nodes[i], face.nodes[j]}, {first + i, first + j}};
      if (edge.nodes[0] > edge.nodes[1]) {
        std::swap(edge.nodes[0], edge.nodes[1]);
        std::swap(edge.corners[0], edge.corners[1]);
      }
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& one, const FaceEdge& other) {
    return one.nodes != other.nodes ? one.nodes < other.nodes : one.corners < other.corners;
  });
  return edges;
}

/// Of a plane body: nodes with more than two edges.
void find_in_plane(const Mesh& mesh, std::vector<char>& is_pinched) {
  std::vector<int> n_faces(mesh.nodes.size());
  for (const BoundaryFace& face : mesh.boundary_faces) {
    for (int i = 0; i < face.n_nodes; ++i)
      is_pinched[face.nodes[i]] |= ++n_faces[face.nodes[i]] > 2 ? 1 : 0;
  }
}

void find_in_space(const Mesh& mesh, std::vector<char>& is_pinched) {
  const std::vector<FaceEdge> edges = edges_of_faces(mesh);
  Joined sheets(static_cast<std::int64_t>(mesh.boundary_faces.size()) * stride);
  const auto number = [](std::int64_t corner) { return static_cast<std::int32_t>(corner); };
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].nodes == edges[first].nodes) {
      for (int i = 0; i < 2; ++i)
        sheets.join(number(edges[first].corners[i]), number(edges[end].corners[i]));
      ++end;
    }
    if (end - first <= 2) continue;
    for (const std::int32_t a : edges[first].nodes)
      is_pinched[a] = 1;
  }
  std::vector<std::int32_t> sheet(mesh.nodes.size(), -1);
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    for (int i = 0; i < face.n_nodes; ++i) {
      std::int32_t& own = sheet[face.nodes[i]];
      const std::int32_t here = sheets.of(number(static_cast<std::int64_t>(f) * stride + i));
      if (own < 0) own = here;
      if (own != here) is_pinched[face.nodes[i]] = 1;
    }
  }
}

}  // namespace

std::vector<std::int32_t> pinched_nodes(const Mesh& mesh) {
  std::vector<char> is_pinched(mesh.nodes.size(), 0);
  if (mesh.dimension == 2) {
    find_in_plane(mesh, is_pinched);
  } else {
    find_in_space(mesh, is_pinched);
  }
  std::vector<std::int32_t> nodes;
  for (std::int32_t a = 0; a < mesh.n_nodes(); ++a) {
    if (is_pinched[a] != 0) nodes.push_back(a);
  }
  return nodes;
}

}  // namespace diptych::meshes
