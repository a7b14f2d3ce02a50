#pragma once
/// Part of the shear energy by gradients of cells instead of those of nodes (notes 3.11):
///   E = s/2 (sum_c int_c |grad u|^2 dV - sum_a Omega_a |F_a - I|^2),
/// grad u that of the shape functions of the cells, integrated by the vertex rule. It is zero in
/// affine motions and not negative where F_a is a mean of the gradients around a; what it holds are
/// waves that nodal F sees badly. Here the first term: with k_ab = -int grad N_a . grad N_b dV its
/// forces are
///   T_a = s sum_b k_ab (u_b - u_a),
/// linear in the positions; the second is -s (F - I) in the stress of the nodes. Momentum is kept,
/// and angular momentum by both together, as the areas of boundary nodes are those of cells. Test:
/// tests/common/scheme/cell_shear_test.cpp

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"
#include "common/scheme/graph/volume_cells.hpp"

#include <cstdint>
#include <vector>

namespace diptych::scheme {

class CellLaplacian {
 public:
  using Array = algebra::AlignedArray<double>;

  CellLaplacian() = default;
  /// @param X  [n_nodes] m, reference positions
  /// @param x  [n_nodes, padded][4] m, the same
  CellLaplacian(const VolumeCells& cells,
                const std::vector<algebra::Vec3>& X,
                int dimension,
                const Array& x);

  std::int64_t bytes() const;

  /// Adds s sum_b k_ab (u_b - u_a) to the forces of nodes [begin, end).
  /// @param x      [n_nodes, padded][4] m, deformed positions
  /// @param force  [n_nodes, padded][4] N
  void add_forces(
      const Array& x, double s, std::int64_t begin, std::int64_t end, Array& force) const;
  /// The same of displacements, which here are given.  @param u  [n_nodes, padded][4] m
  void add_linear_forces(
      const Array& u, double s, std::int64_t begin, std::int64_t end, Array& force) const;
  /// s/2 times those halves of int |grad u|^2 dV that belong to nodes [begin, end)  [J]
  double energy(const Array& x, double s, std::int64_t begin, std::int64_t end) const;

 private:
  std::vector<std::int64_t> row_;        ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour_;  ///< row after row, ascending
  std::vector<double> weight_;           ///< m^(Dim-2), k_ab
  Array at_rest_;                        ///< [n_nodes, padded][4] m, reference positions
};

}  // namespace diptych::scheme
