#include "meshes/moment_balance.hpp"

#include "common/algebra/monomials.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace diptych::meshes {

namespace {

using algebra::Mat3;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int degree = 3;
/// Readiness of a volume to change, over that of an area: the mass is that of the body, which areas
/// are where no curved side can make up for it.
constexpr double volumes_change_less = 0.01;
/// Eigenvalues of the system, over the largest, below which what is missing is left: at first
/// rounding, up to the second while volumes or areas would change by too much.
constexpr double least_eigenvalue = 1e-14, greatest_eigenvalue = 1e-3;

/// Monomials of places from the middle of the body, over half of its size.
class Moments {
 public:
  explicit Moments(const Mesh& mesh) : dimension_(mesh.dimension) {
    Vec3 lower = mesh.nodes[0], upper = mesh.nodes[0];
    for (const Vec3& X : mesh.nodes) {
      lower = lower.cwiseMin(X);
      upper = upper.cwiseMax(X);
    }
    middle_ = 0.5 * (lower + upper);
    size_ = 0.5 * (upper - lower).maxCoeff();
  }

  int n() const { return algebra::n_monomials(dimension_, degree); }
  double size() const { return size_; }
  Vector values(const Vec3& X) const {
    return algebra::monomials((X - middle_) / size_, dimension_, degree);
  }
  /// [n][3] 1/m
  Matrix gradients(const Vec3& X) const {
    return algebra::monomial_gradients((X - middle_) / size_, dimension_, degree) / size_;
  }
  Matrix of_volumes(const Mesh& mesh, const std::vector<double>& Omega) const {
    Matrix sum = Matrix::Zero(n(), 3);
    for (size_t a = 0; a < Omega.size(); ++a)
      sum += Omega[a] * gradients(mesh.nodes[a]);
    return sum;
  }

 private:
  int dimension_;
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

/// The system of the multipliers, lambda of monomial m and direction i at m + i n: areas change by
/// |A| sum_m q_m lambda_mi, volumes by -Omega r sum_mi d_i q_m lambda_mi.
class Balance {
 public:
  Balance(const Mesh& mesh,
          const Surface& surface,
          const std::vector<FaceArea>& faces,
          const std::vector<double>& Omega)
      : mesh_(mesh),
        surface_(surface),
        moments_(mesh),
        readiness_(volumes_change_less * moments_.size()) {
    const int n = moments_.n(), d = mesh.dimension;
    Matrix missing = moments_.of_volumes(mesh, Omega);
    Matrix K = Matrix::Zero(n * d, n * d);
    for (size_t a = 0; a < Omega.size(); ++a) {
      const Matrix of_node = moments_.gradients(mesh.nodes[a]).leftCols(d);
      const Eigen::Map<const Vector> gradients(of_node.data(), K.rows());
      K.selfadjointView<Eigen::Lower>().rankUpdate(gradients, readiness_ * Omega[a]);
    }
    std::vector<Mat3> area(mesh.nodes.size(), Mat3::Zero());  // that may change
    for (size_t f = 0; f < faces.size(); ++f) {
      const Mat3 along = ways(f);
      for (size_t i = 0; i < faces[f].nodes.size(); ++i) {
        const std::int32_t a = faces[f].nodes[i];
        missing -= moments_.values(mesh.nodes[a]) * faces[f].area[i].transpose();
        area[a] += faces[f].area[i].norm() * along;
      }
    }
    for (size_t a = 0; a < area.size(); ++a) {
      if (area[a].isZero(0)) continue;
      const Vector values = moments_.values(mesh.nodes[a]);
      const Matrix of_node = values * values.transpose();
      for (int i = 0; i < d; ++i) {
        for (int j = 0; j <= i; ++j)
          K.block(i * n, j * n, n, n) += area[a](i, j) * of_node;
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
    return Eigen::Map<const Matrix>(solved.data(), moments_.n(), mesh_.dimension);
  }

  /// Changes them.  @return the largest change over what it was
  double change(const Matrix& lambda,
                std::vector<FaceArea>& faces,
                std::vector<double>& Omega) const {
    const int d = mesh_.dimension;
    double largest = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
      const Mat3 along = ways(f);
      for (size_t i = 0; i < faces[f].nodes.size(); ++i) {
        Vec3 change = Vec3::Zero();
        change.head(d) = lambda.transpose() * moments_.values(mesh_.nodes[faces[f].nodes[i]]);
        change = along * change;
        largest = larger(largest, change.norm());
        faces[f].area[i] += faces[f].area[i].norm() * change;
      }
    }
    for (size_t a = 0; a < Omega.size(); ++a) {
      const double change =
          readiness_ * moments_.gradients(mesh_.nodes[a]).leftCols(d).cwiseProduct(lambda).sum();
      largest = larger(largest, std::abs(change));
      Omega[a] -= Omega[a] * change;
    }
    return largest;
  }

 private:
  /// Of a plane side in its direction alone.
  Mat3 ways(size_t f) const {
    if (!surface_.is_of_plane(static_cast<std::int32_t>(f))) return Mat3::Identity();
    const Vec3 N = surface_.facet_area(static_cast<std::int32_t>(f)).normalized();
    return N * N.transpose();
  }

  const Mesh& mesh_;
  const Surface& surface_;
  Moments moments_;
  double readiness_;
  Eigen::SelfAdjointEigenSolver<Matrix> solver_;
  Vector right_;
};

}  // namespace

double moment_difference(const Mesh& mesh,
                         const std::vector<double>& Omega,
                         const std::vector<Vec3>& boundary_area) {
  const Moments moments(mesh);
  return difference(mesh, moments, moments.of_volumes(mesh, Omega), boundary_area);
}

double moment_difference_of_facets(const Mesh& mesh,
                                   const Surface& surface,
                                   const std::vector<Vec3>& boundary_area) {
  const Moments moments(mesh);
  Matrix of_boundary = Matrix::Zero(moments.n(), 3);
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.boundary_faces.size()); ++f) {
    for (const SurfacePoint& point : surface.points(f, 0))
      of_boundary += moments.values(point.X) * point.area.transpose();
  }
  return difference(mesh, moments, of_boundary, boundary_area);
}

double balance_moments(const Mesh& mesh,
                       const Surface& surface,
                       double most,
                       std::vector<FaceArea>& faces,
                       std::vector<double>& Omega) {
  const Balance balance(mesh, surface, faces, Omega);
  const std::vector<FaceArea> areas = faces;
  const std::vector<double> volumes = Omega;
  for (double least = least_eigenvalue;; least *= 10) {
    const double largest = balance.change(balance.multipliers(least), faces, Omega);
    if (largest <= most || least >= greatest_eigenvalue) return largest;
    faces = areas;
    Omega = volumes;
  }
}

}  // namespace diptych::meshes
