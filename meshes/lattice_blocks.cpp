#include "meshes/lattice_blocks.hpp"

#include "meshes/block_kinks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/cell_walls.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace diptych::meshes {

namespace {

using Place = std::array<int, 3>;
/// Which end of a cell each of its corners is at: bit d for direction d.
using Corners = std::array<std::uint8_t, 8>;
constexpr Corners in_own_frame{0, 1, 3, 2, 4, 5, 7, 6};  // the order of Gmsh

/// The walls that are cut.
class Cuts {
 public:
  Cuts(const Mesh& mesh, const CellWalls& walls)
      : walls_(walls), is_cut_(static_cast<size_t>(walls.n_walls()), 0) {
    const auto groups = groups_of_faces(mesh);
    for (std::int64_t r = 0; r + 1 < std::ssize(walls.ridge_first); ++r) {
      if (!is_regular(r) || ends_group(groups, r)) add_all(r);
    }
  }

  bool is_cut(std::int64_t wall) const { return is_cut_[static_cast<size_t>(wall)] != 0; }

  /// Cuts a wall and all that goes on from it.
  void add(std::int64_t wall) {
    std::vector<std::int64_t> left{wall};
    while (!left.empty()) {
      const std::int64_t w = left.back();
      left.pop_back();
      if (!walls_.is_inner(w) || is_cut(w)) continue;
      is_cut_[static_cast<size_t>(w)] = 1;
      for (const std::int64_t r : walls_.ridges[w])
        if (r >= 0) add_opposite(r, w, left);
    }
  }

 private:
  void add_all(std::int64_t ridge) {
    for (const std::int64_t w : walls_.around(ridge))
      add(w);
  }

  bool is_inside(std::int64_t ridge) const {
    const auto around = walls_.around(ridge);
    return std::all_of(around.begin(), around.end(), [&](auto w) { return walls_.is_inner(w); });
  }

  /// Four cells inside, at most two on the boundary.
  bool is_regular(std::int64_t ridge) const {
    const size_t n = walls_.around(ridge).size();
    return is_inside(ridge) ? n == 4 : n <= 3;
  }

  /// Whether its two faces on the boundary are of different groups.
  bool ends_group(const std::map<FaceKey, std::vector<int>>& groups, std::int64_t ridge) const {
    const std::vector<int>* first = nullptr;
    for (const std::int64_t w : walls_.around(ridge)) {
      if (walls_.is_inner(w)) continue;
      const std::vector<int>& of_wall = groups.at(walls_.key[w]);
      if (first != nullptr && *first != of_wall) return true;
      first = &of_wall;
    }
    return false;
  }

  /// The wall straight on behind a ridge with four cells.
  void add_opposite(std::int64_t ridge, std::int64_t wall, std::vector<std::int64_t>& left) const {
    if (!is_inside(ridge) || walls_.around(ridge).size() != 4) return;
    const auto& own = walls_.cells[wall];
    for (const std::int64_t w : walls_.around(ridge)) {
      const auto& other = walls_.cells[w];
      if (std::find_first_of(own.begin(), own.end(), other.begin(), other.end()) == own.end())
        left.push_back(w);
    }
  }

  const CellWalls& walls_;
  std::vector<char> is_cut_;
};

/// Lays the cells of one block on a lattice, walking through walls that are not cut.
class BlockWalk {
 public:
  BlockWalk(const Mesh& mesh, const CellWalls& walls, const Cuts& cuts)
      : mesh_(mesh),
        walls_(walls),
        cuts_(cuts),
        faces_(faces_of(mesh.cell_types[0])),
        corners_(static_cast<size_t>(mesh.n_cells())),
        at_(static_cast<size_t>(mesh.n_cells())),
        is_placed_(static_cast<size_t>(mesh.n_cells()), 0) {}

  bool is_placed(std::int64_t c) const { return is_placed_[static_cast<size_t>(c)] != 0; }

  /// The block of cell c. @return whether it is one
  bool walk(std::int64_t c, LatticeBlock& block) {
    cells_.assign(1, c);
    period_ = {0, 0, 0};
    std::copy_n(in_own_frame.begin(), mesh_.cell(c).size(), corners_[c].begin());
    at_[c] = {0, 0, 0};
    is_placed_[c] = 1;
    for (size_t next = 0; next < cells_.size(); ++next) {
      for (int f = 0; f < walls_.per_cell; ++f)
        if (!pass(cells_[next], f)) return false;
    }
    block.dimension = mesh_.dimension;
    return count(block) && fill_cells(block) && fill_nodes(block);
  }

 private:
  /// The bit that the nodes of a local face have in common, and its value.
  std::pair<int, bool> side_of(std::int64_t c, const LocalFace& face) const {
    for (int d = 0; d < mesh_.dimension; ++d) {
      int far = 0;
      for (int i = 0; i < face.n_nodes; ++i)
        far += corners_[c][face.nodes[i]] >> d & 1;
      if (far == 0 || far == face.n_nodes) return {d, far != 0};
    }
    return {0, false};
  }

  int local(std::int64_t c, std::int32_t node) const {
    const auto nodes = mesh_.cell(c);
    return static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
  }

