#pragma once
/// Moments of what a row leaves of functions when its fit is taken off them, for preconditioners of
/// what is smooth. Test: tests/graphs/summation_by_parts_test.cpp

#include <vector>

namespace diptych::closure {

/// Terms that a row fits, at each of its neighbours.
struct FittedRow {
  const double* k = nullptr;  ///< [n] weights
  std::vector<double> q;      ///< [n][n_terms]
  int n_terms = 0;
  const double* inverse = nullptr;  ///< [n_terms][n_terms] (sum k q q^T)^-1
};

/// sum_b k r r^T, where r are functions m less what the row fits to them.
/// @tparam N     functions, a multiple of four
/// @param m      [n][N] at the neighbours
/// @param left   [N][N] the sum; entries from the diagonal on
/// @param whole  [N] sum_b k m^2
template <int N>
void fitted_moments(const FittedRow& row,
                    const std::vector<double>& m,
                    double* left,
                    double* whole);

}  // namespace diptych::closure
