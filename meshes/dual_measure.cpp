#include "meshes/dual_measure.hpp"

#include "common/base/error.hpp"

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

void add_volumes(const Mesh& mesh, Quadrature quadrature, std::vector<double>& Omega) {
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
    if (!(volume > 0)) {
      throw base::InputError(
          fmt::format("cell {} at {} has volume {:.3g}: it is inverted or degenerate; "
                      "reorder its nodes or repair the mesh",
                      c, place(centre(mesh, c)), volume));
    }
  }
  for (size_t a = 0; a < Omega.size(); ++a) {
    if (Omega[a] > 0) continue;
    throw base::InputError(
        fmt::format("node {} at {} has volume share {:.3g}: no cell uses it, or cells around it "
                    "are too distorted; repair the mesh",
                    a, place(mesh.nodes[a]), Omega[a]));
  }
}

void add_group(const Mesh& mesh,
               const BoundaryGroup& group,
               Quadrature quadrature,
               std::vector<Vec3>& total,
               std::vector<char>& touched,
               PatchArea& patch) {
  patch.name = group.name;
  for (std::int32_t f : group.faces) {
    const BoundaryFace& face = mesh.boundary_faces[f];
    const auto shares = face_area_shares(face, mesh.nodes, quadrature);
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

/// The outward faces of closed cells satisfy sum_a A_aN_a = 0 and sum_a X_a.A_aN_a = d V.
void check_closed(const Mesh& mesh, const DualMeasure& measure) {
  Vec3 sum = Vec3::Zero();
  double area = 0, moment = 0, volume = 0;
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    const Vec3& A = measure.boundary_area[a];
    sum += A;
    area += A.norm();
    moment += (mesh.nodes[a] - mesh.nodes[0]).dot(A);
    volume += measure.Omega[a];
  }
  const double error = moment / mesh.dimension - volume;
  if (sum.norm() <= 1e-9 * area && std::abs(error) <= 1e-6 * volume) return;
  throw base::InputError(
      fmt::format("the boundary faces do not enclose the cells outwards: their area vectors sum to "
                  "{:.3g} of the area and they enclose {:.9g} where the cells fill {:.9g}; repair "
                  "the mesh",
                  sum.norm() / area, moment / mesh.dimension, volume));
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
  add_volumes(mesh, quadrature, measure.Omega);
  measure.boundary_area.assign(n, Vec3::Zero());
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const auto shares = face_area_shares(face, mesh.nodes, quadrature);
    for (int i = 0; i < face.n_nodes; ++i)
      measure.boundary_area[face.nodes[i]] += shares[i];
  }
  if (quadrature == Quadrature::exact) check_closed(mesh, measure);
  std::vector<Vec3> total(n, Vec3::Zero());
  std::vector<char> touched(n, 0);
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    add_group(mesh, group, quadrature, total, touched, measure.patches.emplace_back());
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
