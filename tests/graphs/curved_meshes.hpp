#pragma once
/// Curved meshes of hexahedra and quadrilaterals, and glued ones.

#include "meshes/generators.hpp"
#include "meshes/gmsh.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

namespace diptych::graphs {

using algebra::Vec3;
using meshes::CellType;
using Map = std::function<Vec3(const Vec3&)>;

/// A box with its nodes moved by a map.
inline meshes::Mesh mapped_box(const Vec3& lower,
                               const Vec3& upper,
                               const std::array<int, 3>& cells,
                               const Map& map) {
  const CellType type = cells[2] > 0 ? CellType::hexahedron : CellType::quadrilateral;
  meshes::Mesh mesh = meshes::box(type, lower, upper, cells);
  for (Vec3& X : mesh.nodes)
    X = map(X);
  return mesh;
}

/// Meshes as one: nodes at the same place are one node. All faces are of the group "surface".
inline meshes::Mesh glued(const std::vector<meshes::Mesh>& parts) {
  meshes::Mesh mesh;
  mesh.dimension = parts[0].dimension;
  mesh.cell_offsets.push_back(0);
  std::map<std::tuple<long, long, long>, std::int32_t> node_at;
  const auto node = [&](const Vec3& X) {
    constexpr double digits = 1e9;
    const std::tuple key{std::lround(X[0] * digits), std::lround(X[1] * digits),
                         std::lround(X[2] * digits)};
    const auto [found, is_new] =
        node_at.try_emplace(key, static_cast<std::int32_t>(mesh.nodes.size()));
    if (is_new) mesh.nodes.push_back(X);
    return found->second;
  };
  for (const meshes::Mesh& part : parts) {
    for (std::int64_t c = 0; c < part.n_cells(); ++c) {
      mesh.cell_types.push_back(part.cell_types[c]);
      for (const std::int32_t a : part.cell(c))
        mesh.cell_nodes.push_back(node(part.nodes[a]));
      mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.cell_nodes.size()));
    }
  }
  meshes::find_boundary_faces(mesh);
  std::vector<std::int32_t> all(mesh.boundary_faces.size());
  std::iota(all.begin(), all.end(), 0);
  mesh.boundary_groups = {{"surface", all}};
  return mesh;
}

inline Vec3 bent(const Vec3& X) {
  return X + 0.08 * Vec3(std::sin(2 * X[1]), std::sin(2.5 * X[0]), 0);
}

inline Vec3 bent_in_space(const Vec3& X) {
  return X + 0.06 * Vec3(std::sin(2 * X[1] + X[2]), std::sin(2.5 * X[0] - X[2]),
                         std::cos(2 * X[0] + 1.5 * X[1]) + X[2] * X[2] * X[0]);
}

/// A curved block of n cells a side, n_z along the third direction; 0: in the plane.
inline meshes::Mesh curved_block(int n, int n_z) {
  return mapped_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {n, n, n_z},
                    n_z > 0 ? bent_in_space : bent);
}

/// Three squares (bars) of n cells a side, bent.
inline meshes::Mesh bent_l(int n, int n_z, const Map& map = bent) {
  const auto part = [&](double x, double y) {
    return mapped_box({x, y, 0}, {x + 0.5, y + 0.5, 0.5}, {n, n, n_z}, map);
  };
  return glued({part(0, 0), part(0.5, 0), part(0, 0.5)});
}

/// n_around cells around, n through the wall, n_z along the axis; 0: an annulus.
inline meshes::Mesh ring(int n_around, int n, int n_z) {
  const auto round = [](const Vec3& X) {
    const double angle = 2 * std::numbers::pi * X[0];
    return Vec3(X[1] * std::cos(angle), X[1] * std::sin(angle), X[2]);
  };
  return glued({mapped_box({0, 0.5, 0}, {1, 1, 0.5}, {n_around, n, n_z}, [&](const Vec3& X) {
    return round({-X[0], X[1], X[2]});
  })});
}

/// A disc: a square of n x n cells in four blocks of n x m, each side of the square straight.
inline meshes::Mesh disc(int n, int m) {
  std::vector<meshes::Mesh> parts{
      mapped_box({-0.45, -0.45, 0}, {0.45, 0.45, 0}, {n, n, 0}, [](const Vec3& X) { return X; })};
  for (int quarter = 0; quarter < 4; ++quarter) {
    parts.push_back(mapped_box({-1, 0, 0}, {1, 1, 0}, {n, m, 0}, [&](const Vec3& X) {
      const double angle = std::numbers::pi / 4 * X[0], s = X[1];
      const Vec3 inner(0.45 * X[0], 0.45, 0), outer(std::sin(angle), std::cos(angle), 0);
      const Vec3 at = (1 - s) * inner + s * outer;
      const double c = std::round(std::cos(quarter * std::numbers::pi / 2)),
                   sine = std::round(std::sin(quarter * std::numbers::pi / 2));
      return Vec3(c * at[0] - sine * at[1], sine * at[0] + c * at[1], 0);
    }));
  }
  return glued(parts);
}

}  // namespace diptych::graphs
