#include "meshes/moment_balance.hpp"

#include "common/algebra/monomials.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::meshes {

namespace {

using algebra::Mat3;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int most_degree = 3;
/// Readiness of a volume to change, over that of an area: the mass is that of the body, which areas
/// are where no curved side can make up for it.
constexpr double volumes_change_less = 0.01;
/// Part of the largest moment that is rounding.
constexpr double rounding = 1e-13;
/// Eigenvalues of the system, over the largest, below which what is missing is left: at first
/// rounding, up to the second while volumes or areas would change by too much.
constexpr double least_eigenvalue = 1e-14, greatest_eigenvalue = 1e-3;

/// Monomials of places from the middle of the body, over half of its size.
class Moments {
 public:
  Moments(const Mesh& mesh, int degree) : dimension_(mesh.dimension), degree_(degree) {
    Vec3 lower = mesh.nodes[0], upper = mesh.nodes[0];
    for (const Vec3& X : mesh.nodes) {
      lower = lower.cwiseMin(X);
      upper = upper.cwiseMax(X);
    }
    middle_ = 0.5 * (lower + upper);
    size_ = 0.5 * (upper - lower).maxCoeff();
  }

  int n() const { return algebra::n_monomials(dimension_, degree_); }
  double size() const { return size_; }
  Vector values(const Vec3& X) const {
    return algebra::monomials((X - middle_) / size_, dimension_, degree_);
  }
  /// [n][3] 1/m
  Matrix gradients(const Vec3& X) const {
    return algebra::monomial_gradients((X - middle_) / size_, dimension_, degree_) / size_;
  }
  Matrix of_volumes(const Mesh& mesh, const std::vector<double>& Omega) const {
    Matrix sum = Matrix::Zero(n(), 3);
    for (size_t a = 0; a < Omega.size(); ++a)
      sum += Omega[a] * gradients(mesh.nodes[a]);
    return sum;
  }

