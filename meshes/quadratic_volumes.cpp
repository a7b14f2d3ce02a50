#include "meshes/quadratic_volumes.hpp"

#include "common/algebra/monomials.hpp"
#include "common/parallel/for_chunks.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/incidence.hpp"
#include "meshes/least_weights.hpp"
#include "meshes/shape_integrals.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

namespace diptych::meshes {

namespace {

using Vector = Eigen::VectorXd;

/// Nodes that take part in the volume of a cell, if there are as many.
constexpr size_t nodes_of_cell[] = {20, 64};
/// Cells whose weights are kept at a time.
constexpr std::int64_t cells_at_once = 8192;
constexpr int degree = 2;
/// Part of its share that a node must keep: corners of boxes with three nodes a line have 0.3.
constexpr double least_part = 0.2;
/// Where a node would keep less, how much less ready to change it becomes, and how often.
constexpr double readiness_left = 0.3;
constexpr int most_times = 8;

struct Weights {
  std::vector<std::int32_t> nodes;
  Vector value;
};

/// The curved faces of each cell that has any.
std::map<std::int64_t, std::vector<std::int32_t>> curved_faces_of_cells(const Mesh& mesh,
                                                                        const Surface& surface) {
  std::map<std::int64_t, std::vector<std::int32_t>> faces;
  const Incidence cells = cells_around_nodes(mesh);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.boundary_faces.size()); ++f) {
    if (!surface.is_curved(f)) continue;
    const BoundaryFace& face = mesh.boundary_faces[f];
    for (const std::int64_t c : cells.cells(face.nodes[0])) {
      const auto corners = mesh.cell(c);
      const auto is_corner = [&](std::int32_t a) {
        return std::find(corners.begin(), corners.end(), a) != corners.end();
      };
      if (std::all_of(face.nodes.begin(), face.nodes.begin() + face.n_nodes, is_corner))
        faces[c].push_back(f);
    }
  }
  return faces;
}

/// Calls visit(N, X, dV) at points of a rule between a face and its facet.
template <class Visit>
void for_points_between(const Surface& surface, std::int32_t f, const Visit& visit) {
  for (const auto& [height, weight] : unit_line) {
    for (const SurfacePoint& point : surface.points(f, height))
      visit(point.N, point.X, weight * point.area.dot(point.bulge));
  }
}

class Volumes {
 public:
  Volumes(const Mesh& mesh, const std::vector<double>& shares, const Surface* surface)
      : mesh_(mesh), readiness_(shares), surface_(surface), sharing_(nodal_graph(mesh)) {
    if (surface != nullptr) curved_ = curved_faces_of_cells(mesh, *surface);
  }

  /// Of all cells.
  std::vector<double> of_nodes() const {
    std::vector<double> Omega(static_cast<size_t>(mesh_.n_nodes()), 0.0);
    std::vector<Weights> weights(cells_at_once);
    for (std::int64_t begin = 0; begin < mesh_.n_cells(); begin += cells_at_once) {
      const std::int64_t n = std::min(mesh_.n_cells() - begin, cells_at_once);
      parallel::for_chunks(n, [&](std::int64_t first, std::int64_t end, std::int64_t) {
        for (std::int64_t i = first; i < end; ++i)
          weights[i] = of_cell(begin + i);
      });
      for (std::int64_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < weights[i].nodes.size(); ++k)
          Omega[weights[i].nodes[k]] += weights[i].value[static_cast<int>(k)];
      }
    }
    return Omega;
  }

  /// Lets other nodes change in place of this one.
  void change_less(size_t a) { readiness_[a] *= readiness_left; }

 private:
  Weights of_cell(std::int64_t c) const {
    const auto corners = mesh_.cell(c);
    const ReferenceCell& cell = reference_cell(mesh_.cell_types[c]);
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t a : corners)
      middle += mesh_.nodes[a] / static_cast<double>(corners.size());
    double h = 0;
    const auto edges = edges_of(mesh_.cell_types[c]);
    for (const LocalEdge& e : edges)
      h += (mesh_.nodes[corners[e[1]]] - mesh_.nodes[corners[e[0]]]).norm();
    h /= static_cast<double>(edges.size());

    Weights weights;
    weights.nodes = surrounding(corners, nodes_of_cell[mesh_.dimension - 2], mesh_.nodes.size(),
                                [&](std::int32_t a, const auto& visit) {
                                  for (const std::int32_t b : sharing_.around(a))
                                    visit(b);
                                });
    weights.value = Vector::Zero(static_cast<int>(weights.nodes.size()));
    std::vector<Vec3> at;
    std::vector<double> share;
    const double unit = std::pow(h, mesh_.dimension);
    for (const std::int32_t a : weights.nodes) {
      at.push_back((mesh_.nodes[a] - middle) / h);
      share.push_back(readiness_[a] / unit);
    }
    const auto place_of = [&](std::int32_t a) {
      return static_cast<int>(std::lower_bound(weights.nodes.begin(), weights.nodes.end(), a) -
                              weights.nodes.begin());
    };
    std::array<int, 8> place{};  // of the corners among the nodes
    for (int i = 0; i < cell.n_nodes; ++i)
      place[i] = place_of(corners[i]);
    Vector exact = Vector::Zero(algebra::n_monomials(mesh_.dimension, degree)), values = exact;
    for (const QuadraturePoint& point : cell.fine) {
      const double dV = point.weight * jacobian(cell, point, corners, mesh_.nodes).determinant();
      Vec3 X = Vec3::Zero();
      for (int i = 0; i < cell.n_nodes; ++i) {
        X += point.N[i] * at[place[i]];
        weights.value[place[i]] += point.N[i] * dV;
      }
      algebra::fill_monomials(X, mesh_.dimension, degree, values.data());
      exact += dV * values;
    }
    const auto curved = curved_.find(c);
    if (curved != curved_.end()) {
      for (const std::int32_t f : curved->second) {
        const BoundaryFace& face = mesh_.boundary_faces[f];
        for_points_between(*surface_, f, [&](const auto& N, const Vec3& X, double dV) {
          for (int i = 0; i < face.n_nodes; ++i)
            weights.value[place_of(face.nodes[i])] += N[i] * dV;
          algebra::fill_monomials((X - middle) / h, mesh_.dimension, degree, values.data());
          exact += dV * values;
        });
      }
    }
    meet_moments(at, share, unit, mesh_.dimension, degree, exact, weights.value);
    return weights;
  }

  const Mesh& mesh_;
  std::vector<double> readiness_;  ///< to change: at first the share of a node
  const Surface* surface_;
  NodalGraph sharing_;
  std::map<std::int64_t, std::vector<std::int32_t>> curved_;
};

}  // namespace

std::vector<double> quadratic_volumes(const Mesh& mesh,
                                      const std::vector<double>& shares,
                                      const Surface* surface) {
  Volumes volumes(mesh, shares, surface);
  for (int times = 0;; ++times) {
    std::vector<double> Omega = volumes.of_nodes();
    bool are_any_small = false;
    for (size_t a = 0; a < Omega.size(); ++a) {
      if (Omega[a] >= least_part * shares[a]) continue;
      are_any_small = true;
      volumes.change_less(a);
    }
    if (!are_any_small || times == most_times) return Omega;
  }
}

}  // namespace diptych::meshes
