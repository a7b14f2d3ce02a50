#include "sph/gaps.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace diptych::sph {

namespace {

/// How much longer than the straight line a path may be. Edges of a Delaunay triangulation of the
/// plane make it at most 1.998 times as long (Xia, SIAM J. Comput. 42 (2013) 1620), tetrahedra with
/// nodes moved by 30 % too. Around the end of a slit, whose two sides a straight line joins at
/// once, it is as many times as long as one likes: where such pairs were kept, the prongs of a fork
/// swung as if they were shorter by half a support, 15 % too fast with four cells across each, 3 %
/// now.
constexpr double detour = 2;

/// Lengths of paths to the few nodes that a walk comes to, a table of open addressing: an array
/// over all nodes for each thread would outgrow the mesh.
class Lengths {
 public:
  Lengths() : entries_(least_size) {}
  void clear() {
    std::fill(entries_.begin(), entries_.end(), Entry{});
    n_ = 0;
  }
  /// m, of the shortest path so far; infinite where there is none
  double to(std::int32_t node) const { return entries_[place_of(node)].length; }
  void set(std::int32_t node, double length) {
    const size_t place = place_of(node);
    n_ += entries_[place].node != node;
    entries_[place] = {node, length};
    if (2 * n_ > entries_.size()) grow();
  }

 private:
  static constexpr size_t least_size = 512;
  struct Entry {
    std::int32_t node = -1;
    double length = std::numeric_limits<double>::infinity();
  };
  size_t place_of(std::int32_t node) const {
    size_t place = static_cast<std::uint32_t>(node) * 2654435761U & (entries_.size() - 1);
    while (entries_[place].node != node && entries_[place].node >= 0)
      place = (place + 1) & (entries_.size() - 1);
    return place;
  }
  void grow() {
    std::vector<Entry> before(2 * entries_.size());
    before.swap(entries_);
    for (const Entry& entry : before)
      if (entry.node >= 0) entries_[place_of(entry.node)] = entry;
  }

  std::vector<Entry> entries_;  // a power of two of them
  size_t n_ = 0;
};

/// Walks from one node at a time; a thread has one of its own.
class Walk {
 public:
  Walk(const std::vector<Vec3>& X, const meshes::NodalGraph& near) : X_(X), near_(near) {}

  /// Marks the neighbours of a, [first, last) of `rows`, that it reaches: the shortest paths first.
  void reach(std::int32_t a, const Rows& rows, std::vector<std::uint8_t>& is_reached) {
    const auto first = rows.row[a], last = rows.row[a + 1];
    double farthest = 0;
    for (std::int64_t p = first; p < last; ++p)
      farthest = std::max(farthest, distance(a, rows.neighbour[p]));
    const auto begin = rows.neighbour.begin() + first, end = rows.neighbour.begin() + last;
    std::int64_t left = last - first;
    next_ = {};
    length_.clear();
    come_to(a, 0);
    while (!next_.empty()) {
      const auto [length, c] = next_.top();
      next_.pop();
      if (length > length_.to(c)) continue;  // a shorter one has been there
      if (std::binary_search(begin, end, c) && --left == 0) break;
      for (const std::int32_t b : near_.around(c)) {
        const double there = length + distance(c, b);
        if (there <= detour * farthest && there < length_.to(b)) come_to(b, there);
      }
    }
    for (std::int64_t p = first; p < last; ++p) {
      const std::int32_t b = rows.neighbour[p];
      is_reached[static_cast<size_t>(p)] = length_.to(b) <= detour * distance(a, b);
    }
  }

 private:
  using Place = std::pair<double, std::int32_t>;  // length of the path to a node

  double distance(std::int32_t a, std::int32_t b) const { return (X_[b] - X_[a]).norm(); }
  void come_to(std::int32_t b, double length) {
    length_.set(b, length);
    next_.emplace(length, b);
  }

  const std::vector<Vec3>& X_;
  const meshes::NodalGraph& near_;
  Lengths length_;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> next_;
};

}  // namespace

void drop_pairs_across_gaps(const meshes::Mesh& mesh, Rows& rows) {
  const meshes::NodalGraph near = meshes::nodal_graph(mesh);
  const std::int64_t n = mesh.n_nodes(), n_shares = parallel::n_threads();
  std::vector<std::uint8_t> is_reached(rows.neighbour.size(), 0);
  parallel::for_shares(n_shares, [&](std::int64_t share) {
    Walk walk(mesh.nodes, near);
    for (std::int64_t a = n * share / n_shares; a < n * (share + 1) / n_shares; ++a)
      walk.reach(static_cast<std::int32_t>(a), rows, is_reached);
  });
  if (std::find(is_reached.begin(), is_reached.end(), 0) == is_reached.end()) return;
  const auto is_joined = [&](std::int32_t a, std::int64_t p) {
    const std::int32_t b = rows.neighbour[p];
    const auto begin = rows.neighbour.begin();
    const auto back = std::lower_bound(begin + rows.row[b], begin + rows.row[b + 1], a) - begin;
    return is_reached[p] != 0 && is_reached[back] != 0;
  };
  Rows kept;
  kept.row.push_back(0);
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      if (is_joined(a, p)) kept.neighbour.push_back(rows.neighbour[p]);
    }
    kept.row.push_back(static_cast<std::int64_t>(kept.neighbour.size()));
  }
  rows = std::move(kept);
}

}  // namespace diptych::sph
