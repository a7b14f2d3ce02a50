#include "meshes/structured_block.hpp"

#include "common/base/error.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/incidence.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <utility>

namespace diptych::meshes {

namespace {

using Place = std::array<std::int32_t, 3>;

[[noreturn]] void refuse(const BlockUse& use, const std::string& what) {
  throw base::InputError(use.asked +
                         " takes one undistorted block of hexahedra or quadrilaterals, but " +
                         what + "; use " + use.instead);
}

std::string text(const Vec3& X) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", X[0], X[1], X[2]);
}

std::string cell_text(const Mesh& mesh, std::int64_t c) {
  Vec3 centre = Vec3::Zero();
  for (const std::int32_t a : mesh.cell(c))
    centre += mesh.nodes[a] / static_cast<double>(mesh.cell(c).size());
  return fmt::format("cell {} at {}", c, text(centre));
}

std::string node_text(const Mesh& mesh, std::int64_t a) {
  return fmt::format("node {} at {}", a, text(mesh.nodes[a]));
}

constexpr std::int32_t unknown = std::numeric_limits<std::int32_t>::min();

CellType type_of_block(const Mesh& mesh) {
  return mesh.dimension == 3 ? CellType::hexahedron : CellType::quadrilateral;
}

/// Nodes that are numbered line by line, as those of a box are, the first direction fastest;
/// directions as corner 0 of cell 0 has them. Such places need no walk: each cell has its corners
/// where its first node says, and each place has one cell.
class LineNumbers {
 public:
  explicit LineNumbers(const Mesh& mesh) : mesh_(mesh), corners_(corners_of(type_of_block(mesh))) {
    const auto nodes = mesh.cell(0);
    stride_[2] = mesh.n_nodes();
    for (int d = 0; d < mesh.dimension; ++d)
      stride_[d] = nodes[corners_[0].neighbours[d]] - nodes[corners_[0].node];
    for (const LocalCorner& corner : corners_)
      difference_.push_back(nodes[corner.node] - nodes[corners_[0].node]);
  }

  bool hold() const {
    if (stride_[0] != 1 || stride_[1] < 2 || stride_[2] < 2 * stride_[1]) return false;
    if (stride_[2] % stride_[1] != 0 || mesh_.n_nodes() % stride_[2] != 0) return false;
    std::int64_t n_cells = 1;
    for (int d = 0; d < mesh_.dimension; ++d)
      n_cells *= count(d) - 1;
    return n_cells == mesh_.n_cells() && first_cell_is_a_box() && all_cells_are_as_the_first();
  }

  Place place_of(std::int64_t a) const {
    return {static_cast<std::int32_t>(a % stride_[1]),
            static_cast<std::int32_t>(a % stride_[2] / stride_[1]),
            static_cast<std::int32_t>(a / stride_[2])};
  }

 private:
  /// Nodes along direction d.
  std::int64_t count(int d) const {
    return d == 2 ? mesh_.n_nodes() / stride_[2] : stride_[d + 1] / stride_[d];
  }

  /// Corners at the places 0 and 1, of which those of an edge differ in one direction.
  bool first_cell_is_a_box() const {
    const auto nodes = mesh_.cell(0);
    const auto place_in_cell = [&](int corner) {
      const std::int64_t difference = nodes[corner] - nodes[corners_[0].node];
      return difference < 0 ? Place{-1, -1, -1} : place_of(difference);
    };
    for (const LocalCorner& corner : corners_) {
      const Place at = place_in_cell(corner.node);
      for (int d = 0; d < 3; ++d)
        if (at[d] < 0 || at[d] > 1) return false;
      for (int k = 0; k < mesh_.dimension; ++k) {
        const Place beside = place_in_cell(corner.neighbours[k]);
        int n_apart = 0;
        for (int d = 0; d < 3; ++d)
          n_apart += at[d] != beside[d] ? 1 : 0;
        if (n_apart != 1) return false;
      }
    }
    return true;
  }

