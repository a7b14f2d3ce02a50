#include "meshes/dual_measure.hpp"

#include "common/base/error.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace diptych::meshes {

namespace {

std::string place(const Vec3& X) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", X[0], X[1], X[2]);
}

Vec3 centre(const Mesh& mesh, std::int64_t c) {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t a : mesh.cell(c))
    sum += mesh.nodes[a];
  return sum / static_cast<double>(mesh.cell(c).size());
}

/// @return their sum
double add_volumes(const Mesh& mesh, Quadrature quadrature, std::vector<double>& Omega) {
  long double total = 0;  // a million equal terms would cost four digits of a double
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const ReferenceCell& cell = reference_cell(mesh.cell_types[c]);
    const auto nodes = mesh.cell(c);
    double volume = 0;
    for (const QuadraturePoint& point : cell.rule(quadrature)) {
      const double weight = point.weight * jacobian(cell, point, nodes, mesh.nodes).determinant();
      volume += weight;
      for (int a = 0; a < cell.n_nodes; ++a)
        Omega[nodes[a]] += weight * point.N[a];
    }
    total += volume;
    if (!(volume > 0)) {
      throw base::InputError(
          fmt::format("cell {} at {} has volume {:.3g}: it is inverted or degenerate; "
                      "reorder its nodes or repair the mesh",
                      c, place(centre(mesh, c)), volume));
    }
  }
  return static_cast<double>(total);
}

void check_volumes(const Mesh& mesh, const std::vector<double>& Omega) {
  for (size_t a = 0; a < Omega.size(); ++a) {
    if (Omega[a] > 0) continue;
    throw base::InputError(
        fmt::format("node {} at {} has volume share {:.3g}: no cell uses it, or cells around it "
                    "are too distorted; repair the mesh",
                    a, place(mesh.nodes[a]), Omega[a]));
  }
}

/// Part of the volume below which a moment is round-off of its sum.
constexpr double round_off = 1e-12;

/// Shares of the boundary faces in the area of their nodes. The vertex rule is balanced: each share
/// s becomes s + |s| D (X - centre) with the D for which sum X (x) s = V I holds, which the exact
/// rule satisfies by itself. D vanishes on rectangles and on extruded meshes; elsewhere it is of
/// second order in the size of the faces.
class FaceShares {
 public:
  FaceShares(const Mesh& mesh, Quadrature quadrature, double volume)
      : mesh_(mesh), quadrature_(quadrature) {
    if (quadrature == Quadrature::exact) return;
    double weight = 0;
    Vec3 first = Vec3::Zero();
    for_each([&](const Vec3& X, const Vec3& share) {
      weight += share.norm();
      first += share.norm() * (X - mesh.nodes[0]);
    });
    centre_ = mesh.nodes[0] + first / weight;
    using LongMat3 = Eigen::Matrix<long double, 3, 3>;
    LongMat3 second = LongMat3::Zero(), missing = LongMat3::Zero();
    missing.diagonal().head(mesh.dimension).setConstant(volume);
    for_each([&](const Vec3& X, const Vec3& share) {
      const Mat3 spread = share.norm() * (X - centre_) * (X - centre_).transpose();
      const Mat3 moment = (X - centre_) * share.transpose();
      second += spread.cast<long double>();
      missing -= moment.cast<long double>();
    });
    if (missing.norm() <= round_off * volume) return;
    if (mesh.dimension == 2) second(2, 2) = second.trace();
    D_ = (missing.transpose() * second.inverse()).cast<double>();
  }

  std::array<Vec3, 4> of(const BoundaryFace& face) const {
    std::array<Vec3, 4> shares = face_area_shares(face, mesh_.nodes, quadrature_);
    if (quadrature_ == Quadrature::exact) return shares;
    for (int i = 0; i < face.n_nodes; ++i) {
      shares[i] += shares[i].norm() * (D_ * (mesh_.nodes[face.nodes[i]] - centre_));
    }
    return shares;
  }

 private:
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const BoundaryFace& face : mesh_.boundary_faces) {
      const auto shares = face_area_shares(face, mesh_.nodes, quadrature_);
      for (int i = 0; i < face.n_nodes; ++i)
        visit(mesh_.nodes[face.nodes[i]], shares[i]);
    }
  }
  const Mesh& mesh_;
  Quadrature quadrature_;
  Vec3 centre_ = Vec3::Zero();
  Mat3 D_ = Mat3::Zero();
};

