#include "common/scheme/boundary/patch_faces.hpp"

#include "common/algebra/face_areas.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "meshes/curved_groups.hpp"
#include "meshes/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace diptych::scheme {

namespace {

/// What a node has of a face.
struct Share {
  size_t face = 0;
  Vec3 area;  ///< m^2
};

/// [nodes of the patch] of the faces around them.
std::vector<std::vector<Share>> shares_of_faces(const PairGraph& graph,
                                                const BoundaryPatch& patch) {
  std::vector<std::vector<Share>> shares(patch.nodes.size());
  const std::vector<PatchFace> faces = faces_of(patch);
  for (size_t f = 0; f < faces.size(); ++f) {
    const PatchFace& face = faces[f];
    std::array<Vec3, 4> corners;
    for (int k = 0; k < face.n_corners; ++k)
      corners[k] = graph.X[patch.nodes[face.corner[k]]];
    const auto areas = algebra::face_area_shares(corners, face.n_corners);
    for (int k = 0; k < face.n_corners; ++k)
      shares[face.corner[k]].push_back({f, areas[k]});
  }
  return shares;
}

/// [faces] the smooth sides that the faces of a patch make up.
std::vector<std::int32_t> sides_of(const PairGraph& graph, const BoundaryPatch& patch) {
  meshes::Mesh mesh;
  mesh.dimension = graph.dimension;
  for (const std::int32_t node : patch.nodes)
    mesh.nodes.push_back(graph.X[node]);
  for (const PatchFace& face : faces_of(patch))
    mesh.boundary_faces.push_back({face.n_corners, face.corner});
  return meshes::smooth_sides(mesh);
}

/// What A_aN_a is made of along the normals of the sides, where these tell it and all are positive;
/// else the part of it that the sizes of the sides are of their sum.
double along_normals(const Vec3& area, const std::vector<Vec3>& of_sides) {
  constexpr double parallel = 1e-6, knife = 1e-6;
  if (of_sides.size() <= 3) {
    Mat3 normals = Mat3::Zero(), cosines = Mat3::Identity();
    for (size_t i = 0; i < of_sides.size(); ++i)
      normals.col(static_cast<int>(i)) = of_sides[i].normalized();
    const auto n = static_cast<int>(of_sides.size());
    cosines.topLeftCorner(n, n) = (normals.transpose() * normals).topLeftCorner(n, n);
    if (cosines.determinant() > parallel) {
      const Vec3 parts = cosines.inverse() * (normals.transpose() * area);
      if (parts.head(n).minCoeff() > 0) return parts.head(n).sum();
    }
  }
  double sizes = 0;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& of_side : of_sides) {
    sizes += of_side.norm();
    sum += of_side;
  }
  return sum.norm() > knife * sizes ? area.norm() * sizes / sum.norm() : sizes;
}

/// @param sides  of faces
double as_number(const Vec3& area,
                 const std::vector<Share>& shares,
                 const std::vector<std::int32_t>& sides) {
  constexpr double rounding = 1e-12, of_facets = 1e-9;
  double sizes = 0;
  Vec3 sum = Vec3::Zero();
  std::map<std::int32_t, Vec3> of_sides;
  for (const Share& share : shares) {
    sizes += share.area.norm();
    sum += share.area;
    of_sides.try_emplace(sides[share.face], Vec3::Zero()).first->second += share.area;
  }
  if (sizes <= (1 + rounding) * sum.norm()) return area.norm();
  if ((area - sum).norm() <= of_facets * sizes) return sizes;
  if (of_sides.size() < 2) return area.norm();
  std::vector<Vec3> areas;
  for (const auto& [side, of_side] : of_sides)
    areas.push_back(of_side);
  return along_normals(area, areas);
}

double cosine(const Vec3& a, const Vec3& b) {
  return a.dot(b) / (a.norm() * b.norm());
}

/// Of the first share that is farthest from all of these, if it is of another plane.
const Share* of_another_plane(const std::vector<Share>& shares, const std::vector<Vec3>& normals) {
  const double edge = std::cos(meshes::edge_of_planes * std::numbers::pi / 180);
  const Share* farthest = nullptr;
  double least = edge;
  for (const Share& share : shares) {
    double nearest = -1;
    for (const Vec3& normal : normals)
      nearest = std::max(nearest, cosine(share.area, normal));
    if (nearest >= least) continue;
    least = nearest;
    farthest = &share;
  }
  return farthest;
}

/// The two that turn most from each other, if they are of two planes, and all others of further
/// ones.
std::vector<Vec3> planes_among(const std::vector<Share>& shares) {
  std::vector<Vec3> planes;
  double least = 1;
  for (const Share& share : shares) {
    const Share* const other = of_another_plane(shares, {share.area});
    if (other == nullptr || cosine(share.area, other->area) >= least) continue;
    least = cosine(share.area, other->area);
    planes = {share.area, other->area};
  }
  while (!planes.empty()) {
    const Share* const next = of_another_plane(shares, planes);
    if (next == nullptr) break;
    planes.push_back(next->area);
  }
  return planes;
}

}  // namespace

std::vector<PatchFace> faces_of(const BoundaryPatch& patch) {
  std::vector<PatchFace> faces;
  for (const auto& nodes : patch.faces) {
    PatchFace& face = faces.emplace_back();
    for (const std::int32_t node : nodes) {
      if (node < 0) continue;
      const auto at = std::lower_bound(patch.nodes.begin(), patch.nodes.end(), node);
      face.corner[face.n_corners++] = static_cast<std::int32_t>(at - patch.nodes.begin());
    }
  }
  return faces;
}

std::vector<double> areas_as_numbers(const PairGraph& graph, const BoundaryPatch& patch) {
  const auto shares = shares_of_faces(graph, patch);
  const std::vector<std::int32_t> sides = sides_of(graph, patch);
  std::vector<double> areas;
  for (size_t k = 0; k < shares.size(); ++k)
    areas.push_back(as_number(patch.area[k], shares[k], sides));
  return areas;
}

std::vector<std::vector<Vec3>> normals_of_planes(const PairGraph& graph,
                                                 const BoundaryPatch& patch) {
  const auto shares = shares_of_faces(graph, patch);
  std::vector<std::vector<Vec3>> normals;
  for (size_t k = 0; k < shares.size(); ++k) {
    const std::vector<Vec3> planes = planes_among(shares[k]);
    std::vector<Vec3> sums(std::max<size_t>(planes.size(), 1), Vec3::Zero());
    for (const Share& share : shares[k]) {
      const auto nearest =
          std::max_element(planes.begin(), planes.end(), [&](const Vec3& a, const Vec3& b) {
            return cosine(share.area, a) < cosine(share.area, b);
          });
      if (nearest != planes.end())
        sums[static_cast<size_t>(nearest - planes.begin())] += share.area;
    }
    if (planes.empty()) sums[0] = patch.area[k];
    std::vector<Vec3>& of_node = normals.emplace_back();
    for (const Vec3& sum : sums)
      of_node.push_back(unit_normal(sum));
  }
  return normals;
}

}  // namespace diptych::scheme