  bool all_cells_are_as_the_first() const {
    std::vector<char> has_cell(static_cast<size_t>(mesh_.n_nodes()), 0);
    for (std::int64_t c = 0; c < mesh_.n_cells(); ++c) {
      const auto nodes = mesh_.cell(c);
      const std::int32_t a = nodes[corners_[0].node];
      const Place at = place_of(a);
      for (int d = 0; d < mesh_.dimension; ++d)
        if (at[d] + 1 >= count(d)) return false;
      for (size_t k = 0; k < corners_.size(); ++k)
        if (nodes[corners_[k].node] - a != difference_[k]) return false;
      if (has_cell[a]++ != 0) return false;
    }
    return true;
  }

  const Mesh& mesh_;
  std::span<const LocalCorner> corners_;
  std::array<std::int64_t, 3> stride_{};  ///< of node numbers along the directions
  std::vector<std::int64_t> difference_;  ///< [corners] of node numbers from corner 0, of cell 0
};

/// Walks from cell 0, whose first corner is the origin, through the faces of cells.
class Walk {
 public:
  Walk(const Mesh& mesh, const BlockUse& use)
      : mesh_(mesh),
        use_(use),
        type_(type_of_block(mesh)),
        around_(cells_around_nodes(mesh)),
        visited_(static_cast<size_t>(mesh.n_cells()), 0),
        place_(mesh.nodes.size(), Place{unknown, unknown, unknown}) {}

  /// Places of all nodes, of which some may be the same.
  std::vector<Place> places() {
    place_first_cell();
    for (size_t next = 0; next < queue_.size(); ++next) {
      for (const LocalFace& face : faces_of(type_))
        pass(queue_[next], face);
    }
    if (static_cast<std::int64_t>(queue_.size()) != mesh_.n_cells()) {
      const auto c = std::find(visited_.begin(), visited_.end(), 0) - visited_.begin();
      refuse(use_, cell_text(mesh_, c) + " is not connected to cell 0 through faces");
    }
    return std::move(place_);
  }

 private:
  void place_first_cell() {
    const auto nodes = mesh_.cell(0);
    const LocalCorner& corner = corners_of(type_)[0];
    place_[nodes[corner.node]] = {0, 0, 0};
    for (int d = 0; d < mesh_.dimension; ++d) {
      Place at{0, 0, 0};
      at[d] = 1;
      place_[nodes[corner.neighbours[d]]] = at;
    }
    // Then corners beside two known ones, then the one beside three: each is as far along each
    // direction as the farthest of them. All of a round at once: farther ones must not count.
    for (int round = 1; round < mesh_.dimension; ++round) {
      std::vector<std::pair<std::int32_t, Place>> found;
      for (const LocalCorner& other : corners_of(type_)) {
        const std::int32_t a = nodes[other.node];
        if (place_[a][0] == unknown) found.emplace_back(a, from_neighbours(nodes, other));
      }
      for (const auto& [a, at] : found)
        if (at[0] != unknown) place_[a] = at;
    }
    visited_[0] = 1;
    queue_.push_back(0);
  }

  /// Of a corner that is beside two known ones or more; unknown of others.
  Place from_neighbours(std::span<const std::int32_t> nodes, const LocalCorner& corner) const {
    Place at{0, 0, 0};
    int n_known = 0;
    for (int k = 0; k < mesh_.dimension; ++k) {
      const Place& beside = place_[nodes[corner.neighbours[k]]];
      if (beside[0] == unknown) continue;
      ++n_known;
      for (int d = 0; d < 3; ++d)
        at[d] = std::max(at[d], beside[d]);
    }
    return n_known >= 2 ? at : Place{unknown, unknown, unknown};
  }

