#include "meshes/renumber.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace diptych::meshes {

namespace {

/// Cells around each node, and the number of distinct neighbours of each node.
struct NodeGraph {
  const Mesh& mesh;
  std::vector<std::int64_t> offsets;  // [n_nodes + 1] into cells
  std::vector<std::int32_t> cells;
  std::vector<std::int32_t> degrees;  // [n_nodes]

  explicit NodeGraph(const Mesh& m) : mesh(m) {
    offsets.assign(mesh.n_nodes() + 1, 0);
    for (const std::int32_t a : mesh.cell_nodes)
      ++offsets[a + 1];
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    cells.resize(mesh.cell_nodes.size());
    std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
      for (const std::int32_t a : mesh.cell(c))
        cells[next[a]++] = static_cast<std::int32_t>(c);
    }
    count_neighbours();
  }

  std::span<const std::int32_t> cells_of(std::int32_t a) const {
    return {cells.data() + offsets[a], static_cast<size_t>(offsets[a + 1] - offsets[a])};
  }

 private:
  void count_neighbours() {
    degrees.assign(mesh.n_nodes(), 0);
    std::vector<std::int32_t> seen_from(mesh.n_nodes(), -1);
    for (std::int32_t a = 0; a < mesh.n_nodes(); ++a) {
      seen_from[a] = a;
      for (const std::int32_t c : cells_of(a)) {
        for (const std::int32_t b : mesh.cell(c)) {
          if (seen_from[b] == a) continue;
          seen_from[b] = a;
          ++degrees[a];
        }
      }
    }
  }
};

/// Breadth-first walks over one part. A cell is opened by its first node only: from then on all of
/// its nodes are in the walk.
class Walker {
 public:
  explicit Walker(const NodeGraph& graph)
      : graph_(graph), node_round_(graph.mesh.n_nodes(), 0), cell_round_(graph.mesh.n_cells(), 0) {}

  /// Nodes in Cuthill-McKee order from `start`: each node's new neighbours by degree, then index.
  std::vector<std::int32_t> walk(std::int32_t start) {
    ++round_;
    std::vector<std::int32_t> order{start};
    node_round_[start] = round_;
    depth_ = 0;
    last_level_ = 0;
    size_t level_end = 1;
    for (size_t i = 0; i < order.size(); ++i) {
      if (i == level_end) {
        ++depth_;
        last_level_ = i;
        level_end = order.size();
      }
      const size_t first_new = order.size();
      add_neighbours(order[i], order);
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first_new), order.end(),
                [&](std::int32_t a, std::int32_t b) { return is_before(a, b); });
    }
    return order;
  }

  int depth() const { return depth_; }
  /// Index in the order just walked at which the farthest nodes begin.
  size_t last_level() const { return last_level_; }
  bool is_before(std::int32_t a, std::int32_t b) const {
    const auto& degrees = graph_.degrees;
    return degrees[a] != degrees[b] ? degrees[a] < degrees[b] : a < b;
  }

 private:
  void add_neighbours(std::int32_t a, std::vector<std::int32_t>& order) {
    for (const std::int32_t c : graph_.cells_of(a)) {
      if (cell_round_[c] == round_) continue;
      cell_round_[c] = round_;
      for (const std::int32_t b : graph_.mesh.cell(c)) {
        if (node_round_[b] == round_) continue;
        node_round_[b] = round_;
        order.push_back(b);
      }
    }
  }

  const NodeGraph& graph_;
  std::vector<int> node_round_, cell_round_;  // walk in which it was last met
  int round_ = 0;
  int depth_ = 0;
  size_t last_level_ = 0;
};

/// Walks from one far end of a part: as long as the farthest node of least degree sees deeper.
std::vector<std::int32_t> peripheral_walk(Walker& walker, std::int32_t start) {
  std::vector<std::int32_t> order = walker.walk(start);
  for (;;) {
    const int depth = walker.depth();
    const auto farthest = std::min_element(
        order.begin() + static_cast<std::ptrdiff_t>(walker.last_level()), order.end(),
        [&](std::int32_t a, std::int32_t b) { return walker.is_before(a, b); });
    std::vector<std::int32_t> other = walker.walk(*farthest);
    order.swap(other);
    if (walker.depth() <= depth) return order;
  }
}

}  // namespace

std::vector<std::int32_t> rcm_order(const Mesh& mesh) {
  const NodeGraph graph(mesh);
  Walker walker(graph);
  std::vector<std::int32_t> candidates(mesh.n_nodes());
  std::iota(candidates.begin(), candidates.end(), 0);
  std::stable_sort(candidates.begin(), candidates.end(), [&](std::int32_t a, std::int32_t b) {
    return graph.degrees[a] < graph.degrees[b];
  });
  std::vector<bool> is_placed(mesh.n_nodes(), false);
  std::vector<std::int32_t> order;
  order.reserve(mesh.n_nodes());
  for (const std::int32_t start : candidates) {
    if (is_placed[start]) continue;
    for (const std::int32_t a : peripheral_walk(walker, start)) {
      is_placed[a] = true;
      order.push_back(a);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

Mesh renumbered(const Mesh& mesh, const std::vector<std::int32_t>& order) {
  assert(static_cast<std::int64_t>(order.size()) == mesh.n_nodes());
  std::vector<std::int32_t> new_index(order.size(), -1);
  Mesh result = mesh;
  for (size_t i = 0; i < order.size(); ++i) {
    assert(order[i] >= 0 && order[i] < mesh.n_nodes() && new_index[order[i]] == -1);
    new_index[order[i]] = static_cast<std::int32_t>(i);
    result.nodes[i] = mesh.nodes[order[i]];
  }
  for (std::int32_t& a : result.cell_nodes)
    a = new_index[a];
  for (BoundaryFace& face : result.boundary_faces) {
    for (int i = 0; i < face.n_nodes; ++i)
      face.nodes[i] = new_index[face.nodes[i]];
  }
  return result;
}

std::int64_t bandwidth(const Mesh& mesh) {
  std::int64_t widest = 0;
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const auto [least, most] = std::ranges::minmax(mesh.cell(c));
    widest = std::max<std::int64_t>(widest, most - least);
  }
  return widest;
}

}  // namespace diptych::meshes
