#pragma once
/// Metrics of a curved block whose lines have operators that sum by parts (sbp_operator.hpp). With
/// D_1, D_2, D_3 their derivatives along the three lines through a node, in lattice coordinates,
///   T_d = D_d X,   M_1 = T_2 x T_3 and cyclic (in 2-D T_3 = e_z),   det = T_1 . M_1,
/// M the metrics J grad xi of the map, and H_t the product of the weights of the lines across.
/// Since T_d . M_e = det delta_de, the derivative sum_d M_d D_d/det is exact for X whatever the
/// map; sum_d D_d M_d is zero in 2-D and on extruded blocks, because the D_d commute, and of the
/// order of the derivatives elsewhere. Source: notes 4.6. Test: tests/graphs/sbp_blocks_test.cpp

#include "common/closure/sbp_operator.hpp"
#include "meshes/lattice_blocks.hpp"

#include <array>
#include <vector>

namespace diptych::fvm {

class BlockMetrics {
 public:
  /// @throws base::InputError where the map is inside out at a node, with its place
  BlockMetrics(const meshes::Mesh& mesh, const meshes::LatticeBlock& block, int order);

  const meshes::LatticeBlock& block() const { return block_; }
  const closure::SbpOperator& along(int d) const { return along_[static_cast<size_t>(d)]; }
  double volume(std::int64_t place) const;  ///< H_1 H_2 H_3 det  [m^d]
  /// H_t M_d: pseudo-area per unit of Q_ij along d  [m^(d-1)]
  algebra::Vec3 area(std::int64_t place, int d) const;

 private:
  const meshes::LatticeBlock& block_;
  std::vector<closure::SbpOperator> along_;
  std::vector<std::array<algebra::Vec3, 3>> T_;  ///< [n_places]
};

}  // namespace diptych::fvm