  /// Goes through a face of cell c to the cell behind it.
  void pass(std::int64_t c, const LocalFace& face) {
    const auto nodes = mesh_.cell(c);
    const std::int64_t behind =
        cell_behind(c, nodes[face.nodes[0]], nodes[face.nodes[face.n_nodes / 2]]);
    if (behind < 0) return;
    const bool is_new = visited_[behind] == 0;
    if (is_new) {
      visited_[behind] = 1;
      queue_.push_back(behind);
    }
    // outwards: from the corner behind a node of the face to that node
    std::array<std::int32_t, 4> shared{};
    for (int i = 0; i < face.n_nodes; ++i)
      shared[i] = nodes[face.nodes[i]];
    const std::span<const std::int32_t> face_nodes{shared.data(),
                                                   static_cast<size_t>(face.n_nodes)};
    const std::int32_t inside = across(c, face_nodes, shared[0]);
    Place step{};
    for (int d = 0; d < 3; ++d)
      step[d] = place_[shared[0]][d] - place_[inside][d];
    for (const std::int32_t a : face_nodes)
      place_behind(behind, across(behind, face_nodes, a), a, step);
  }

  /// The other cell that has both nodes, which are opposite corners of a face; -1: none.
  std::int64_t cell_behind(std::int64_t c, std::int32_t a, std::int32_t b) const {
    const auto of_a = around_.cells(a), of_b = around_.cells(b);
    size_t i = 0, j = 0;
    while (i < of_a.size() && j < of_b.size()) {
      if (of_a[i] == of_b[j] && of_a[i] != c) return of_a[i];
      of_a[i] < of_b[j] ? ++i : ++j;
    }
    return -1;
  }

  /// The node of the cell beside a that is not of the face.
  std::int32_t across(std::int64_t c,
                      std::span<const std::int32_t> face_nodes,
                      std::int32_t a) const {
    const auto nodes = mesh_.cell(c);
    for (const LocalCorner& corner : corners_of(type_)) {
      if (nodes[corner.node] != a) continue;
      for (int k = 0; k < mesh_.dimension; ++k) {
        const std::int32_t b = nodes[corner.neighbours[k]];
        if (std::find(face_nodes.begin(), face_nodes.end(), b) == face_nodes.end()) return b;
      }
    }
    refuse(use_, cell_text(mesh_, c) + " has only a part of a face in common with its neighbour");
  }

  void place_behind(std::int64_t c, std::int32_t b, std::int32_t a, const Place& step) {
    Place at = place_[a];
    for (int d = 0; d < 3; ++d)
      at[d] += step[d];
    if (place_[b][0] == unknown) place_[b] = at;
    if (place_[b] != at) {
      refuse(
          use_,
          "at " + cell_text(mesh_, c) +
              " the cells are not arranged as those of a box (a ring, or an inner edge where other "
              "than four cells meet)");
    }
  }

  const Mesh& mesh_;
  const BlockUse& use_;
  CellType type_;
  Incidence around_;
  std::vector<char> visited_;
  std::vector<Place> place_;
  std::vector<std::int64_t> queue_;
};

void check_types(const Mesh& mesh, const BlockUse& use) {
  const CellType wanted = type_of_block(mesh);
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.cell_types[c] == wanted) continue;
    refuse(use, fmt::format("{} is a {}", cell_text(mesh, c), name_of(mesh.cell_types[c])));
  }
}

/// Places of all nodes, of which some may be the same.
std::vector<Place> places_of(const Mesh& mesh, const BlockUse& use) {
  const LineNumbers numbers(mesh);
  if (!numbers.hold()) return Walk(mesh, use).places();
  std::vector<Place> places;
  places.reserve(mesh.nodes.size());
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a)
    places.push_back(numbers.place_of(a));
  return places;
}

