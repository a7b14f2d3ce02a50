/// The box generator: nodes on a lattice, each block split the same way.
/// Test: tests/meshes/generators_test.cpp.

#include "meshes/generators.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::meshes {

namespace {

/// Corner of a block: bit k set means the far end in direction k.
using Corner = int;

/// The pieces of a block as block corners, in the node order of the cell type.
/// Tetrahedra: Kuhn's six, one per order of the axes on the way from corner 0 to corner 7; their
/// diagonals are the same on opposite sides, so that blocks conform.
std::vector<std::vector<Corner>> pieces_of_block(CellType type) {
  switch (type) {
    case CellType::quadrilateral:
      return {{0, 1, 3, 2}};
    case CellType::triangle:
      return {{0, 1, 3}, {0, 3, 2}};
    case CellType::hexahedron:
      return {{0, 1, 3, 2, 4, 5, 7, 6}};
    case CellType::prism:
      return {{0, 1, 3, 4, 5, 7}, {0, 3, 2, 4, 7, 6}};
    case CellType::tetrahedron:
      return {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  }
  return {};
}

struct Lattice {
  int dimension;
  std::array<std::int64_t, 3> n_blocks;  ///< [2] = 0 in 2-D
  std::array<std::int64_t, 3> stride;    ///< of node indices

  Lattice(int dim, const std::array<int, 3>& cells)
      : dimension(dim), n_blocks{cells[0], cells[1], dim == 3 ? cells[2] : 0} {
    stride = {1, n_blocks[0] + 1, (n_blocks[0] + 1) * (n_blocks[1] + 1)};
  }
  std::int64_t index_of(std::int32_t node, int direction) const {
    return node / stride[direction] % (n_blocks[direction] + 1);
  }
};

void check_box(int dimension,
               const Vec3& lower,
               const Vec3& upper,
               const std::array<int, 3>& cells) {
  double n_nodes = 1;  // of doubles: the product of three int never overflows
  for (int k = 0; k < dimension; ++k) {
    const char axis = "xyz"[k];
    if (cells[k] < 1) {
      throw base::InputError(
          fmt::format("box: {} cells in direction {}, at least 1 is needed", cells[k], axis));
    }
    if (!std::isfinite(lower[k]) || !std::isfinite(upper[k]) || !(lower[k] < upper[k])) {
      throw base::InputError(
          fmt::format("box: lower {0} = {1} must be below upper {0} = {2}, both finite", axis,
                      lower[k], upper[k]));
    }
    n_nodes *= cells[k] + 1.0;
  }
  if (n_nodes > std::numeric_limits<std::int32_t>::max()) {
    throw base::InputError(
        fmt::format("box: {:.4g} nodes are too many for 32-bit indices, at most "
                    "{} are supported: use fewer cells",
                    n_nodes, std::numeric_limits<std::int32_t>::max()));
  }
}

/// Symmetric in the two ends, so that a mirrored box has exactly mirrored nodes.
double coordinate(double lower, double upper, std::int64_t i, std::int64_t n) {
  if (i == 0) return lower;
  if (i == n) return upper;
  const double t = static_cast<double>(i) / static_cast<double>(n);
  const double s = static_cast<double>(n - i) / static_cast<double>(n);
  return s * lower + t * upper;
}

void make_nodes(const Lattice& lattice, const Vec3& lower, const Vec3& upper, Mesh& mesh) {
  const auto& n = lattice.n_blocks;
  mesh.nodes.reserve((n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  for (std::int64_t k = 0; k <= n[2]; ++k) {
    const double z = lattice.dimension == 3 ? coordinate(lower[2], upper[2], k, n[2]) : 0.0;
    for (std::int64_t j = 0; j <= n[1]; ++j) {
      const double y = coordinate(lower[1], upper[1], j, n[1]);
      for (std::int64_t i = 0; i <= n[0]; ++i) {
        mesh.nodes.emplace_back(coordinate(lower[0], upper[0], i, n[0]), y, z);
      }
    }
  }
}

void make_cells(const Lattice& lattice, CellType type, Mesh& mesh) {
  const auto pieces = pieces_of_block(type);
  const auto& n = lattice.n_blocks;
  const std::int64_t n_layers = lattice.dimension == 3 ? n[2] : 1;
  const std::int64_t n_cells = n[0] * n[1] * n_layers * static_cast<std::int64_t>(pieces.size());
  mesh.cell_types.assign(n_cells, type);
  mesh.cell_offsets.resize(n_cells + 1);
  for (std::int64_t c = 0; c <= n_cells; ++c)
    mesh.cell_offsets[c] = c * n_nodes_of(type);
  mesh.cell_nodes.reserve(mesh.cell_offsets.back());
  const auto add_block = [&](std::int64_t first) {
    for (const auto& piece : pieces) {
      for (const Corner corner : piece) {
        std::int64_t node = first;
        for (int d = 0; d < 3; ++d)
          node += (corner >> d & 1) * lattice.stride[d];
        mesh.cell_nodes.push_back(static_cast<std::int32_t>(node));
      }
    }
  };
  for (std::int64_t k = 0; k < n_layers; ++k) {
    for (std::int64_t j = 0; j < n[1]; ++j) {
      for (std::int64_t i = 0; i < n[0]; ++i) {
        add_block(i + j * lattice.stride[1] + k * lattice.stride[2]);
      }
    }
  }
}

/// x_min, x_max, y_min, ...: the faces whose nodes all lie on that side.
void make_groups(const Lattice& lattice, Mesh& mesh) {
  for (int d = 0; d < lattice.dimension; ++d) {
    for (const char* side : {"_min", "_max"}) {
      mesh.boundary_groups.push_back({std::string(1, "xyz"[d]) + side, {}});
    }
  }
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    for (int d = 0; d < lattice.dimension; ++d) {
      for (const bool far : {false, true}) {
        const std::int64_t side = far ? lattice.n_blocks[d] : 0;
        const bool lies_on_side =
            std::all_of(face.nodes.begin(), face.nodes.begin() + face.n_nodes,
                        [&](std::int32_t a) { return lattice.index_of(a, d) == side; });
        if (!lies_on_side) continue;
        mesh.boundary_groups[2 * d + (far ? 1 : 0)].faces.push_back(static_cast<std::int32_t>(f));
      }
    }
  }
}

}  // namespace

const base::Registry<CellType>& cell_menu() {
  static const auto menu = [] {
    base::Registry<CellType> all("cell type");
    for (const CellType type :
         {CellType::hexahedron, CellType::tetrahedron, CellType::quadrilateral, CellType::triangle})
      all.add(name_of(type), type);
    return all;
  }();
  return menu;
}

Mesh box(CellType type, const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells) {
  Mesh mesh;
  mesh.dimension = dimension_of(type);
  check_box(mesh.dimension, lower, upper, cells);
  const Lattice lattice(mesh.dimension, cells);
  make_nodes(lattice, lower, upper, mesh);
  make_cells(lattice, type, mesh);
  check_cells(mesh, "box");  // sides so far from the origin that neighbouring nodes coincide
  find_boundary_faces(mesh);
  make_groups(lattice, mesh);
  return mesh;
}

}  // namespace diptych::meshes
