#include "meshes/side_areas.hpp"

#include "common/algebra/monomials.hpp"
#include "common/parallel/for_each.hpp"
#include "meshes/joined.hpp"
#include "meshes/least_weights.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <span>

namespace diptych::meshes {

namespace {

using algebra::Mat3;
using Vector = Eigen::VectorXd;

/// Nodes that take part in the area of a face, if there are as many.
constexpr size_t nodes_of_face[] = {6, 25};
constexpr int degree = 3;

/// The faces of the boundary by the sides that they make up.
class Sides {
 public:
  Sides(const Mesh& mesh, const Surface& surface, Faces faces)
      : mesh_(mesh),
        surface_(surface),
        faces_(faces),
        around_(mesh.nodes.size()),
        side_(mesh.boundary_faces.size()) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f) {
      area_.push_back(surface.facet_area(f));
      for (const std::int32_t a : corners(f))
        around_[a].push_back(f);
    }
    std::vector<std::vector<std::int32_t>> groups(side_.size());
    for (size_t g = 0; g < mesh.boundary_groups.size(); ++g) {
      for (const std::int32_t f : mesh.boundary_groups[g].faces)
        groups[f].push_back(static_cast<std::int32_t>(g));
    }
    Joined sides(std::ssize(side_));
    surface.for_joints(faces == Faces::plane, [&](std::int32_t f, std::int32_t g) {
      if (groups[f] == groups[g]) sides.join(f, g);
    });
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f)
      side_[f] = sides.of(f);
  }

  FaceArea area_of(std::int32_t f) const {
    FaceArea face;
    face.nodes = surrounding(corners(f), nodes_of_face[mesh_.dimension - 2], mesh_.nodes.size(),
                             [&](std::int32_t a, const auto& visit) {
                               for (const std::int32_t i : around_[a]) {
                                 if (side_[i] != side_[f]) continue;
                                 for (const std::int32_t b : corners(i))
                                   visit(b);
                               }
                             });
    const bool is_curved = faces_ == Faces::smooth && surface_.is_curved(f);
    if (is_curved && !surface_.is_of_plane(f)) {
      for (int i = 0; i < mesh_.dimension; ++i)
        add(f, 1, Vec3::Unit(i), face);
    } else {
      add(f, is_curved ? 1 : 0, area_[f].normalized(), face);
    }
    return face;
  }

 private:
  std::span<const std::int32_t> corners(std::int32_t f) const {
    const BoundaryFace& face = mesh_.boundary_faces[f];
    return {face.nodes.data(), static_cast<size_t>(face.n_nodes)};
  }

  /// The component of the areas along a direction.
  void add(std::int32_t f, double height, const Vec3& direction, FaceArea& face) const {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t a : corners(f))
      middle += mesh_.nodes[a] / static_cast<double>(corners(f).size());
    const Vec3 along = mesh_.nodes[corners(f)[1]] - mesh_.nodes[corners(f)[0]];
    const double h = along.norm();
    Mat3 frame = Mat3::Zero();  // rows: directions of the plane of the facet
    frame.row(0) = along / h;
    if (mesh_.dimension == 3) frame.row(1) = area_[f].normalized().cross(along / h);
    const auto place_of = [&](const Vec3& X) -> Vec3 { return frame * (X - middle) / h; };
    const double unit = std::pow(h, mesh_.dimension - 1);
    std::vector<Vec3> at;
    std::vector<double> share;
    for (const std::int32_t a : face.nodes) {
      at.push_back(place_of(mesh_.nodes[a]));
      share.push_back(0);
      for (const std::int32_t i : around_[a]) {
        if (side_[i] == side_[f])
          share.back() += area_[i].norm() / static_cast<double>(corners(i).size());
      }
      share.back() /= unit;
    }
    Vector value = Vector::Zero(static_cast<int>(at.size()));
    const int dimension = mesh_.dimension - 1;
    Vector exact = Vector::Zero(algebra::n_monomials(dimension, degree));
    for (const SurfacePoint& point : surface_.points(f, height)) {
      const double dA = point.area.dot(direction);
      for (size_t i = 0; i < corners(f).size(); ++i) {
        const auto place = std::lower_bound(face.nodes.begin(), face.nodes.end(), corners(f)[i]);
        value[place - face.nodes.begin()] += point.N[i] * dA;
      }
      exact += dA * algebra::monomials(place_of(point.X), dimension, degree);
    }
    meet_moments(at, share, unit, dimension, degree, exact, value);
    face.area.resize(face.nodes.size(), Vec3::Zero());
    for (size_t i = 0; i < face.area.size(); ++i)
      face.area[i] += value[static_cast<int>(i)] * direction;
  }

  const Mesh& mesh_;
  const Surface& surface_;
  Faces faces_;
  std::vector<std::vector<std::int32_t>> around_;  ///< faces of a node
  std::vector<std::int32_t> side_;                 ///< of a face: one of its faces
  std::vector<Vec3> area_;
};

}  // namespace

std::vector<FaceArea> side_areas(const Mesh& mesh, const Surface& surface, Faces faces) {
  const Sides sides(mesh, surface, faces);
  std::vector<FaceArea> areas(mesh.boundary_faces.size());
  parallel::for_each(static_cast<std::int64_t>(areas.size()), [&](std::int64_t f) {
    areas[f] = sides.area_of(static_cast<std::int32_t>(f));
  });
  return areas;
}

void add_areas(const FaceArea& face, std::vector<Vec3>& area) {
  for (size_t i = 0; i < face.nodes.size(); ++i)
    area[face.nodes[i]] += face.area[i];
}

std::vector<Vec3> areas_of_nodes(const std::vector<FaceArea>& faces, size_t n_nodes) {
  std::vector<Vec3> area(n_nodes, Vec3::Zero());
  for (const FaceArea& face : faces)
    add_areas(face, area);
  return area;
}

}  // namespace diptych::meshes
