#include "meshes/surface.hpp"

#include "meshes/joined.hpp"
#include "meshes/least_weights.hpp"
#include "meshes/shape_integrals.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace diptych::meshes {

namespace {

/// Faces that turn by more do not stand for a smooth side.
constexpr double most_turn = std::numbers::pi / 3;
/// Kinks turn by so much more than the sides beside them.
constexpr double stands_out = 3;
/// Cosine of the angle between normals of one plane, less one.
constexpr double plane = 1e-10;
/// Turn of faces of a plane side, and bulge over the length of a straight edge.
constexpr double rounding = 1e-6;
/// Nodes from which the normal of a side is found, if there are as many.
constexpr size_t nodes_of_normal = 7;

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Derivative at a along the way from `before` over a to b, times the length of the edge from a to
/// b: of the parabola through the three.
Vec3 tangent(const Vec3& before, const Vec3& a, const Vec3& b) {
  const Vec3 first = a - before, second = b - a;
  const double d = first.norm(), e = second.norm();
  return (e * e / d * first + d * second) / (d + e);
}

}  // namespace

std::vector<std::int32_t> smooth_sides(const Mesh& mesh) {
  return Surface(mesh, Surface::Bent::no).side_;
}

Surface::Surface(const Mesh& mesh) : Surface(mesh, Bent::yes) {}

Surface::Surface(const Mesh& mesh, Bent bent)
    : mesh_(mesh),
      around_(mesh.nodes.size()),
      bulge_(mesh.boundary_faces.size(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}),
      is_curved_(mesh.boundary_faces.size(), 0) {
  for (size_t f = 0; f < mesh.boundary_faces.size(); ++f) {
    Vec3 area = Vec3::Zero();
    for (const Vec3& share :
         face_area_shares(mesh.boundary_faces[f], mesh.nodes, Quadrature::exact))
      area += share;
    area_.push_back(area);
    normal_.push_back(area.normalized());
    for (const std::int32_t a : corners(static_cast<std::int32_t>(f)))
      around_[a].push_back(static_cast<std::int32_t>(f));
  }
  find_joints();
  find_kinks();
  join_sides();
  if (bent == Bent::no) return;
  if (mesh.dimension == 2) {
    bend_in_the_plane();
  } else {
    bend_kinks();
    bend_sides();
  }
}

bool Surface::has_curved_faces() const {
  return std::any_of(is_curved_.begin(), is_curved_.end(), [](auto is) { return is != 0; });
}

void Surface::find_joints() {
  std::map<std::array<std::int32_t, 2>, size_t> by_nodes;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(normal_.size()); ++f) {
    const auto nodes = corners(f);
    for (size_t i = 0; i < nodes.size(); ++i) {
      std::array<std::int32_t, 2> key{nodes[i], -1};
      if (mesh_.dimension == 3) {
        const std::int32_t next = nodes[(i + 1) % nodes.size()];
        key = {std::min(nodes[i], next), std::max(nodes[i], next)};
      }
      const auto [at, is_new] = by_nodes.emplace(key, joints_.size());
      if (is_new) joints_.push_back({key});
      Joint& joint = joints_[at->second];
      if (joint.n_faces < 2) {
        joint.face[joint.n_faces] = f;
        joint.edge[joint.n_faces] = static_cast<std::int8_t>(i);
      }
      ++joint.n_faces;
    }
  }
}

double Surface::turn(std::int32_t f, std::int32_t g) const {
  return angle_between(normal_[f], normal_[g]);
}

/// Of face f against those around its nodes that are not of the joint, beyond kinks not counted.
double Surface::largest_turn(std::int32_t f, const Joint& without) const {
  double largest = 0;
  for (const std::int32_t a : corners(f)) {
    if (a == without.nodes[0] || a == without.nodes[1]) continue;
    for (const std::int32_t g : around_[a]) {
      const double by = turn(f, g);
      if (by < most_turn) largest = std::max(largest, by);
    }
  }
  return largest;
}

void Surface::find_kinks() {
  for (Joint& joint : joints_) {
    if (joint.n_faces != 2) {
      joint.is_kink = true;
      continue;
    }
    const auto [f, g] = joint.face;
    const double by = turn(f, g);
    joint.is_plane = normal_[f].dot(normal_[g]) > 1 - plane;
    joint.is_kink =
        by > most_turn ||
        by > stands_out * std::max(largest_turn(f, joint), largest_turn(g, joint)) + rounding;
  }
}

