#include "meshes/cavities.hpp"

#include "meshes/face_flux.hpp"
#include "meshes/joined.hpp"

#include <map>

namespace diptych::meshes {

namespace {

/// What a face has of the volume that its surface encloses.
/// @param origin  a point near, so that no digits are lost
double volume_under(const Mesh& mesh, const BoundaryFace& face, const Vec3& origin) {
  double x[4][3];
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i)
      x[a][i] = mesh.nodes[face.nodes[a < face.n_nodes ? a : 0]][i] - origin[i];
  }
  return face.n_nodes == 2 ? area_under_edge(x[0], x[1])
                           : volume_under_face(x[0], x[1], x[2], x[3]);
}

}  // namespace

std::vector<Cavity> cavities_of(const Mesh& mesh) {
  Joined surfaces(mesh.n_nodes());
  for (const BoundaryFace& face : mesh.boundary_faces) {
    for (int i = 1; i < face.n_nodes; ++i)
      surfaces.join(face.nodes[0], face.nodes[i]);
  }
  std::vector<char> is_grouped(mesh.boundary_faces.size());
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    for (const std::int32_t f : group.faces)
      is_grouped[f] = 1;
  }
  std::map<std::int32_t, size_t> number;  // of the surface of a root
  std::vector<Cavity> all;
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    const std::int32_t root = surfaces.of(face.nodes[0]);
    const size_t k = number.emplace(root, all.size()).first->second;
    if (k == all.size()) all.emplace_back();
    Cavity& cavity = all[k];
    ++cavity.n_faces;
    cavity.is_grouped = cavity.is_grouped || is_grouped[f] != 0;
    cavity.volume -= volume_under(mesh, face, mesh.nodes[root]);  // outward is into the cavity
    for (int i = 0; i < face.n_nodes; ++i)
      cavity.centre += mesh.nodes[face.nodes[i]] / face.n_nodes;
  }
  std::erase_if(all, [](const Cavity& surface) { return !(surface.volume > 0); });
  for (Cavity& cavity : all)
    cavity.centre /= static_cast<double>(cavity.n_faces);
  return all;
}

}  // namespace diptych::meshes
