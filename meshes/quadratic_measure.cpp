#include "meshes/quadratic_measure.hpp"

#include "common/algebra/monomials.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/for_each.hpp"
#include "meshes/cell_topology.hpp"
#include "meshes/incidence.hpp"
#include "meshes/least_weights.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace diptych::meshes {

namespace {

using algebra::fill_monomials;
using algebra::monomial_gradients;
using algebra::monomials;
using algebra::n_monomials;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Nodes that take part in the volume of a cell, and in the area of a face, if there are as many.
constexpr size_t nodes_of_cell[] = {20, 64};
constexpr size_t nodes_of_face[] = {6, 25};
/// Cells whose weights are kept at a time.
constexpr std::int64_t cells_at_once = 8192;
/// Cosine of the angle between normals of one plane, less one.
constexpr double plane = 1e-10;
/// Part of the largest moment by which moments of volumes and areas may differ.
constexpr double most_difference = 1e-9;

struct Weights {
  std::vector<std::int32_t> nodes;
  Vector value;
};

Weights volume_of(const Mesh& mesh,
                  const NodalGraph& sharing,
                  const std::vector<double>& shares,
                  std::int64_t c) {
  const auto corners = mesh.cell(c);
  const ReferenceCell& cell = reference_cell(mesh.cell_types[c]);
  Vec3 middle = Vec3::Zero();
  for (const std::int32_t a : corners)
    middle += mesh.nodes[a] / static_cast<double>(corners.size());
  double h = 0;
  const auto edges = edges_of(mesh.cell_types[c]);
  for (const LocalEdge& e : edges)
    h += (mesh.nodes[corners[e[1]]] - mesh.nodes[corners[e[0]]]).norm();
  h /= static_cast<double>(edges.size());

  Weights weights;
  weights.nodes = surrounding(corners, nodes_of_cell[mesh.dimension - 2], mesh.nodes.size(),
                              [&](std::int32_t a, const auto& visit) {
                                for (const std::int32_t b : sharing.around(a))
                                  visit(b);
                              });
  weights.value = Vector::Zero(static_cast<int>(weights.nodes.size()));
  std::vector<Vec3> at;
  std::vector<double> share;
  const double unit = std::pow(h, mesh.dimension);
  for (const std::int32_t a : weights.nodes) {
    at.push_back((mesh.nodes[a] - middle) / h);
    share.push_back(shares[a] / unit);
  }
  std::array<int, 8> place{};  // of the corners among the nodes
  for (int i = 0; i < cell.n_nodes; ++i) {
    place[i] =
        static_cast<int>(std::lower_bound(weights.nodes.begin(), weights.nodes.end(), corners[i]) -
                         weights.nodes.begin());
  }
  Vector exact = Vector::Zero(n_monomials(mesh.dimension, 2)), values = exact;
  for (const QuadraturePoint& point : cell.fine) {
    const double dV = point.weight * jacobian(cell, point, corners, mesh.nodes).determinant();
    Vec3 X = Vec3::Zero();
    for (int i = 0; i < cell.n_nodes; ++i) {
      X += point.N[i] * at[place[i]];
      weights.value[place[i]] += point.N[i] * dV;
    }
    fill_monomials(X, mesh.dimension, 2, values.data());
    exact += dV * values;
  }
  meet_moments(at, share, mesh.dimension, 2, exact, weights.value);
  return weights;
}

std::vector<double> volumes_of(const Mesh& mesh,
                               const std::vector<double>& shares,
                               const BlockUse& use) {
  std::vector<double> Omega(static_cast<size_t>(mesh.n_nodes()), 0.0);
  const NodalGraph sharing = nodal_graph(mesh);
  std::vector<Weights> weights(cells_at_once);
  for (std::int64_t begin = 0; begin < mesh.n_cells(); begin += cells_at_once) {
    const std::int64_t n = std::min(mesh.n_cells() - begin, cells_at_once);
    parallel::for_chunks(n, [&](std::int64_t first, std::int64_t end, std::int64_t) {
      for (std::int64_t i = first; i < end; ++i)
        weights[i] = volume_of(mesh, sharing, shares, begin + i);
    });
    for (std::int64_t i = 0; i < n; ++i) {
      for (size_t k = 0; k < weights[i].nodes.size(); ++k)
        Omega[weights[i].nodes[k]] += weights[i].value[static_cast<int>(k)];
    }
  }
  for (size_t a = 0; a < Omega.size(); ++a) {
    if (Omega[a] > 0) continue;
    const Vec3& X = mesh.nodes[a];
    throw base::InputError(fmt::format(
        "{}: node {} at ({:.6g}, {:.6g}, {:.6g}) would have the volume {:.3g} by a rule "
        "that is exact for quadratics: the mesh is too coarse or too uneven there; "
        "refine it, or use {}",
        use.asked, a, X[0], X[1], X[2], Omega[a], use.instead));
  }
  return Omega;
}

/// The faces of the boundary by the plane sides that they make up.
class Sides {
 public:
  explicit Sides(const Mesh& mesh) : mesh_(mesh), around_(mesh.nodes.size()) {
    std::vector<std::vector<std::int32_t>> groups(mesh.boundary_faces.size());
    for (size_t g = 0; g < mesh.boundary_groups.size(); ++g) {
      for (const std::int32_t f : mesh.boundary_groups[g].faces)
        groups[f].push_back(static_cast<std::int32_t>(g));
    }
    side_.resize(groups.size());
    std::iota(side_.begin(), side_.end(), 0);
    std::map<std::array<std::int32_t, 2>, std::int32_t> by_edge;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f) {
      const BoundaryFace& face = mesh.boundary_faces[f];
      const Vec3 area = area_of(face);
      area_.push_back(area.norm());
      normal_.push_back(area.normalized());
      for (int i = 0; i < face.n_nodes; ++i) {
        around_[face.nodes[i]].push_back(f);
        // in the plane faces meet at nodes
        const std::int32_t a = face.nodes[i], b = face.nodes[(i + 1) % face.n_nodes];
        const auto edge =
            mesh.dimension == 3 ? std::array{std::min(a, b), std::max(a, b)} : std::array{a, a};
        const auto [other, is_new] = by_edge.emplace(edge, f);
        if (is_new || groups[other->second] != groups[f]) continue;
        if (normal_[other->second].dot(normal_[f]) > 1 - plane) join(other->second, f);
      }
    }
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f)
      side_[f] = root(f);
  }

  /// Areas of the nodes of its side that face f gives.
  Weights area_of_face(std::int32_t f) const {
    const BoundaryFace& face = mesh_.boundary_faces[f];
    const auto corners = [&](std::int64_t i) {
      const BoundaryFace& other = mesh_.boundary_faces[i];
      return std::span<const std::int32_t>(other.nodes.data(), static_cast<size_t>(other.n_nodes));
    };
    const auto of_side = [&](std::int32_t a) {
      std::vector<std::int32_t> faces = around_[a];
      std::erase_if(faces, [&](std::int32_t i) { return side_[i] != side_[f]; });
      return faces;
    };
    Weights weights;
    weights.nodes = surrounding(corners(f), nodes_of_face[mesh_.dimension - 2], mesh_.nodes.size(),
                                [&](std::int32_t a, const auto& visit) {
                                  for (const std::int32_t i : of_side(a)) {
                                    for (const std::int32_t b : corners(i))
                                      visit(b);
                                  }
                                });
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t a : corners(f))
      middle += mesh_.nodes[a] / face.n_nodes;
    const Vec3 along = mesh_.nodes[face.nodes[1]] - mesh_.nodes[face.nodes[0]];
    const double h = along.norm();
    Mat3 frame = Mat3::Zero();  // rows: directions of the plane of the face
    frame.row(0) = along / h;
    if (mesh_.dimension == 3) frame.row(1) = normal_[f].cross(along / h);
    const auto place_of = [&](const Vec3& X) -> Vec3 { return frame * (X - middle) / h; };
    std::vector<Vec3> at;
    std::vector<double> share;
    for (const std::int32_t a : weights.nodes) {
      at.push_back(place_of(mesh_.nodes[a]));
      share.push_back(0);
      for (const std::int32_t i : of_side(a))
        share.back() += area_[i] / mesh_.boundary_faces[i].n_nodes;
      share.back() /= std::pow(h, mesh_.dimension - 1);
    }
    weights.value = Vector::Zero(static_cast<int>(at.size()));
    const int dimension = mesh_.dimension - 1;
    Vector exact = Vector::Zero(n_monomials(dimension, 3));
    for_points(f, [&](const std::array<double, 4>& N, const Vec3& normal_dA) {
      const double dA = normal_dA.norm();
      Vec3 X = Vec3::Zero();
      for (int i = 0; i < face.n_nodes; ++i) {
        X += N[i] * mesh_.nodes[face.nodes[i]];
        const auto place =
            std::lower_bound(weights.nodes.begin(), weights.nodes.end(), face.nodes[i]);
        weights.value[place - weights.nodes.begin()] += N[i] * dA;
      }
      exact += dA * monomials(place_of(X), dimension, 3);
    });
    meet_moments(at, share, dimension, 3, exact, weights.value);
    return weights;
  }

  const Vec3& normal(std::int32_t f) const { return normal_[f]; }

  /// Calls visit(X, N dA) at the points of a fine rule on all faces.
  template <class Visit>
  void for_all_points(const Visit& visit) const {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(side_.size()); ++f) {
      const BoundaryFace& face = mesh_.boundary_faces[f];
      for_points(f, [&](const std::array<double, 4>& N, const Vec3& normal_dA) {
        Vec3 X = Vec3::Zero();
        for (int i = 0; i < face.n_nodes; ++i)
          X += N[i] * mesh_.nodes[face.nodes[i]];
        visit(X, normal_dA);
      });
    }
  }

 private:
  Vec3 area_of(const BoundaryFace& face) const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& share : face_area_shares(face, mesh_.nodes, Quadrature::exact))
      sum += share;
    return sum;
  }

  /// Calls visit(shape functions, N dA) at the points of a fine rule on a face.
  template <class Visit>
  void for_points(std::int32_t f, const Visit& visit) const {
    const BoundaryFace& face = mesh_.boundary_faces[f];
    if (face.n_nodes == 2) {
      const double g = std::sqrt(0.15);
      const Vec3 length = area_[f] * normal_[f];
      visit({0.5 + g, 0.5 - g, 0, 0}, 5. / 18 * length);
      visit({0.5, 0.5, 0, 0}, 8. / 18 * length);
      visit({0.5 - g, 0.5 + g, 0, 0}, 5. / 18 * length);
      return;
    }
    const auto& rule =
        reference_cell(face.n_nodes == 3 ? CellType::triangle : CellType::quadrilateral);
    for (const QuadraturePoint& point : rule.fine) {
      Vec3 t = Vec3::Zero(), s = Vec3::Zero();
      std::array<double, 4> N{};
      for (int i = 0; i < face.n_nodes; ++i) {
        t += point.dN[i][0] * mesh_.nodes[face.nodes[i]];
        s += point.dN[i][1] * mesh_.nodes[face.nodes[i]];
        N[i] = point.N[i];
      }
      const Vec3 area = point.weight * t.cross(s);
      visit(N, area.dot(normal_[f]) < 0 ? Vec3(-area) : area);
    }
  }

  std::int32_t root(std::int32_t f) const {
    while (side_[f] != f)
      f = side_[f];
    return f;
  }
  void join(std::int32_t f, std::int32_t g) {
    const std::int32_t a = root(f), b = root(g);
    side_[std::max(a, b)] = std::min(a, b);
  }

  const Mesh& mesh_;
  std::vector<std::vector<std::int32_t>> around_;  ///< faces of a node
  std::vector<std::int32_t> side_;                 ///< of a face: the first face of it
  std::vector<Vec3> normal_;
  std::vector<double> area_;
};

