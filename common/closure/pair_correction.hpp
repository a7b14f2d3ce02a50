#pragma once
/// The least weighted change of the C_ab that closes a graph (closure_repair.hpp):
///   dC_ab = 1/2 k_ab [lambda_b - lambda_a - (grad lambda)_a X_ab]; the gap changes by -S lambda,
///   (S lambda)_a = -1/4 sum_b k_ab [2 (lambda_b - lambda_a) - (grad_a + grad_b) X_ab].
/// Two passes over the pairs, the fit of grad lambda and S. A neighbour is one record of two cache
/// lines, a pair is its weight and the neighbour's index.
/// Test: tests/graphs/closure_repair_test.cpp

#include "common/algebra/field.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/spline_levels.hpp"

namespace diptych::closure {

using algebra::Mat3;
using algebra::Vec3;

/// (sum_b k_ab X_ab (x) X_ab)^-1 of every row; a third direction of its own in 2-D.
std::vector<Mat3> inverse_second_moments(const scheme::PairGraph& graph,
                                         const std::vector<double>& k);

/// sum_b k_ab X_ab
Vec3 first_moment(const scheme::PairGraph& graph, const std::vector<double>& k, std::int64_t a);

class PairCorrection {
 public:
  /// What the passes read of a node: lambda and X[0], then the three columns of grad lambda, the
  /// first two with X[1] and X[2].
  struct alignas(64) Record {
    double value[4][4];
  };

  PairCorrection(const scheme::PairGraph& graph, const std::vector<double>& k);
  void apply_S(const Field& lambda, Field& S_lambda);
  void precondition(const Field& r, Field& z);
  void change(const Field& lambda, std::vector<Vec3>& C);

 private:
  void fit(const Field& lambda);

  const scheme::PairGraph& graph_;
  const std::vector<double>& k_;
  std::vector<Mat3> inverse_;
  std::vector<double> diagonal_;
  algebra::AlignedArray<Record> records_;
  SplineLevels<quadratic> smooth_;
};

}  // namespace diptych::closure