void Surface::join_sides() {
  Joined sides(static_cast<std::int64_t>(normal_.size()));
  for_joints(false, [&](std::int32_t f, std::int32_t g) { sides.join(f, g); });
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(normal_.size()); ++f)
    side_.push_back(sides.of(f));
  is_plane_.assign(normal_.size(), 1);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f) {
    if (turn(f, side_[f]) > rounding) is_plane_[side_[f]] = 0;
  }
  for (size_t f = 0; f < side_.size(); ++f)
    is_plane_[f] = is_plane_[side_[f]];
}

void Surface::set_bulge(const Joint& joint, const Vec3& bulge) {
  const double length = (mesh_.nodes[joint.nodes[1]] - mesh_.nodes[joint.nodes[0]]).norm();
  if (bulge.norm() <= rounding * length) return;
  for (int i = 0; i < joint.n_faces && i < 2; ++i) {
    bulge_[joint.face[i]][joint.edge[i]] = bulge;
    is_curved_[joint.face[i]] = 1;
  }
}

/// Edges are faces there, and their curves go on where two meet without a kink.
void Surface::bend_in_the_plane() {
  std::vector<const Joint*> at(mesh_.nodes.size(), nullptr);
  for (const Joint& joint : joints_)
    at[joint.nodes[0]] = &joint;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(normal_.size()); ++f) {
    const auto nodes = corners(f);
    const std::array<Vec3, 2> ends{mesh_.nodes[nodes[0]], mesh_.nodes[nodes[1]]};
    Vec3 bulge = Vec3::Zero();
    int known = 0;
    for (int i = 0; i < 2; ++i) {
      const Joint& joint = *at[nodes[i]];
      if (joint.is_kink) continue;
      const auto other = corners(joint.face[joint.face[0] == f ? 1 : 0]);
      const Vec3& before = mesh_.nodes[other[other[0] == nodes[i] ? 1 : 0]];
      bulge += tangent(before, ends[i], ends[1 - i]) - (ends[1 - i] - ends[i]);
      ++known;
    }
    if (known == 0) continue;
    bulge /= 4 * known;
    if (bulge.norm() <= rounding * (ends[1] - ends[0]).norm()) continue;
    bulge_[f][0] = bulge;
    is_curved_[f] = 1;
  }
}

/// Along kinks beside a curved side.
void Surface::bend_kinks() {
  std::vector<std::vector<const Joint*>> at(mesh_.nodes.size());
  for (const Joint& joint : joints_) {
    if (!joint.is_kink) continue;
    for (const std::int32_t a : joint.nodes)
      at[a].push_back(&joint);
  }
  for (const Joint& joint : joints_) {
    if (!joint.is_kink || joint.n_faces != 2) continue;
    if (is_plane_[joint.face[0]] != 0 && is_plane_[joint.face[1]] != 0) continue;
    Vec3 bulge = Vec3::Zero();
    int known = 0;
    for (int i = 0; i < 2; ++i) {
      const std::int32_t a = joint.nodes[i], b = joint.nodes[1 - i];
      if (at[a].size() != 2) continue;
      const Joint& other = *at[a][at[a][0] == &joint ? 1 : 0];
      const std::int32_t before = other.nodes[other.nodes[0] == a ? 1 : 0];
      const Vec3 edge = mesh_.nodes[b] - mesh_.nodes[a];
      if (angle_between(mesh_.nodes[a] - mesh_.nodes[before], edge) > most_turn) continue;
      bulge += tangent(mesh_.nodes[before], mesh_.nodes[a], mesh_.nodes[b]) - edge;
      ++known;
    }
    if (known > 0) set_bulge(joint, bulge / (4 * known));
  }
}

void Surface::bend_sides() {
  std::map<std::array<std::int32_t, 2>, Vec3> normal_of;  // of a node and a side
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(normal_.size()); ++f) {
    if (is_plane_[f] != 0) continue;
    for (const std::int32_t a : corners(f)) {
      const auto [at, is_new] = normal_of.emplace(std::array{a, side_[f]}, Vec3::Zero());
      if (is_new) at->second = normal_at(a, side_[f]);
    }
  }
  for (const Joint& joint : joints_) {
    if (joint.is_kink || is_plane_[joint.face[0]] != 0) continue;
    const Vec3 edge = mesh_.nodes[joint.nodes[1]] - mesh_.nodes[joint.nodes[0]];
    Vec3 bulge = Vec3::Zero();
    for (int i = 0; i < 2; ++i) {
      const Vec3& N = normal_of.at({joint.nodes[i], side_[joint.face[0]]});
      bulge += (i == 0 ? -1 : 1) * edge.dot(N) * N / 8;
    }
    set_bulge(joint, bulge);
  }
}