void add_areas(const std::vector<Weights>& of_face,
               const Sides& sides,
               std::int32_t f,
               std::vector<Vec3>& area) {
  for (size_t i = 0; i < of_face[f].nodes.size(); ++i)
    area[of_face[f].nodes[i]] += of_face[f].value[static_cast<int>(i)] * sides.normal(f);
}

/// Of sum_a Omega_a d_i X^m = sum_a (A_aN_a)_i X_a^m for all monomials up to degree 3.
class MomentCheck {
 public:
  MomentCheck(const Mesh& mesh, const std::vector<Vec3>& boundary_area) : mesh_(mesh) {
    Vec3 lower = mesh.nodes[0], upper = mesh.nodes[0];
    for (const Vec3& X : mesh.nodes) {
      lower = lower.cwiseMin(X);
      upper = upper.cwiseMax(X);
    }
    middle_ = 0.5 * (lower + upper);
    size_ = 0.5 * (upper - lower).maxCoeff();
    of_areas_ = Matrix::Zero(n_monomials(mesh.dimension, 3), 3);
    Matrix largest = of_areas_;
    for (size_t a = 0; a < mesh.nodes.size(); ++a) {
      if (boundary_area[a].isZero(0)) continue;
      const Vector values = monomials((mesh.nodes[a] - middle_) / size_, mesh.dimension, 3);
      of_areas_ += values * boundary_area[a].transpose();
      largest += (values * boundary_area[a].transpose()).cwiseAbs();
    }
    largest_ = largest.maxCoeff();
  }

