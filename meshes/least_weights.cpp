#include "meshes/least_weights.hpp"

#include "common/algebra/monomials.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace diptych::meshes {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double decay = 0.3;  ///< of the weight of a change with the square of the distance
/// Moments of polynomials of degree 3 at most: matrices on the stack.
constexpr int most_monomials = 20;
using Moments =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_monomials, most_monomials>;
using MomentVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_monomials, 1>;
/// Reciprocal condition number from which these moments tell the polynomials apart.
constexpr double least_condition = 1e-10;

/// Part of the right side that a solution may leave.
constexpr double least_residual = 1e-9;

/// x of least norm with S x = right; where there is none, that of the polynomials of the highest
/// degree that have one, and zero for the others: few nodes keep the volume or the area, and its
/// middle. @pre S symmetric, not negative
MomentVector solution(const Moments& S, const MomentVector& right, int dimension, int degree) {
  const Eigen::LLT<Moments> triangle(S);
  if (triangle.info() == Eigen::Success && triangle.rcond() > least_condition)
    return triangle.solve(right);
  MomentVector x = MomentVector::Zero(right.size());
  for (; degree >= 0; --degree) {
    const int n = algebra::n_monomials(dimension, degree);
    const Vector wanted = right.head(n);
    const Matrix some = S.topLeftCorner(n, n);
    const Vector found = some.completeOrthogonalDecomposition().solve(wanted);
    if ((some * found - wanted).norm() > least_residual * wanted.norm() && degree > 0) continue;
    x.head(n) = found;
    break;
  }
  return x;
}

}  // namespace

void meet_moments(const std::vector<Vec3>& at,
                  const std::vector<double>& share,
                  int dimension,
                  int degree,
                  const Vector& exact,
                  Vector& w) {
  const auto m = static_cast<int>(exact.size());
  thread_local Matrix P;  // which keeps its memory
  P.resize(m, static_cast<int>(at.size()));
  Vector change(static_cast<int>(at.size()));
  Moments S = Moments::Zero(m, m);
  MomentVector missing = exact;
  for (int i = 0; i < P.cols(); ++i) {
    double* const values = P.col(i).data();
    algebra::fill_monomials(at[i], dimension, degree, values);
    change[i] = share[i] * std::exp(-decay * at[i].squaredNorm());
    for (int l = 0; l < m; ++l) {
      missing[l] -= w[i] * values[l];
      const double scaled = change[i] * values[l];
      for (int k = l; k < m; ++k)
        S(k, l) += scaled * values[k];
    }
  }
  S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
  const MomentVector factor = solution(S, missing, dimension, degree);
  for (int i = 0; i < P.cols(); ++i)
    w[i] += change[i] * P.col(i).dot(factor);
}

}  // namespace diptych::meshes