 private:
  int dimension_, degree_;
  Vec3 middle_;
  double size_ = 1;
};

double difference(const Mesh& mesh,
                  const Moments& moments,
                  const Matrix& of_volumes,
                  const std::vector<Vec3>& boundary_area) {
  Matrix of_areas = Matrix::Zero(moments.n(), 3);
  Matrix largest = of_areas;
  for (size_t a = 0; a < boundary_area.size(); ++a) {
    if (boundary_area[a].isZero(0)) continue;
    const Vector values = moments.values(mesh.nodes[a]);
    of_areas += values * boundary_area[a].transpose();
    largest += (values * boundary_area[a].transpose()).cwiseAbs();
  }
  return (of_volumes - of_areas).cwiseAbs().maxCoeff() / largest.maxCoeff();
}

/// NaN where the second is.
double larger(double a, double b) {
  return b <= a ? a : b;
}

/// Faces that are in the same boundary groups.
struct FaceSet {
  std::vector<std::int32_t> faces;
  Vector is_in;  ///< [groups] 1 or 0
};

std::vector<FaceSet> face_sets(const Mesh& mesh) {
  const auto n_groups = std::ssize(mesh.boundary_groups);
  std::vector<std::vector<std::int32_t>> groups_of(mesh.boundary_faces.size());
  for (std::int32_t g = 0; g < n_groups; ++g) {
    for (const std::int32_t f : mesh.boundary_groups[g].faces)
      groups_of[f].push_back(g);
  }
  std::map<std::vector<std::int32_t>, FaceSet> sets;
  for (size_t f = 0; f < groups_of.size(); ++f) {
    FaceSet& set = sets[groups_of[f]];
    if (set.faces.empty()) {
      set.is_in = Vector::Zero(n_groups);
      for (const std::int32_t g : groups_of[f])
        set.is_in[g] = 1;
    }
    set.faces.push_back(static_cast<std::int32_t>(f));
  }
  std::vector<FaceSet> list;
  for (auto& [groups, set] : sets)
    list.push_back(std::move(set));
  return list;
}

/// The system of the multipliers, lambda of function m and direction i at m + i n. Functions are
/// the monomials q of a degree and the boundary groups, whose areas stay: areas change by
/// |A| sum_m q_m lambda_mi, volumes by -Omega r sum_mi d_i q_m lambda_mi.
class Balance {
 public:
  Balance(const Mesh& mesh,
          const Surface& surface,
          int degree,
          const std::vector<Vec3>& group_areas,
          const std::vector<FaceArea>& faces,
          const std::vector<double>& Omega)
      : mesh_(mesh),
        surface_(surface),
        moments_(mesh, degree),
        sets_(face_sets(mesh)),
        readiness_(volumes_change_less * moments_.size()) {
    const int n = n_functions(), d = mesh.dimension;
    Matrix missing = Matrix::Zero(n, 3);
    missing.topRows(moments_.n()) = moments_.of_volumes(mesh, Omega);
    for (size_t g = 0; g < group_areas.size(); ++g)
      missing.row(moments_.n() + static_cast<int>(g)) = group_areas[g].transpose();
    Matrix K = Matrix::Zero(n * d, n * d);
    Matrix of_node = Matrix::Zero(n, d);
    for (size_t a = 0; a < Omega.size(); ++a) {
      of_node.topRows(moments_.n()) = moments_.gradients(mesh.nodes[a]).leftCols(d);
      const Eigen::Map<const Vector> gradients(of_node.data(), K.rows());
      K.selfadjointView<Eigen::Lower>().rankUpdate(gradients, readiness_ * Omega[a]);
    }
    for (const FaceSet& set : sets_) {
      std::vector<Mat3> area(mesh.nodes.size(), Mat3::Zero());  // that may change
      for (const std::int32_t f : set.faces) {
        const Mat3 along = ways(f);
        for (size_t i = 0; i < faces[f].nodes.size(); ++i) {
          const std::int32_t a = faces[f].nodes[i];
          missing -= values(set, a) * faces[f].area[i].transpose();
          area[a] += faces[f].area[i].norm() * along;
        }
      }
      for (size_t a = 0; a < area.size(); ++a) {
        if (area[a].isZero(0)) continue;
        const Vector of_set = values(set, a);
        const Matrix squares = of_set * of_set.transpose();
        for (int i = 0; i < d; ++i) {
          for (int j = 0; j <= i; ++j)
            K.block(i * n, j * n, n, n) += area[a](i, j) * squares;
        }
      }
    }
    K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
    const Matrix right = missing.leftCols(d);
    solver_.compute(K);
    right_ = solver_.eigenvectors().transpose() * Eigen::Map<const Vector>(right.data(), K.rows());
  }

  /// Without what eigenvalues below this part of the largest would take.
  Matrix multipliers(double least) const {
    const Vector& eigenvalues = solver_.eigenvalues();
    Vector parts = Vector::Zero(right_.size());
    for (int k = 0; k < right_.size(); ++k) {
      if (eigenvalues[k] > least * eigenvalues[right_.size() - 1])
        parts[k] = right_[k] / eigenvalues[k];
    }
    const Vector solved = solver_.eigenvectors() * parts;
    return Eigen::Map<const Matrix>(solved.data(), n_functions(), mesh_.dimension);
  }

  /// Changes them.  @return the largest change over what it was
  double change(const Matrix& lambda,
                std::vector<FaceArea>& faces,
                std::vector<double>& Omega) const {
    const int d = mesh_.dimension;
    double largest = 0;
    for (const FaceSet& set : sets_) {
      for (const std::int32_t f : set.faces) {
        const Mat3 along = ways(f);
        for (size_t i = 0; i < faces[f].nodes.size(); ++i) {
          Vec3 change = Vec3::Zero();
          change.head(d) = lambda.transpose() * values(set, faces[f].nodes[i]);
          change = along * change;
          largest = larger(largest, change.norm());
          faces[f].area[i] += faces[f].area[i].norm() * change;
        }
      }
    }
    const Matrix of_monomials = lambda.topRows(moments_.n());
    for (size_t a = 0; a < Omega.size(); ++a) {
      const double change =
          readiness_ *
          moments_.gradients(mesh_.nodes[a]).leftCols(d).cwiseProduct(of_monomials).sum();
      largest = larger(largest, std::abs(change));
      Omega[a] -= Omega[a] * change;
    }
    return largest;
  }