/// Counts from zero, and how many there are along each direction.
void count_from_zero(StructuredBlock& block) {
  Place least = block.place[0], most = least;
  for (const Place& at : block.place) {
    for (int d = 0; d < 3; ++d) {
      least[d] = std::min(least[d], at[d]);
      most[d] = std::max(most[d], at[d]);
    }
  }
  for (Place& at : block.place) {
    for (int d = 0; d < 3; ++d)
      at[d] -= least[d];
  }
  for (int d = 0; d < 3; ++d)
    block.n_nodes[d] = most[d] - least[d] + 1;
}

/// Every place of the box of lattice places has one node, and every cell of it is there.
void fill_nodes(const Mesh& mesh, const BlockUse& use, StructuredBlock& block) {
  const auto [nx, ny, nz] = block.n_nodes;
  const std::int64_t n_places = static_cast<std::int64_t>(nx) * ny * nz;
  const std::int64_t n_cells =
      static_cast<std::int64_t>(nx - 1) * (ny - 1) * (block.dimension == 3 ? nz - 1 : 1);
  if (n_places != mesh.n_nodes() || n_cells != mesh.n_cells()) {
    refuse(use, fmt::format("its {} cells do not fill the {} x {}{} of the block of their lines",
                            mesh.n_cells(), nx - 1, ny - 1,
                            block.dimension == 3 ? fmt::format(" x {}", nz - 1) : ""));
  }
  block.node.assign(static_cast<size_t>(n_places), -1);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    const Place& at = block.place[a];
    std::int32_t& node = block.node[static_cast<size_t>(
        (static_cast<std::int64_t>(at[2]) * ny + at[1]) * nx + at[0])];
    if (node >= 0) {
      refuse(use, fmt::format("{} and {} have the same place on its lines of nodes",
                              node_text(mesh, node), node_text(mesh, a)));
    }
    node = static_cast<std::int32_t>(a);
  }
}

/// Of the least edge: nodes may be as far off by rounding and by the digits of mesh files, and rows
/// are exact for linear fields as far as this.
constexpr double most_off = 1e-8;

}  // namespace

StructuredBlock structured_block(const Mesh& mesh, const BlockUse& use) {
  if (mesh.n_cells() == 0) refuse(use, "the mesh has no cells");
  check_types(mesh, use);
  StructuredBlock block;
  block.dimension = mesh.dimension;
  block.place = places_of(mesh, use);
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    if (block.place[a][0] == unknown) refuse(use, node_text(mesh, a) + " belongs to no cell");
  }
  count_from_zero(block);
  fill_nodes(mesh, use, block);
  return block;
}

Mat3 cell_edges(const Mesh& mesh, const StructuredBlock& block, const BlockUse& use) {
  const Vec3& origin = mesh.nodes[block.node_at({0, 0, 0})];
  Mat3 edges = Mat3::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < block.dimension; ++d) {
    Place end{0, 0, 0};
    end[d] = block.n_nodes[d] - 1;
    edges.col(d) = (mesh.nodes[block.node_at(end)] - origin) / end[d];
    least = std::min(least, edges.col(d).norm());
  }
  double worst = 0;
  std::int64_t worst_node = 0;
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    Vec3 X = origin;
    for (int d = 0; d < block.dimension; ++d)
      X += block.place[a][d] * edges.col(d);
    const double off = (mesh.nodes[a] - X).norm();
    if (off > worst) worst_node = a;
    worst = std::max(worst, off);
  }
  if (!(worst <= most_off * least)) {
    refuse(use,
           fmt::format("{} is {:.2g} of a spacing off the even lattice between the corners of the "
                       "block (a curved or graded block, or mesh.perturbation)",
                       node_text(mesh, worst_node), worst / least));
  }
  if (!(edges.determinant() > 0)) refuse(use, "its cells are inside out");
  return edges;
}

bool is_undistorted_block(const Mesh& mesh) {
  try {
    const BlockUse any;
    cell_edges(mesh, structured_block(mesh, any), any);
    return true;
  } catch (const base::InputError&) {  // says why not, which only who asked for a block wants
    return false;
  }
}

}  // namespace diptych::meshes