void add_group(const Mesh& mesh,
               const BoundaryGroup& group,
               const FaceShares& face_shares,
               std::vector<Vec3>& total,
               std::vector<char>& touched,
               PatchArea& patch) {
  patch.name = group.name;
  patch.faces = corners_of(mesh, group);
  for (std::int32_t f : group.faces) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    const auto shares = face_shares.of(face);
    for (int i = 0; i < face.n_nodes; ++i) {
      const std::int32_t a = face.nodes[i];
      if (!touched[a]) patch.nodes.push_back(a);
      touched[a] = 1;
      total[a] += shares[i];
    }
  }
  std::sort(patch.nodes.begin(), patch.nodes.end());
  for (std::int32_t a : patch.nodes) {
    patch.area.push_back(total[a]);
    total[a].setZero();
    touched[a] = 0;
  }
}

/// The outward faces of closed cells satisfy sum A N = 0 and sum X.A N = d V (exact rule).
void check_closed(const Mesh& mesh, double volume) {
  Vec3 sum = Vec3::Zero();
  double area = 0, moment = 0;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const auto shares = face_area_shares(face, mesh.nodes, Quadrature::exact);
    for (int i = 0; i < face.n_nodes; ++i) {
      sum += shares[i];
      area += shares[i].norm();
      moment += (mesh.nodes[face.nodes[i]] - mesh.nodes[0]).dot(shares[i]);
    }
  }
  const double enclosed = moment / mesh.dimension;
  if (sum.norm() <= 1e-9 * area && std::abs(enclosed - volume) <= 1e-6 * volume) return;
  throw base::InputError(
      fmt::format("the boundary faces do not enclose the cells outwards: their area vectors sum to "
                  "{:.3g} of the area and they enclose {:.9g} where the cells fill {:.9g}; repair "
                  "the mesh",
                  sum.norm() / area, enclosed, volume));
}

/// Solid angle between three edges (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double above = std::abs(a.dot(b.cross(c)));
  const double below = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
  return 2 * std::atan2(above, below);
}

double plane_angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

DualMeasure dual_measure(const Mesh& mesh, Quadrature quadrature) {
  DualMeasure measure;
  const auto n = static_cast<size_t>(mesh.n_nodes());
  measure.Omega.assign(n, 0.0);
  const double volume = add_volumes(mesh, Quadrature::exact, measure.Omega);
  check_closed(mesh, volume);
  if (quadrature == Quadrature::vertex) {
    measure.Omega.assign(n, 0.0);
    const double sum = add_volumes(mesh, Quadrature::vertex, measure.Omega);
    for (double& Omega : measure.Omega)
      Omega *= volume / sum;
  }
  check_volumes(mesh, measure.Omega);
  const FaceShares face_shares(mesh, quadrature, volume);
  measure.boundary_area.assign(n, Vec3::Zero());
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const auto shares = face_shares.of(face);
    for (int i = 0; i < face.n_nodes; ++i)
      measure.boundary_area[face.nodes[i]] += shares[i];
  }
  std::vector<Vec3> total(n, Vec3::Zero());
  std::vector<char> touched(n, 0);
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    add_group(mesh, group, face_shares, total, touched, measure.patches.emplace_back());
  }
  return measure;
}

std::vector<double> filled_angle(const Mesh& mesh) {
  std::vector<double> angle(static_cast<size_t>(mesh.n_nodes()), 0.0);
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const ReferenceCell& cell = reference_cell(mesh.cell_types[c]);
    const auto nodes = mesh.cell(c);
    for (int i = 0; i < cell.n_nodes; ++i) {
      const Vec3& X = mesh.nodes[nodes[i]];
      const auto edge = [&](int k) -> Vec3 { return mesh.nodes[nodes[cell.edges[i][k]]] - X; };
      angle[nodes[i]] += cell.dimension == 3
                             ? solid_angle(edge(0), edge(1), edge(2)) / (4 * std::numbers::pi)
                             : plane_angle(edge(0), edge(1)) / (2 * std::numbers::pi);
    }
  }
  return angle;
}

}  // namespace diptych::meshes
