#pragma once
/// Random deformations, symmetric positive definite tensors, rotations and directions for the tests
/// of physics, from one seed, the same on every machine (no distribution of the standard library,
/// whose sequences are not prescribed).

#include "common/algebra/tensor.hpp"

#include <cmath>
#include <cstdint>
#include <random>

namespace diptych::tests {

using algebra::Mat3;
using algebra::SymmetricTensor;
using algebra::Tensor;
using algebra::Vec3;
using algebra::Vector;

class RandomStates {
 public:
  explicit RandomStates(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  /// Log-uniform in [1/ratio, ratio].
  double factor(double ratio) { return std::exp(uniform(-1, 1) * std::log(ratio)); }

  Vec3 unit_vector() {
    for (;;) {
      const Vec3 a(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (a.norm() > 0.1 && a.norm() < 1) return a.normalized();
    }
  }
  Vector<double> direction() { return algebra::to_vector(unit_vector()); }

  Mat3 rotation() {
    const Vec3 axis = unit_vector();
    return Eigen::AngleAxisd(uniform(0, 2 * M_PI), axis).toRotationMatrix();
  }

  /// F = R1 diag(stretches) R2 with stretches in [1/stretch, stretch], hence det F > 0.
  Tensor<double> deformation_gradient(double stretch) {
    const Mat3 R1 = rotation(), R2 = rotation();
    const Vec3 stretches(factor(stretch), factor(stretch), factor(stretch));
    return algebra::to_tensor(R1 * stretches.asDiagonal() * R2);
  }

  /// Symmetric positive definite with eigenvalues in [1/spread, spread].
  SymmetricTensor<double> positive_definite(double spread) {
    const Mat3 R = rotation();
    const Vec3 eigenvalues(factor(spread), factor(spread), factor(spread));
    const Mat3 A = R * eigenvalues.asDiagonal() * R.transpose();
    return algebra::to_symmetric(0.5 * (A + A.transpose()));
  }

  Tensor<double> tensor() {
    Tensor<double> A;
    for (int k = 0; k < 9; ++k)
      A(k / 3, k % 3) = uniform(-1, 1);
    return A;
  }

 private:
  std::mt19937_64 engine_;
};

/// Largest component of a - b.
inline double distance(const Mat3& a, const Mat3& b) {
  return (a - b).cwiseAbs().maxCoeff();
}
template <class A>
double distance(const A& a, const A& b) {
  return distance(algebra::to_eigen(a), algebra::to_eigen(b));
}

/// Eigenvalues of a symmetric tensor, ascending (Eigen's iterative solver).
inline Vec3 eigenvalues(const Mat3& A) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(A, Eigen::EigenvaluesOnly).eigenvalues();
}
inline Vec3 eigenvalues(const SymmetricTensor<double>& A) {
  return eigenvalues(algebra::to_eigen(A));
}

/// Fourth-order central difference of f at 0.
template <class Function>
double difference(Function f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

}  // namespace diptych::tests