  /// The corners of the cell behind a face, in the directions of cell c.
  Corners corners_behind(std::int64_t c, const LocalFace& face, std::int64_t behind, int d) const {
    const auto flipped = static_cast<std::uint8_t>(1U << d);
    Corners corners{};
    for (int i = 0; i < face.n_nodes; ++i) {
      const int shared = local(behind, mesh_.cell(c)[face.nodes[i]]);
      corners[shared] = corners_[c][face.nodes[i]] ^ flipped;
    }
    for (int i = 0; i < face.n_nodes; ++i) {
      const int shared = local(behind, mesh_.cell(c)[face.nodes[i]]);
      for (int k = 0; k < mesh_.dimension; ++k) {
        const int beside = corners_of(mesh_.cell_types[0])[shared].neighbours[k];
        const std::int32_t a = mesh_.cell(behind)[beside];
        const bool is_shared = local(c, a) < static_cast<int>(mesh_.cell(c).size());
        if (!is_shared) corners[beside] = corners[shared] ^ flipped;
      }
    }
    return corners;
  }

  bool pass(std::int64_t c, int f) {
    const std::int64_t wall = walls_.of_cell[c * walls_.per_cell + f];
    if (!walls_.is_inner(wall) || cuts_.is_cut(wall)) return true;
    const auto& cells = walls_.cells[wall];
    const std::int64_t behind = cells[0] == c ? cells[1] : cells[0];
    const auto [d, is_far] = side_of(c, faces_[f]);
    const Corners corners = corners_behind(c, faces_[f], behind, d);
    Place at = at_[c];
    at[d] += is_far ? 1 : -1;
    if (is_placed_[behind] != 0) return corners == corners_[behind] && closes(at, at_[behind]);
    is_placed_[behind] = 1;
    corners_[behind] = corners;
    at_[behind] = at;
    cells_.push_back(behind);
    return true;
  }

  /// A cell that is met at a second place closes lines along one direction.
  bool closes(const Place& at, const Place& first) {
    int n_apart = 0;
    for (int d = 0; d < 3; ++d) {
      if (at[d] == first[d]) continue;
      ++n_apart;
      period_[d] = std::gcd(period_[d], at[d] - first[d]);
    }
    return n_apart <= 1;
  }

  bool count(LatticeBlock& block) {
    constexpr int least_ring = 3;
    Place least = at_[cells_[0]], most = least;
    for (const std::int64_t c : cells_) {
      for (int d = 0; d < 3; ++d) {
        least[d] = std::min(least[d], at_[c][d]);
        most[d] = std::max(most[d], at_[c][d]);
      }
    }
    std::int64_t n = 1;
    for (int d = 0; d < mesh_.dimension; ++d) {
      block.is_closed[d] = period_[d] != 0;
      block.n_cells[d] = block.is_closed[d] ? period_[d] : most[d] - least[d] + 1;
      block.n_nodes[d] = block.n_cells[d] + (block.is_closed[d] ? 0 : 1);
      if (block.is_closed[d] && block.n_cells[d] < least_ring) return false;
      n *= block.n_cells[d];
    }
    for (const std::int64_t c : cells_) {
      for (int d = 0; d < mesh_.dimension; ++d)
        at_[c][d] = (at_[c][d] - least[d]) % block.n_cells[d];
    }
    return n == std::ssize(cells_);
  }

  bool fill_cells(LatticeBlock& block) const {
    block.cell.assign(cells_.size(), -1);
    for (const std::int64_t c : cells_) {
      const Place& at = at_[c];
      std::int64_t& cell = block.cell[static_cast<size_t>(
          (static_cast<std::int64_t>(at[2]) * block.n_cells[1] + at[1]) * block.n_cells[0] +
          at[0])];
      if (cell >= 0) return false;
      cell = c;
    }
    return true;
  }

  bool fill_nodes(LatticeBlock& block) const {
    block.node.assign(static_cast<size_t>(block.n_nodes[0]) * block.n_nodes[1] * block.n_nodes[2],
                      -1);
    for (const std::int64_t c : cells_) {
      const auto nodes = mesh_.cell(c);
      for (size_t i = 0; i < nodes.size(); ++i) {
        Place at = at_[c];
        for (int d = 0; d < mesh_.dimension; ++d)
          at[d] += corners_[c][i] >> d & 1;
        std::int32_t& node = block.node[static_cast<size_t>(block.index(at))];
        if (node >= 0 && node != nodes[i]) return false;
        node = nodes[i];
      }
    }
    return true;
  }

  const Mesh& mesh_;
  const CellWalls& walls_;
  const Cuts& cuts_;
  std::span<const LocalFace> faces_;
  std::vector<Corners> corners_;
  std::vector<Place> at_;
  std::vector<char> is_placed_;
  std::vector<std::int64_t> cells_;
  Place period_{};
};

std::vector<LatticeBlock> blocks_between(const Mesh& mesh,
                                         const CellWalls& walls,
                                         const Cuts& cuts) {
  std::vector<LatticeBlock> blocks;
  BlockWalk walk(mesh, walls, cuts);
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    if (!walk.is_placed(c) && !walk.walk(c, blocks.emplace_back())) return {};
  }
  return blocks;
}

}  // namespace

std::vector<LatticeBlock> lattice_blocks(const Mesh& mesh) {
  const CellType wanted = mesh.dimension == 3 ? CellType::hexahedron : CellType::quadrilateral;
  const auto is_wanted = [&](CellType type) { return type == wanted; };
  if (mesh.n_cells() == 0 ||
      !std::all_of(mesh.cell_types.begin(), mesh.cell_types.end(), is_wanted))
    return {};
  const CellWalls walls = cell_walls(mesh);
  Cuts cuts(mesh, walls);
  std::vector<LatticeBlock> blocks = blocks_between(mesh, walls, cuts);
  bool has_kinks = false;
  for (const LatticeBlock& block : blocks) {
    for (const CellPair& pair : cells_at_kinks(mesh, block)) {
      cuts.add(walls.between(pair.first, pair.second));
      has_kinks = true;
    }
  }
  return has_kinks ? blocks_between(mesh, walls, cuts) : blocks;
}

}  // namespace diptych::meshes
