#pragma once
/// Preconditioner of the closure repair: smooth modes by nested B-spline grids.
///
/// The operator S of repair_closure_pairs measures how far a field is from linear on each row: a
/// fourth-order operator, on which conjugate gradients with a diagonal need of the order of (L/h)^2
/// steps. On smooth fields
///   y.S y ~ sum_a Hess_a : T_a : Hess_a,
///   T_a = 1/4 sum_b k_ab r_ab r_ab^T,  r_ab = monomials of degree 2 less their linear fit,
/// so quadratic B-splines (C^1) on grids of spacing H, 2H, 4H, ... carry the additive
/// preconditioner of Bramble, Pasciak and Xu (1990):
///   z = D^-1 r + sum_levels P D_level^-1 P^T r.
///
/// The operator of quadratic_correction.hpp measures how far a field is from a cubic: multipliers
/// (y, Y h) = (phi, h grad phi / 3) do nothing where phi is one. The same splines, with their
/// gradients, carry its smooth modes; what their energy is beside that of their curvature is
/// measured, level by level, on sums of all splines with random signs.
/// Test: tests/graphs/closure_repair_test.cpp (steps stay bounded when the grid is refined).

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/closure/conjugate_gradients.hpp"
#include "common/closure/spline_sums.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <array>
#include <functional>
#include <vector>

namespace diptych::closure {

class SplineLevels {
 public:
  using Index = SplineIndex;

  /// @param k       [n_pairs] weights of the repair
  /// @param inverse [n_nodes] inverse second moments of the rows, see repair_closure_pairs
  SplineLevels(const scheme::PairGraph& graph,
               const std::vector<double>& k,
               const std::vector<Mat3>& inverse);
  /// For multipliers with gradients: fields hold 1 + dimension vectors a node.
  /// @param h [n_nodes] spacings  [m]
  SplineLevels(const scheme::PairGraph& graph,
               const std::vector<double>& k,
               const std::vector<Mat3>& inverse,
               const std::vector<double>& h);

  /// Makes the energy of each level that of S.
  void scale_to(const FieldOperator& S);

  /// z += sum_levels P D^-1 P^T r
  void add(const std::vector<Vec3>& r, std::vector<Vec3>& z);

 private:
  struct Level {
    Vec3 H = Vec3::Ones();             ///< m, per direction
    Index n{1, 1, 1};                  ///< splines per direction
    std::vector<double> diagonal;      ///< Hess : T : Hess of each spline, 0 where it is left out
    std::vector<double> uncorrected;   ///< the same without the linear fit, to judge round-off
    std::vector<double> mass;          ///< sum_a Omega_a value^2, to judge whether it is felt
    algebra::AlignedArray<Four> grid;  ///< work space: a vector per spline
    std::int64_t size() const { return static_cast<std::int64_t>(n[0]) * n[1] * n[2]; }
  };
  /// The splines that a point feels: three per direction from `first`, values and derivatives.
  struct Splines {
    Index first{};
    double value[3][3]{}, slope[3][3]{}, curvature[3][3]{};
  };

  void set_levels(const scheme::PairGraph& graph);
  void place_nodes(const scheme::PairGraph& graph);
  void visit_layers(
      const std::function<void(const std::int32_t* begin, const std::int32_t* end)>& visit) const;
  Splines splines_at(const Level& level, const Vec3& X) const;
  void add_energy(Level& level,
                  const Splines& s,
                  double Omega,
                  const Eigen::Matrix<double, 6, 6> T[2]) const;
  void leave_out_unfelt(Level& level);
  void prolong(size_t level, std::vector<Vec3>& z);
  /// Calls visit(fine, coarse, weight) for the two-scale relation 1/4 (1 3 3 1) in each direction.
  template <class Visit>
  void for_each_child(const Level& fine, const Level& coarse, const Visit& visit) const;

  int dimension_ = 3;
  int per_direction_z_ = 3;  ///< splines felt in z: one in 2-D
  Vec3 lower_ = Vec3::Zero();
  std::vector<Level> levels_;
  std::vector<NodeSplines> node_splines_;  ///< [n_nodes] on the finest level
  std::vector<NodeSlopes> node_slopes_;    ///< [n_nodes], empty without gradients
  /// Nodes by the layer of the finest grid that they are in; three layers apart they share no
  /// spline.
  std::vector<std::int32_t> by_layer_;
  std::vector<std::int64_t> layer_;  ///< [n_layers + 1] into by_layer_
};

}  // namespace diptych::closure
