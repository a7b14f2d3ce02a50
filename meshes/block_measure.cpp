#include "meshes/block_measure.hpp"

#include "common/base/error.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace diptych::meshes {

BlockMeasure::BlockMeasure(const Mesh& mesh,
                           StructuredBlock block,
                           std::vector<std::vector<double>> H,
                           BlockUse use)
    : mesh_(mesh),
      block_(std::move(block)),
      H_(std::move(H)),
      use_(std::move(use)),
      edges_(cell_edges(mesh, block_, use_)) {}

double BlockMeasure::volume(std::int64_t a) const {
  double Omega = edges_.determinant();
  for (int d = 0; d < block_.dimension; ++d)
    Omega *= H_[d][block_.place[a][d]];
  return Omega;
}

Vec3 BlockMeasure::face(int d) const {
  return edges_.col((d + 1) % 3).cross(edges_.col((d + 2) % 3));
}

Vec3 BlockMeasure::area(std::int64_t a, int d) const {
  Vec3 M = face(d);
  for (int t = 0; t < block_.dimension; ++t) {
    if (t != d) M *= H_[t][block_.place[a][t]];
  }
  return M;
}

Vec3 BlockMeasure::boundary_area(std::int64_t a) const {
  Vec3 sum = Vec3::Zero();
  for (int d = 0; d < block_.dimension; ++d) {
    const std::int32_t i = block_.place[a][d];
    if (i == 0) sum -= area(a, d);
    if (i == block_.n_nodes[d] - 1) sum += area(a, d);
  }
  return sum;
}

PatchArea BlockMeasure::patch(const BoundaryGroup& group) const {
  if (const auto end = unfit_end(group)) {
    throw base::InputError(fmt::format(
        "boundary group '{}' ends within the first nodes of a side, where the weights of {} are "
        "not those of its faces ({:.6g} spacings instead of {}): let it cover the whole side or "
        "end farther from its edge, or use {}",
        group.name, use_.asked, end->weights, end->node, use_.instead));
  }
  PatchArea patch;
  patch.name = group.name;
  patch.faces = corners_of(mesh_, group);
  std::vector<std::pair<std::int32_t, Vec3>> shares;
  for (const std::int32_t f : group.faces) {
    const BoundaryFace& face = mesh_.boundary_faces[f];
    const Side side = side_of(face);
    const double sign = side.is_far ? 1 : -1;
    for (int i = 0; i < face.n_nodes; ++i) {
      const std::int32_t a = face.nodes[i];
      shares.emplace_back(a, sign * area(a, side.direction) / n_faces_on_side(a, side));
    }
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  for (const auto& [a, share] : shares) {
    if (patch.nodes.empty() || patch.nodes.back() != a) {
      patch.nodes.push_back(a);
      patch.area.push_back(Vec3::Zero());
    }
    patch.area.back() += share;
  }
  return patch;
}

std::string BlockMeasure::unfit_group() const {
  for (const BoundaryGroup& group : mesh_.boundary_groups) {
    if (unfit_end(group))
      return fmt::format("group '{}' ends within the first nodes of a side", group.name);
  }
  return "";
}

/// Of the whole weights of the nodes before it, and half of its own: what the faces up to there
/// have.
double BlockMeasure::weights_before(int direction, std::int32_t node) const {
  const std::vector<double>& H = H_[static_cast<size_t>(direction)];
  return std::accumulate(H.begin(), H.begin() + node, 0.5 * H[static_cast<size_t>(node)]);
}

/// End by end: sums over a group could be right while what is too much at one end is missing at
/// another.
std::optional<BlockMeasure::GroupEnd> BlockMeasure::unfit_end(const BoundaryGroup& group) const {
  using Place = std::array<std::int32_t, 5>;  // direction, far, and those along the lines
  const auto place_of = [&](const BoundaryFace& face) {
    const Side side = side_of(face);
    Place place{side.direction, side.is_far ? 1 : 0, 0, 0, 0};
    for (int d = 0; d < block_.dimension; ++d) {
      place[2 + d] = block_.place[face.nodes[0]][d];
      for (int i = 1; i < face.n_nodes; ++i)
        place[2 + d] = std::min(place[2 + d], block_.place[face.nodes[i]][d]);
    }
    return place;
  };
  std::vector<Place> covered;
  covered.reserve(group.faces.size());
  for (const std::int32_t f : group.faces)
    covered.push_back(place_of(mesh_.boundary_faces[f]));
  std::sort(covered.begin(), covered.end());
  for (const Place& face : covered) {
    for (int d = 0; d < block_.dimension; ++d) {
      if (d == face[0]) continue;
      for (const int step : {-1, 1}) {
        Place next = face;
        next[2 + d] += step;
        if (next[2 + d] < 0 || next[2 + d] > block_.n_nodes[d] - 2) continue;
        if (std::binary_search(covered.begin(), covered.end(), next)) continue;
        const std::int32_t node = std::max(face[2 + d], next[2 + d]);
        const double weights = weights_before(d, node);
        if (std::abs(weights - node) > 1e-12 * block_.n_nodes[d]) return GroupEnd{node, weights};
      }
    }
  }
  return std::nullopt;
}

/// @pre the face is of the boundary, so of a side
BlockMeasure::Side BlockMeasure::side_of(const BoundaryFace& face) const {
  for (int d = 0; d < block_.dimension; ++d) {
    for (const bool is_far : {false, true}) {
      const std::int32_t end = is_far ? block_.n_nodes[d] - 1 : 0;
      const auto on_side = [&](std::int32_t a) { return block_.place[a][d] == end; };
      if (std::all_of(face.nodes.begin(), face.nodes.begin() + face.n_nodes, on_side))
        return {d, is_far};
    }
  }
  const Vec3& X = mesh_.nodes[face.nodes[0]];
  throw base::InputError(fmt::format(
      "the boundary face with node {} at ({:.6g}, {:.6g}, {:.6g}) is on no side of the block; "
      "repair the mesh",
      face.nodes[0], X[0], X[1], X[2]));
}

/// Faces of the side around one of its nodes.
double BlockMeasure::n_faces_on_side(std::int32_t a, const Side& side) const {
  double n = 1;
  for (int t = 0; t < block_.dimension; ++t) {
    const std::int32_t i = block_.place[a][t];
    if (t != side.direction && i != 0 && i != block_.n_nodes[t] - 1) n *= 2;
  }
  return n;
}

}  // namespace diptych::meshes
