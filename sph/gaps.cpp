#include "sph/gaps.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>

namespace diptych::sph {

namespace {

/// How far a path may lead, over the distance of the farthest neighbour: meshes are not all
/// Delaunay.
constexpr double detour = 1.25;

/// Walks from one node at a time; a thread has one of its own.
class Walk {
 public:
  Walk(const std::vector<Vec3>& X, const meshes::NodalGraph& near)
      : X_(X), near_(near), seen_from_(X.size(), -1) {}

  /// Marks the neighbours of a, [first, last) of `rows`, that it reaches.
  void reach(std::int32_t a, const Rows& rows, std::vector<std::uint8_t>& is_reached) {
    const auto first = rows.row[a], last = rows.row[a + 1];
    double farthest = 0;
    for (std::int64_t p = first; p < last; ++p)
      farthest = std::max(farthest, (X_[rows.neighbour[p]] - X_[a]).norm());
    const auto begin = rows.neighbour.begin() + first, end = rows.neighbour.begin() + last;
    path_.assign(1, a);
    seen_from_[a] = a;
    std::int64_t left = last - first;
    for (size_t i = 0; i < path_.size() && left > 0; ++i) {
      for (const std::int32_t b : near_.around(path_[i])) {
        if (seen_from_[b] == a) continue;
        seen_from_[b] = a;
        if ((X_[b] - X_[a]).norm() <= detour * farthest) path_.push_back(b);
        const auto place = std::lower_bound(begin, end, b);
        if (place == end || *place != b) continue;
        is_reached[static_cast<size_t>(first + (place - begin))] = 1;
        --left;
      }
    }
  }

 private:
  const std::vector<Vec3>& X_;
  const meshes::NodalGraph& near_;
  std::vector<std::int32_t> seen_from_, path_;
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
