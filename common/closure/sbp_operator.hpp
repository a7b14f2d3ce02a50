#pragma once
/// First derivatives on a line of equidistant nodes that sum by parts: D = Q/(H h) with
///   H = diag(H_i) > 0,  Q + Q^T = E = diag(-1, 0, ..., 0, 1),
/// so that u^T H D v + v^T H D u = [u v] exactly. The pair of order p is exact for polynomials up
/// to degree p inside and p/2 in the rows of the two boundary blocks.
///
/// H, the interior weights and the conditions that fix the blocks: Kreiss and Scherer 1974, Strand,
/// J. Comput. Phys. 110 (1994) 47. Order 4 has one solution with rows of this length. Order 6
/// leaves one number free, here Q_45 = 203/288: beside the value at which the error of x^4 in the
/// block, weighted with H, is least (0.70491; 11.3008 there and here), with the norm of
/// H^(-1/2) Q H^(-1/2) at 2.1081 (2.129 where Q_05 is zero, 3.6 at Q_45 = 0.625).
/// Lines of three to seven nodes are too short for the blocks of order 4 and have tables of their
/// own
/// ("order 2" in texts): rows exact for polynomials up to degree two everywhere, weights exact for
/// cubics (Gregory's, of three nodes Simpson's, of four the 3/8 rule; Hicken and Zingg, J. Comput.
/// Appl. Math. 237 (2013) 111, on norms as quadratures), and Q_{i,i+1} the same along the line, so
/// that D_ab of the slopes along lines takes energy from every motion (meshes/line_slopes.hpp).
/// With these weights that leaves no freedom up to six nodes; of seven Q_14 = Q_15 = 0. Trapezoidal
/// weights make a strip of two cells bend half as stiff again as it is.
///
/// What is left of linear reconstructions in D_ab (notes 3.4) is symmetric and positive on order 2
/// alone: on a line, per c/h, the least eigenvalue of its symmetric part is -0.007 with order 4,
/// which the rest of the boundary's damping outweighs, and -0.36 with order 6, where waves grow.
/// With slopes along lines it is -1e-5 and -5e-4. Test: tests/graphs/sbp_operator_test.cpp, in
/// exact fractions.

#include <cstdint>
#include <span>
#include <vector>

namespace diptych::closure {

struct Rational {
  std::int64_t numerator = 0, denominator = 1;
  constexpr double value() const {
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  }
};

/// The tables of one order, in units of the spacing.
struct SbpTable {
  int order = 2;
  std::span<const Rational> H;         ///< of the boundary block; 1 inside
  std::span<const Rational> block;     ///< Q_ij of the block with i < j, row by row
  std::span<const Rational> interior;  ///< Q_{i,i+1}, Q_{i,i+2}, ... wherever not both in a block
  bool is_line = false;                ///< the block is a whole line

  int block_size() const { return static_cast<int>(H.size()); }
  /// Two blocks side by side, or the line.
  int least_nodes() const { return is_line ? block_size() : 2 * block_size(); }
};

/// @param order  2, 4 or 6  @throws base::InputError on another one
const SbpTable& sbp_table(int order);

/// Of a line of n nodes, 3 to 7.
const SbpTable& sbp_line_table(int n);

/// Fourth order inside with Gregory's weights 3/8, 7/6, 23/24, 1, ... on a line of n >= 3 nodes, as
/// SPH has them on lattices. From eight nodes on rows of the block are exact for linear functions
/// only: weights that are exact for quadratics leave sum_i H_i i^2 ((x^2)'_i - 2 i) = 1/4 over the
/// block, whatever Q. Here the errors of (x^2)' are 0.158, -0.045, -0.076 and 0.066 spacings, the
/// least in the mean weighted with H (one-sided differences have 1).
const SbpTable& gregory_table(int n_nodes);

/// The widest pair up to this order that fits on a line of n >= 2 nodes.
const SbpTable& widest_sbp_table(int order, int n_nodes);

/// The same on a ring of n >= 3 nodes.
const SbpTable& widest_closed_table(int order, int n_nodes);

/// The operator on a line of n nodes, with a spacing of one.
class SbpOperator {
 public:
  struct Entry {
    int node = 0;
    double Q = 0;
  };
  /// @pre n_nodes >= table.least_nodes(), the same where the table is of a line
  SbpOperator(const SbpTable& table, int n_nodes);
  /// On a ring of n >= 3 nodes: H = 1, the interior weights of the widest pair up to this order
  /// that does not reach half around; exact for waves up to that order. Q + Q^T = 0.
  static SbpOperator closed(int order, int n_nodes);

  double H(int i) const { return H_[static_cast<size_t>(i)]; }
  /// Q_ij != 0 of row i with j != i, ascending.
  std::span<const Entry> row(int i) const {
    return {
        entries_.data() + first_[static_cast<size_t>(i)],
        static_cast<size_t>(first_[static_cast<size_t>(i) + 1] - first_[static_cast<size_t>(i)])};
  }

 private:
  SbpOperator() = default;

  std::vector<double> H_;
  std::vector<Entry> entries_;
  std::vector<std::int64_t> first_;
};

}  // namespace diptych::closure
