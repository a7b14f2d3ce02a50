#pragma once
/// What holds displacements that nodal F does not see (zero-energy modes): along the edges of the
/// mesh the part of a displacement that is not the mean of what both ends expect,
///   e_ab = x_b - x_a - 1/2 (F_a + F_b) X_ab,
/// is stiff, E = s/2 sum_edges k_ab |e_ab|^2, k_ab = (Omega_a/n_a + Omega_b/n_b)/|X_ab|^2, with n_a
/// edges at a. It is zero in quadratic motions where F is exact for them, and its energy of fourth
/// order elsewhere (notes 3.12; the penalty is of Ganzenmueller 2015, there with linear rows). F is
/// a sum over pairs, so its forces are those of the edges, s k_ab e_ab on a, and of a stress,
///   P_a <- P_a - N_a/Omega_a,   N_a = s/2 sum_b k_ab e_ab (x) X_ab,
/// as in sweeps/jump_adjoint.hpp. E depends on x alone and is objective: momentum, angular momentum
/// and energy are kept. Test: tests/common/scheme/hourglass_test.cpp

#include "common/algebra/field.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <cstdint>
#include <vector>

namespace diptych::scheme {

template <int Dim>
struct Body;

template <int Dim>
class HourglassControl {
 public:
  /// @pre graph.edges are pairs of the graph
  explicit HourglassControl(const PairGraph& graph);

  std::int64_t bytes() const;

  /// Forces and N of the displacements and F of the body as they stand, with the modulus of its
  /// options.
  void evaluate(const Body<Dim>& body);
  /// The same linearised, of its velocities and their gradients in place of displacements.
  /// @param modulus  s, in any unit
  void evaluate_linear(const Body<Dim>& body, double modulus);

  /// N/Omega of what was evaluated last to body.moments, which P of the records will be without.
  void add_moments(Body<Dim>& body) const;
  /// Takes N/Omega from P of the records.
  void take_stresses(Body<Dim>& body) const;
  /// Forces of what was evaluated last to body.T.
  void add_forces(Body<Dim>& body) const;
  /// Power of what was evaluated last with the velocities and gradients as they are now  [W]
  double power(const Body<Dim>& body) const;
  /// Energy of the body as it stands: by chunks of nodes, added to `sums`  [J]
  void add_energies(const Body<Dim>& body, std::vector<double>& sums);

 private:
  using Array = algebra::AlignedArray<double>;
  void put_displacements(const Body<Dim>& body);
  void exchange(const Body<Dim>& body);
  /// Component k of N/Omega  [Pa]
  double stress_at(const Body<Dim>& body, std::int64_t a, int k) const;
  void sum(const Body<Dim>& body, double modulus);

  std::int64_t n_nodes_ = 0;
  std::vector<std::int64_t> row_;        ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour_;  ///< row after row, ascending
  std::vector<double> weight_;           ///< m^(Dim-2), k_ab
  Array at_;     ///< [n_nodes, padded][4 + 4 + 4 Dim]: X, displacement, columns of F - I
  Array force_;  ///< [n_nodes, padded][4] N
  Array N_;      ///< [n_nodes, padded][4 Dim] N m: its columns
};

extern template class HourglassControl<2>;
extern template class HourglassControl<3>;

}  // namespace diptych::scheme