  /// @throws base::InputError where volumes at the nodes differ from the areas
  void of_nodes(const std::vector<double>& Omega, const BlockUse& use) const {
    Matrix of_volumes = Matrix::Zero(of_areas_.rows(), 3);
    for (size_t a = 0; a < mesh_.nodes.size(); ++a) {
      const Vec3 X = (mesh_.nodes[a] - middle_) / size_;
      of_volumes += Omega[a] / size_ * monomial_gradients(X, mesh_.dimension, 3);
    }
    judge(of_volumes, use);
  }

  /// The same before volumes are made: theirs are integrals over the body, which are integrals over
  /// its boundary.
  void of_body(const Sides& sides, const BlockUse& use) const {
    Matrix of_boundary = Matrix::Zero(of_areas_.rows(), 3);
    sides.for_all_points([&](const Vec3& X, const Vec3& normal_dA) {
      of_boundary += monomials((X - middle_) / size_, mesh_.dimension, 3) * normal_dA.transpose();
    });
    judge(of_boundary, use);
  }

 private:
  void judge(const Matrix& of_volumes, const BlockUse& use) const {
    const double difference = (of_volumes - of_areas_).cwiseAbs().maxCoeff() / largest_;
    if (difference <= most_difference) return;
    throw base::InputError(fmt::format(
        "{}: operators that sum by parts are for bodies with plane sides of at least four nodes "
        "along each line: on the boundary of this mesh volumes and areas differ by {:.2g} in the "
        "moments of cubics; use {}, or, where sides are plane, refine the mesh",
        use.asked, difference, use.instead));
  }

