#pragma once
/// Preconditioner of the closure repair: smooth modes by nested B-spline grids.
///
/// The operator S of repair_closure_pairs measures how far a field is from linear on each row: a
/// fourth-order operator, on which conjugate gradients with a diagonal need of the order of (L/h)^2
/// steps. That of quadratic_correction.hpp measures how far a field is from a cubic, multipliers
/// (y, Y h) = (phi, h grad phi / 3) do nothing where phi is one: an eighth-order operator. On
/// smooth fields, with m = 2 or 4 and D^m the derivatives of order m,
///   y.S y ~ sum_a D^m_a : T_a : D^m_a,
///   T_a = c sum_b k_ab r_ab r_ab^T,  r_ab = monomials of degree m less what their row fits to
///   them,
/// so that B-splines of degree m, which are C^(m-1), on grids of spacing H, 2H, 4H, ... (the last
/// one of three cells becomes one) carry the additive preconditioner of Bramble, Pasciak and Xu
/// (1990):
///   z = D^-1 r + sum_levels P D_level^-1 P^T r.
/// Splines of a lower degree have jumps in D^m, which cost S far more than what is smooth.
///
/// For the second the same splines come with their gradients; what their energy is beside that of
/// their derivatives is measured, level by level, on sums of all splines with random signs.
/// Test: tests/graphs/closure_repair_test.cpp, tests/graphs/summation_by_parts_test.cpp (steps stay
/// bounded when the grid is refined).

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/spline_sums.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <array>
#include <functional>
#include <vector>

namespace diptych::closure {

/// @tparam P  quadratic, of fields of one vector a node; quartic, of multipliers with gradients, of
///            1 + dimension vectors a node
template <int P>
class SplineLevels {
 public:
  using Index = SplineIndex;
  static constexpr int n_terms = (P + 1) * (P + 2) / 2;  ///< derivatives of order P in space
  using Terms = Eigen::Matrix<double, n_terms, 1>;
  using Moments = Eigen::Matrix<double, n_terms, n_terms>;
  /// Adds T_a, and the diagonal of the same of the monomials as they are.
  using RowMoments = std::function<void(std::int64_t a, Moments& left, Terms& whole)>;

  SplineLevels(const scheme::PairGraph& graph, const RowMoments& moments);

  /// X^alpha / alpha!, what the derivative alpha of order P is multiplied with in Taylor's series.
  static Terms monomials(const Vec3& X);

  /// With their gradients.  @param h [n_nodes] spacings  [m]
  void set_slopes(const scheme::PairGraph& graph, const std::vector<double>& h);

  /// Makes the energy of each level that of S.
  void scale_to(const FieldOperator& S);

  /// z += sum_levels P D^-1 P^T r
  void add(const std::vector<Vec3>& r, std::vector<Vec3>& z);

 private:
  struct Level {
    Vec3 H = Vec3::Ones();             ///< m, per direction
    Index n{1, 1, 1};                  ///< splines per direction
    std::vector<double> diagonal;      ///< D^P : T : D^P of each spline, 0 where it is left out
    std::vector<double> uncorrected;   ///< about the same without any fit, to judge round-off
    std::vector<double> mass;          ///< sum_a Omega_a value^2, to judge whether it is felt
    algebra::AlignedArray<Four> grid;  ///< work space: a vector per spline
    std::int64_t size() const { return static_cast<std::int64_t>(n[0]) * n[1] * n[2]; }
  };
  /// The splines that a point feels: P + 1 per direction from `first`; derivatives of order 0 to P.
  struct Splines {
    Index first{};
    double value[P + 1][3][P + 1]{};
  };

  void set_levels(const scheme::PairGraph& graph);
  void place_nodes(const scheme::PairGraph& graph);
  void visit_layers(
      const std::function<void(const std::int32_t* begin, const std::int32_t* end)>& visit) const;
  Splines splines_at(const Level& level, const Vec3& X) const;
  void add_energy(
      Level& level, const Splines& s, double Omega, const Moments& left, const Terms& whole) const;
  void leave_out_unfelt(Level& level);
  void prolong(size_t level, std::vector<Vec3>& z);
  Refinements between(const Level& fine, const Level& coarse) const;
  void restrict_to(Level& coarse, const Level& fine) const;
  void refine_to(Level& fine, const Level& coarse) const;

  int dimension_ = 3;
  int n_z_ = P + 1;  ///< splines felt in z: one in 2-D
  Vec3 lower_ = Vec3::Zero();
  std::vector<Level> levels_;
  std::vector<NodeSplines<P>> node_splines_;  ///< [n_nodes] on the finest level
  std::vector<NodeSlopes<P>> node_slopes_;    ///< [n_nodes], empty without gradients
  /// Nodes by the layer of the finest grid that they are in; P + 1 layers apart they share no
  /// spline.
  std::vector<std::int32_t> by_layer_;
  std::vector<std::int64_t> layer_;  ///< [n_layers + 1] into by_layer_
};

extern template class SplineLevels<quadratic>;
extern template class SplineLevels<quartic>;

}  // namespace diptych::closure
