#include "meshes/least_weights.hpp"

#include "common/algebra/monomials.hpp"

#include <Eigen/Dense>

#include <algorithm>
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

/// Part of its share by which the weight of a node may change: those of good meshes do by less than
/// a tenth. Nodes that stand nearly in three lines tell cubics from quadratics by a little, and
/// would have ten times their area.
constexpr double most_change = 0.5;

/// Part of the moments that is rounding, and how often what is more than that is taken out.
constexpr double rounding = 1e-14;
constexpr int most_rounds = 3;

/// x of least norm with S x = right.  @return whether there is one
/// @pre S symmetric, not negative
bool solve(const Moments& S, const MomentVector& right, MomentVector& x) {
  const Eigen::LLT<Moments> triangle(S);
  if (triangle.info() == Eigen::Success && triangle.rcond() > least_condition) {
    x = triangle.solve(right);
    return true;
  }
  const Matrix some = S;
  const Vector wanted = right;
  x = some.completeOrthogonalDecomposition().solve(wanted);
  return (S * x - right).norm() <= least_residual * right.norm();
}

}  // namespace

void meet_moments(const std::vector<Vec3>& at,
                  const std::vector<double>& share,
                  double unit,
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
  MomentVector factor;
  for (;; --degree) {
    const int n = algebra::n_monomials(dimension, degree);
    const bool is_met = solve(S.topLeftCorner(n, n), missing.head(n), factor);
    double largest = 0;
    for (int i = 0; i < P.cols(); ++i)
      largest = std::max(largest, std::abs(change[i] * P.col(i).head(n).dot(factor)) / share[i]);
    if ((is_met && largest <= most_change * unit) || degree == 0) break;
  }
  const auto n = static_cast<int>(factor.size());
  const Matrix square = S.topLeftCorner(n, n);
  for (int round = 0;; ++round) {  // what the solution of nearly singular moments leaves
    w += change.cwiseProduct(P.topRows(n).transpose() * factor);
    missing = exact.head(n) - P.topRows(n) * w;
    if (missing.norm() <= rounding * exact.norm() || round == most_rounds) break;
    solve(square, missing, factor);
  }
}

}  // namespace diptych::meshes
