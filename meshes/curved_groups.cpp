#include "meshes/curved_groups.hpp"

#include "meshes/shape_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace diptych::meshes {

double largest_bend(const Mesh& mesh, const BoundaryGroup& group) {
  std::map<std::int32_t, std::vector<Vec3>> normals_at;
  double largest = 0;
  for (const std::int32_t f : group.faces) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    const Vec3 normal = face_area(face, mesh.nodes).normalized();
    for (int i = 0; i < face.n_nodes; ++i) {
      std::vector<Vec3>& others = normals_at[face.nodes[i]];
      for (const Vec3& other : others) {
        const double turn = std::atan2(normal.cross(other).norm(), normal.dot(other));
        const double degrees = turn * 180 / std::numbers::pi;
        if (degrees < edge_of_planes) largest = std::max(largest, degrees);
      }
      others.push_back(normal);
    }
  }
  return largest;
}

}  // namespace diptych::meshes
