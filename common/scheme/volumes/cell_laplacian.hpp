#pragma once
/// Part of the shear energy by gradients of cells instead of those of nodes (notes 3.11):
///   E = s (sum_c int_c 1/2 (|grad x|^2 - 3) - (det grad x - 1) dV
///          - sum_a Omega_a (1/2 (|F_a|^2 - 3) - (J_a - 1))),
/// grad x that of the shape functions of the cells. It is zero in affine motions; what it holds are
/// waves that nodal F sees badly. Here the first term: its forces are
///   T_a = s sum_b k_ab (x_b - x_a),
/// linear in the positions, so momentum and angular momentum are kept; k_ab is -int grad N_a .
/// grad N_b dV, but of long cells less of what that has beside the mean gradients. The determinant
/// is that of the volumes of cells, the second sum is in the stress of the nodes. Test:
/// tests/common/scheme/volumes_test.cpp

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
  CellLaplacian(const VolumeCells& cells, const std::vector<algebra::Vec3>& X, int dimension);

  bool empty() const { return neighbour_.empty(); }
  std::int64_t bytes() const;

  /// Adds s sum_b k_ab (x_b - x_a) to the forces of nodes [begin, end).
  /// @param x      [n_nodes, padded][4] m, deformed positions
  /// @param force  [n_nodes, padded][4] N
  void add_forces(
      const Array& x, double s, std::int64_t begin, std::int64_t end, Array& force) const;
  /// s/2 times those halves of int |grad x|^2 - |grad X|^2 dV that belong to nodes [begin, end)
  /// [J]
  double energy(const Array& x,
                const std::vector<algebra::Vec3>& X,
                double s,
                std::int64_t begin,
                std::int64_t end) const;

 private:
  std::vector<std::int64_t> row_;        ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour_;  ///< row after row, ascending
  std::vector<double> weight_;           ///< m^(Dim-2), k_ab
};

}  // namespace diptych::scheme
