#pragma once
/// The least weighted change of the C_ab that keeps rows exact for quadratics and changes the
/// adjoint (summation_by_parts.hpp). Multipliers of a node are y_a, of its closure, and Y_a, three
/// of them in space, of its adjoint for linear stresses; with X = X_b - X_a and q(X) the monomials
/// of degrees 1 and 2,
///   t_ab  = 1/2 (y_a - y_b + Y_b X),    dC_ab = k_ab (t_ab - q(X) . rho_a),
///   rho_a = (sum_b k_ab q q^T)^-1 sum_b k_ab q t_ab,
/// and S takes the multipliers to what dC adds to the conditions,
///   1/2 sum_b (dC_ab - dC_ba)  and  -1/2 sum_b X dC_ba.
/// A Field holds y_a and the columns of Y_a h_a one after another, 1 + dimension vectors a node, so
/// that all conditions are areas. Two passes over the pairs, each with one record of a neighbour.
/// Test: tests/graphs/summation_by_parts_test.cpp

#include "common/algebra/field.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/row_moments.hpp"
#include "common/closure/spline_levels.hpp"

#include <memory>
#include <vector>

namespace diptych::closure {

/// Spacing of each node, Omega_a^(1/d).  [m]
std::vector<double> spacings(const scheme::PairGraph& graph);

template <class Correction>
struct QuadraticRows;

template <int D>
class QuadraticCorrection {
 public:
  static constexpr int n_conditions = 1 + D;           ///< of the adjoint of a node
  static constexpr int n_terms = D + D * (D + 1) / 2;  ///< of q
  using Terms = Eigen::Matrix<double, n_terms, 1>;
  using Square = Eigen::Matrix<double, n_terms, n_terms>;
  using Block = Eigen::Matrix<double, n_conditions, n_conditions>;

  /// What the first pass reads of a neighbour: 1/2 y and the columns of 1/2 Y, with X beside the
  /// first of them.
  struct alignas(64) Jump {
    double value[4][4];
  };
  /// What the second does: 1/2 y and rho, with X beside the first of them.
  struct alignas(64) Fit {
    double value[1 + n_terms][4];
  };

  QuadraticCorrection(const scheme::PairGraph& graph, const std::vector<double>& k);

  /// Nodes whose neighbours determine no quadratic, ascending. What follows takes that there is
  /// none.
  const std::vector<std::int32_t>& undetermined() const { return undetermined_; }

  /// Changes every row least to be exact for quadratics.
  void correct_rows(std::vector<Vec3>& C) const;
  /// What the adjoint misses. [n_nodes * n_conditions]
  Field gap(const std::vector<Vec3>& C) const;
  void apply_S(const Field& y, Field& S_y);
  void precondition(const Field& r, Field& z);
  void change(const Field& y, std::vector<Vec3>& C);

  static Terms terms(const Vec3& X);

 private:
  void fit(const Field& y);
  QuadraticRows<QuadraticCorrection> rows() const;
  void set_blocks();
  void set_smooth();
  FittedRow fitted_row(std::int64_t a) const;
  template <class Levels, class Factor>
  void add_moments(const FittedRow& row,
                   std::int64_t a,
                   const Factor& factor,
                   typename Levels::Moments& left,
                   typename Levels::Terms& whole) const;

  const scheme::PairGraph& graph_;
  const std::vector<double>& k_;
  std::vector<double> h_;
  std::vector<double> reach_;    ///< root of the mean square distance in each row, by k  [m]
  std::vector<Square> inverse_;  ///< (sum k q q^T)^-1 with q of X/reach_a
  std::vector<std::int32_t> undetermined_;
  std::vector<Terms> first_moment_;  ///< sum k q
  std::vector<Block> blocks_;        ///< inverse diagonal blocks of S
  algebra::AlignedArray<Jump> jumps_;
  algebra::AlignedArray<Fit> fits_;
  algebra::AlignedArray<algebra::Four> closure_;        ///< what rows give to theirs
  std::unique_ptr<SplineLevels<quartic>> cubics_;       ///< of (s, grad s / 3)
  std::unique_ptr<SplineLevels<quadratic>> gradients_;  ///< of (0, s e_i), each i
  Field of_gradient_, sum_of_gradient_;                 ///< work space  [n_nodes]
};

extern template class QuadraticCorrection<2>;
extern template class QuadraticCorrection<3>;

}  // namespace diptych::closure