 private:
  int n_functions() const { return moments_.n() + static_cast<int>(mesh_.boundary_groups.size()); }

  Vector values(const FaceSet& set, size_t a) const {
    Vector of_set(n_functions());
    of_set << moments_.values(mesh_.nodes[a]), set.is_in;
    return of_set;
  }

  /// Of a plane side in its direction alone.
  Mat3 ways(std::int32_t f) const {
    if (!surface_.is_of_plane(f)) return Mat3::Identity();
    const Vec3 N = surface_.facet_area(f).normalized();
    return N * N.transpose();
  }

  const Mesh& mesh_;
  const Surface& surface_;
  Moments moments_;
  std::vector<FaceSet> sets_;
  double readiness_;
  Eigen::SelfAdjointEigenSolver<Matrix> solver_;
  Vector right_;
};

/// Of the surface, or of its facets.
std::vector<Vec3> areas_of_groups(const Mesh& mesh, const Surface& surface, Faces kind) {
  std::vector<Vec3> areas;
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t f : group.faces) {
      for (const SurfacePoint& point : surface.points(f, kind == Faces::smooth ? 1 : 0))
        sum += point.area;
    }
    areas.push_back(sum);
  }
  return areas;
}

}  // namespace

double group_difference(const Mesh& mesh,
                        const Surface& surface,
                        Faces kind,
                        const std::vector<FaceArea>& faces) {
  const std::vector<Vec3> exact = areas_of_groups(mesh, surface, kind);
  double largest = 0;
  for (size_t g = 0; g < exact.size(); ++g) {
    Vec3 sum = Vec3::Zero();
    double size = 0;
    for (const std::int32_t f : mesh.boundary_groups[g].faces) {
      for (const Vec3& A : faces[f].area) {
        sum += A;
        size += A.norm();
      }
    }
    largest = larger(largest, (sum - exact[g]).norm() / size);
  }
  return largest;
}

double moment_difference(const Mesh& mesh,
                         const std::vector<double>& Omega,
                         const std::vector<Vec3>& boundary_area) {
  const Moments moments(mesh, most_degree);
  return difference(mesh, moments, moments.of_volumes(mesh, Omega), boundary_area);
}

double moment_difference_of_facets(const Mesh& mesh,
                                   const Surface& surface,
                                   const std::vector<Vec3>& boundary_area) {
  const Moments moments(mesh, most_degree);
  Matrix of_boundary = Matrix::Zero(moments.n(), 3);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.boundary_faces.size()); ++f) {
    for (const SurfacePoint& point : surface.points(f, 0))
      of_boundary += moments.values(point.X) * point.area.transpose();
  }
  return difference(mesh, moments, of_boundary, boundary_area);
}

double balance_moments(const Mesh& mesh,
                       const Surface& surface,
                       Faces kind,
                       double most,
                       std::vector<FaceArea>& faces,
                       std::vector<double>& Omega) {
  const std::vector<Vec3> group_areas = areas_of_groups(mesh, surface, kind);
  double largest = 0;
  // what is cut off of a degree leaves lower ones missing, too, and without linear fields no
  // operator closes
  for (int degree = most_degree; degree > 0; --degree) {
    const Moments moments(mesh, degree);
    if (difference(mesh, moments, moments.of_volumes(mesh, Omega),
                   areas_of_nodes(faces, Omega.size())) <= rounding &&
        group_difference(mesh, surface, kind, faces) <= rounding)
      continue;
    const Balance balance(mesh, surface, degree, group_areas, faces, Omega);
    const std::vector<FaceArea> areas = faces;
    const std::vector<double> volumes = Omega;
    double change = 0;
    for (double least = least_eigenvalue;; least *= 10) {
      change = balance.change(balance.multipliers(least), faces, Omega);
      if (change <= most || least >= greatest_eigenvalue) break;
      faces = areas;
      Omega = volumes;
    }
    largest = larger(largest, change);
  }
  return largest;
}

}  // namespace diptych::meshes