/// Of the quadratic surface through node a that passes the nodes of its side around it best.
Vec3 Surface::normal_at(std::int32_t a, std::int32_t side) const {
  Vec3 mean = Vec3::Zero();
  for (const std::int32_t f : around_[a]) {
    if (side_[f] == side) mean += normal_[f];
  }
  mean.normalize();
  Eigen::Index least = 0;
  mean.cwiseAbs().minCoeff(&least);
  const Vec3 along = mean.cross(Vec3::Unit(least)).normalized(), across = mean.cross(along);
  const std::vector<std::int32_t> nodes =
      surrounding(std::span(&a, 1), nodes_of_normal, mesh_.nodes.size(),
                  [&](std::int32_t b, const auto& visit) {
                    for (const std::int32_t f : around_[b]) {
                      if (side_[f] != side) continue;
                      for (const std::int32_t c : corners(f))
                        visit(c);
                    }
                  });
  double h = 0;
  for (const std::int32_t b : nodes)
    h += (mesh_.nodes[b] - mesh_.nodes[a]).norm() / static_cast<double>(nodes.size() - 1);
  Eigen::MatrixXd Q(static_cast<int>(nodes.size()), 5);
  Eigen::VectorXd z(Q.rows());
  for (int i = 0; i < Q.rows(); ++i) {
    const Vec3 X = (mesh_.nodes[nodes[i]] - mesh_.nodes[a]) / h;
    const double x = X.dot(along), y = X.dot(across);
    Q.row(i) << x, y, x * x, x * y, y * y;
    z[i] = X.dot(mean);
  }
  const Eigen::VectorXd fit = Q.completeOrthogonalDecomposition().solve(z);
  return (mean - fit[0] * along - fit[1] * across).normalized();
}

std::vector<SurfacePoint> Surface::points(std::int32_t f, double height) const {
  const auto nodes = corners(f);
  const auto& bulge = bulge_[f];
  std::vector<SurfacePoint> points;
  if (nodes.size() == 2) {
    const Vec3 edge = mesh_.nodes[nodes[1]] - mesh_.nodes[nodes[0]];
    for (const auto& [s, weight] : unit_line) {
      SurfacePoint point;
      point.N = {1 - s, s, 0, 0};
      point.bulge = 4 * s * (1 - s) * bulge[0];
      point.X = mesh_.nodes[nodes[0]] + s * edge + height * point.bulge;
      const Vec3 t = edge + height * 4 * (1 - 2 * s) * bulge[0];
      point.area = weight * Vec3(t[1], -t[0], 0);
      points.push_back(point);
    }
  } else {
    const bool is_triangle = nodes.size() == 3;
    const auto& cell = reference_cell(is_triangle ? CellType::triangle : CellType::quadrilateral);
    for (const QuadraturePoint& at : cell.fine) {
      SurfacePoint point;
      Vec3 t = Vec3::Zero(), s = Vec3::Zero();
      const auto n = static_cast<int>(nodes.size());
      for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        point.N[i] = at.N[i];
        point.X += at.N[i] * mesh_.nodes[nodes[i]];
        t += at.dN[i][0] * mesh_.nodes[nodes[i]];
        s += at.dN[i][1] * mesh_.nodes[nodes[i]];
        // 4 N_i N_j, over N_i + N_j where that is not one along the edge alone
        const double product = 4 * at.N[i] * at.N[j];
        const double sum = is_triangle ? 1 : at.N[i] + at.N[j];
        point.bulge += product / sum * bulge[i];
        const auto slope = [&](int d) {
          const double of_product = 4 * (at.dN[i][d] * at.N[j] + at.N[i] * at.dN[j][d]);
          const double of_sum = is_triangle ? 0 : at.dN[i][d] + at.dN[j][d];
          return (of_product - product / sum * of_sum) / sum;
        };
        t += height * slope(0) * bulge[i];
        s += height * slope(1) * bulge[i];
      }
      point.X += height * point.bulge;
      point.area = at.weight * t.cross(s);
      points.push_back(point);
    }
  }
  double outward = 0;
  for (const SurfacePoint& point : points)
    outward += point.area.dot(normal_[f]);
  if (outward < 0) {
    for (SurfacePoint& point : points)
      point.area = -point.area;
  }
  return points;
}

}  // namespace diptych::meshes