  const Mesh& mesh_;
  Vec3 middle_ = Vec3::Zero();
  double size_ = 1, largest_ = 0;
  Matrix of_areas_;
};

}  // namespace

DualMeasure quadratic_measure(const Mesh& mesh, const BlockUse& use) {
  DualMeasure measure = dual_measure(mesh, Quadrature::exact);  // and its checks of the mesh
  const Sides sides(mesh);
  std::vector<Weights> of_face(mesh.boundary_faces.size());
  parallel::for_each(static_cast<std::int64_t>(of_face.size()), [&](std::int64_t f) {
    of_face[f] = sides.area_of_face(static_cast<std::int32_t>(f));
  });
  measure.boundary_area.assign(mesh.nodes.size(), Vec3::Zero());
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(of_face.size()); ++f)
    add_areas(of_face, sides, f, measure.boundary_area);
  std::vector<Vec3> total(mesh.nodes.size(), Vec3::Zero());
  for (size_t g = 0; g < measure.patches.size(); ++g) {
    PatchArea& patch = measure.patches[g];
    for (const std::int32_t f : mesh.boundary_groups[g].faces)
      add_areas(of_face, sides, f, total);
    for (size_t i = 0; i < patch.nodes.size(); ++i) {
      patch.area[i] = total[patch.nodes[i]];
      total[patch.nodes[i]].setZero();
    }
  }
  const MomentCheck check(mesh, measure.boundary_area);
  check.of_body(sides, use);
  measure.Omega = volumes_of(mesh, measure.Omega, use);
  check.of_nodes(measure.Omega, use);
  return measure;
}

}  // namespace diptych::meshes
