#pragma once
/// Monomials of a place in one to three directions: those of degree 0 first, then 1 in the order of
/// the directions, then 2 and so on. Test: tests/common/algebra/monomials_test.cpp

#include "common/algebra/vectors.hpp"

#include <array>
#include <vector>

namespace diptych::algebra {

/// Exponents of all monomials. @pre dimension 1 to 3, degree 0 to 3
inline const std::vector<std::array<int, 3>>& exponents(int dimension, int degree) {
  using Table = std::vector<std::array<int, 3>>;
  static const auto tables = [] {
    std::array<std::array<Table, 4>, 4> made;
    for (int d = 1; d <= 3; ++d) {
      for (int n = 0; n <= 3; ++n) {
        for (int total = 0; total <= n; ++total) {
          for (int i = total; i >= 0; --i) {
            for (int j = total - i; j >= 0; --j) {
              const int k = total - i - j;
              if ((d == 3 || k == 0) && (d >= 2 || j == 0)) made[d][n].push_back({i, j, k});
            }
          }
        }
      }
    }
    return made;
  }();
  return tables[dimension][degree];
}

inline int n_monomials(int dimension, int degree) {
  return static_cast<int>(exponents(dimension, degree).size());
}

inline double power(double x, int n) {
  double product = 1;
  for (int i = 0; i < n; ++i)
    product *= x;
  return product;
}

/// @param values  [n_monomials]
inline void fill_monomials(const Vec3& X, int dimension, int degree, double* values) {
  double of[3][4];  // X_i^n
  for (int i = 0; i < 3; ++i) {
    of[i][0] = 1;
    for (int n = 1; n < 4; ++n)
      of[i][n] = of[i][n - 1] * X[i];
  }
  for (const auto& n : exponents(dimension, degree))
    *values++ = of[0][n[0]] * of[1][n[1]] * of[2][n[2]];
}

/// [n_monomials]
inline Eigen::VectorXd monomials(const Vec3& X, int dimension, int degree) {
  Eigen::VectorXd values(n_monomials(dimension, degree));
  fill_monomials(X, dimension, degree, values.data());
  return values;
}

/// [n_monomials][3]
inline Eigen::MatrixXd monomial_gradients(const Vec3& X, int dimension, int degree) {
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(n_monomials(dimension, degree), 3);
  int m = 0;
  for (const auto& n : exponents(dimension, degree)) {
    for (int d = 0; d < dimension; ++d) {
      if (n[d] == 0) continue;
      auto less = n;
      --less[d];
      gradients(m, d) = n[d] * power(X[0], less[0]) * power(X[1], less[1]) * power(X[2], less[2]);
    }
    ++m;
  }
  return gradients;
}

}  // namespace diptych::algebra
