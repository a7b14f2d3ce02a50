/// From the contents of a .msh file to a checked mesh: nodes in the order of their tags (so that
/// all four formats give the same mesh), cells of the highest dimension, then orientation, boundary
/// faces and groups.

#include "common/base/error.hpp"
#include "meshes/cell_checks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/hanging_nodes.hpp"
#include "meshes/msh/cells.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace diptych::meshes::msh {

namespace {

/// z may differ by this part of the extent in a plane mesh: round-off of a mesher.
constexpr double flatness = 1e-9;

void sort_nodes(const Source& source, Contents& contents) {
  auto& tags = contents.node_tags;
  if (!std::is_sorted(tags.begin(), tags.end())) {
    std::vector<std::int64_t> order(tags.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int64_t a, std::int64_t b) { return tags[a] < tags[b]; });
    std::vector<std::int64_t> sorted_tags;
    std::vector<Vec3> sorted_places;
    sorted_tags.reserve(tags.size());
    sorted_places.reserve(tags.size());
    for (const std::int64_t i : order) {
      sorted_tags.push_back(tags[i]);
      sorted_places.push_back(contents.node_places[i]);
    }
    tags = std::move(sorted_tags);
    contents.node_places = std::move(sorted_places);
  }
  const auto twin = std::adjacent_find(tags.begin(), tags.end());
  if (twin == tags.end()) return;
  source.fail_without_place(fmt::format("$Nodes: node {} stands twice", *twin));
}

void refuse_repeated_elements(const Source& source, const Contents& contents) {
  std::vector<std::pair<std::int64_t, std::int64_t>> elements;  // tag, place
  for (const auto& block : contents.blocks) {
    for (size_t i = 0; i < block.tags.size(); ++i) {
      elements.emplace_back(block.tags[i], block.places[i]);
    }
  }
  if (!std::is_sorted(elements.begin(), elements.end())) {
    std::sort(elements.begin(), elements.end());
  }
  if (!elements.empty() && elements.front().first < 1) {
    source.fail_at(elements.front().second,
                   fmt::format("element number {} must be positive", elements.front().first));
  }
  const auto twin =
      std::adjacent_find(elements.begin(), elements.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twin == elements.end()) return;
  source.fail_at(std::next(twin)->second, fmt::format("element {} stands twice", twin->first));
}

int cell_dimension(const Source& source, const Contents& contents) {
  int dimension = -1;
  for (const auto& block : contents.blocks)
    dimension = std::max(dimension, block.dimension);
  if (dimension < 2) {
    source.fail_without_place(
        "the file has no triangles, quadrilaterals, tetrahedra, hexahedra or prisms: mesh the "
        "surface (gmsh -2) or the volume (gmsh -3)");
  }
  for (const auto& [key, physical] : contents.physical_names) {
    if (key.first <= dimension) continue;
    source.fail_without_place(
        fmt::format("physical volume '{}' has no cells: mesh the volume (gmsh -3)", physical.name));
  }
  return dimension;
}

/// A solid in the plane: z is constant and then dropped.
void flatten(const Source& source, Mesh& mesh) {
  Vec3 least = mesh.nodes[0], most = mesh.nodes[0];
  for (const Vec3& node : mesh.nodes) {
    least = least.cwiseMin(node);
    most = most.cwiseMax(node);
  }
  const double extent = std::max(most[0] - least[0], most[1] - least[1]);
  if (!(most[2] - least[2] <= flatness * extent)) {
    source.fail_without_place(fmt::format(
        "the cells of highest dimension are surfaces, but z runs from {:.6g} to {:.6g}: a plane "
        "mesh needs constant z, a solid one needs volume cells (gmsh -3)",
        least[2], most[2]));
  }
  for (Vec3& node : mesh.nodes)
    node[2] = 0;
}

/// Mirrors the node order of all cells.
void reverse_cells(Mesh& mesh) {
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    std::int32_t* nodes = mesh.cell_nodes.data() + mesh.cell_offsets[c];
    switch (mesh.cell_types[c]) {
      case CellType::triangle:
      case CellType::tetrahedron:
        std::swap(nodes[1], nodes[2]);
        break;
      case CellType::quadrilateral:
        std::swap(nodes[1], nodes[3]);
        break;
      case CellType::hexahedron:
        std::swap_ranges(nodes, nodes + 4, nodes + 4);
        break;
      case CellType::prism:
        std::swap_ranges(nodes, nodes + 3, nodes + 3);
        break;
    }
  }
}

[[noreturn]] void refuse_cell(const Source& source,
                              const Mesh& mesh,
                              const Cells& cells,
                              std::int64_t cell,
                              const std::string& what) {
  const Vec3 centre = centre_of(mesh, cell);
  source.fail_at(cells.places[cell], fmt::format("element {} ({}) at ({:.6g}, {:.6g}, {:.6g}) {}",
                                                 cells.tags[cell], name_of(mesh.cell_types[cell]),
                                                 centre[0], centre[1], centre[2], what));
}

/// All cells reversed is a convention of the whole mesh (a plane seen from below) and is turned
/// around; cells of both orientations are an error.
void orient(const Source& source, const Cells& cells, Mesh& mesh) {
  std::int64_t n_reversed = 0, first_reversed = -1, first_sound = -1;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const CellFault fault = fault_of(mesh, c);
    if (fault == CellFault::reversed) {
      if (n_reversed++ == 0) first_reversed = c;
    } else if (fault == CellFault::none) {
      if (first_sound < 0) first_sound = c;
    } else {
      refuse_cell(source, mesh, cells, c, description(fault, mesh.dimension));
    }
  }
  if (n_reversed == mesh.n_cells()) {
    reverse_cells(mesh);
  } else if (n_reversed > 0) {
    const bool is_minority = 2 * n_reversed <= mesh.n_cells();
    refuse_cell(
        source, mesh, cells, is_minority ? first_reversed : first_sound,
        fmt::format("is oriented against the others ({} of {} cells are {}): {}", n_reversed,
                    mesh.n_cells(), mesh.dimension == 2 ? "clockwise" : "inverted",
                    mesh.dimension == 2
                        ? "give all curve loops the same sense (Gmsh: ReverseMesh Surface)"
                        : "remesh, or reverse the node order of these cells"));
  }
}

}  // namespace

Mesh assembled(const Source& source, Contents contents) {
  sort_nodes(source, contents);
  refuse_repeated_elements(source, contents);
  Mesh mesh;
  mesh.dimension = cell_dimension(source, contents);
  const NodeNumbers numbers(contents, mesh.dimension, source);
  mesh.nodes = numbers.nodes();
  const Cells cells = take_cells(source, contents, numbers, mesh);
  if (mesh.dimension == 2) flatten(source, mesh);
  orient(source, cells, mesh);
  try {
    find_boundary_faces(mesh);
    refuse_hanging_nodes(mesh);
  } catch (const base::InputError& error) {
    source.fail_without_place(error.what());
  }
  take_groups(source, contents, numbers, mesh);
  return mesh;
}

}  // namespace diptych::meshes::msh
