#pragma once
/// Areas and volumes of test meshes from their faces alone (divergence theorem), independent of
/// the corner Jacobians that the code checks.

#include "common/algebra/vectors.hpp"
#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "tests/folders.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <string>

namespace diptych::meshes {

/// Outward area vector; in 2-D the outward length vector.
inline Vec3 area_vector(const Mesh& mesh, const BoundaryFace& face) {
  const auto x = [&](int i) -> const Vec3& { return mesh.nodes[face.nodes[i]]; };
  if (face.n_nodes == 2) return {x(1)[1] - x(0)[1], x(0)[0] - x(1)[0], 0};
  if (face.n_nodes == 3) return (x(1) - x(0)).cross(x(2) - x(0)) / 2;
  return (x(2) - x(0)).cross(x(3) - x(1)) / 2;
}

/// int x.n dA over the face, exact for planes and bilinear patches (mean of both splits).
inline double position_flux(const Mesh& mesh, const BoundaryFace& face) {
  const auto x = [&](int i) -> const Vec3& { return mesh.nodes[face.nodes[i]]; };
  const auto triangle = [&](int i, int j, int k) { return x(i).dot(x(j).cross(x(k))) / 2; };
  if (face.n_nodes == 2) return x(0)[0] * x(1)[1] - x(0)[1] * x(1)[0];
  if (face.n_nodes == 3) return triangle(0, 1, 2);
  return (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(1, 2, 3) + triangle(1, 3, 0)) / 2;
}

/// Volume (2-D: area) of one cell.
inline double cell_volume(const Mesh& mesh, std::int64_t cell) {
  double flux = 0;
  for (const LocalFace& local : faces_of(mesh.cell_types[cell])) {
    BoundaryFace face;
    face.n_nodes = local.n_nodes;
    for (int i = 0; i < local.n_nodes; ++i)
      face.nodes[i] = mesh.cell(cell)[local.nodes[i]];
    flux += position_flux(mesh, face);
  }
  return flux / mesh.dimension;
}

inline double sum_of_cell_volumes(const Mesh& mesh) {
  double volume = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
    volume += cell_volume(mesh, c);
  return volume;
}

inline double volume_inside_boundary(const Mesh& mesh) {
  double flux = 0;
  for (const BoundaryFace& face : mesh.boundary_faces)
    flux += position_flux(mesh, face);
  return flux / mesh.dimension;
}

inline Vec3 area_of_group(const Mesh& mesh, const std::string& name) {
  Vec3 area = Vec3::Zero();
  for (const std::int32_t f : mesh.group(name).faces) {
    area += area_vector(mesh, mesh.boundary_faces[f]);
  }
  return area;
}

inline Vec3 area_of_boundary(const Mesh& mesh) {
  Vec3 area = Vec3::Zero();
  for (const BoundaryFace& face : mesh.boundary_faces)
    area += area_vector(mesh, face);
  return area;
}

/// A mesh by hand: nodes, cells of any types.
inline Mesh mesh_of(int dimension,
                    std::vector<Vec3> nodes,
                    const std::vector<std::pair<CellType, std::vector<std::int32_t>>>& cells) {
  Mesh mesh;
  mesh.dimension = dimension;
  mesh.nodes = std::move(nodes);
  mesh.cell_offsets.push_back(0);
  for (const auto& [type, cell_nodes] : cells) {
    mesh.cell_types.push_back(type);
    mesh.cell_nodes.insert(mesh.cell_nodes.end(), cell_nodes.begin(), cell_nodes.end());
    mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
  }
  return mesh;
}

/// The message of the InputError that `action` throws; empty where it throws none.
template <class Action>
std::string input_error_of(Action action) {
  try {
    action();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

inline constexpr std::array<const char*, 4> block_files{"block_41.msh", "block_41_binary.msh",
                                                        "block_22.msh", "block_22_binary.msh"};

inline std::string block_path(const std::string& file) {
  return tests::tests_folder() + "/meshes/" + file;
}

}  // namespace diptych::meshes
