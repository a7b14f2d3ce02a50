#pragma once
/// Volumes of nodes made of the volumes of deformed cells, and the forces of a pressure in them
/// (notes 3.9):
///   V_a = sum_c w_ca V_c(x),   J = M (V / V(X)),
///   (M j)_a = j_a + sum_c alpha_c w_ca V_c(X) (j_a - sum_b w_cb j_b) / V_a(X),
///   T_b = -sum_c q_c dV_c/dx_b,   q_c = sum_a w_ca (M U'(J))_a,
/// w_ca the share of corner a: M takes back what the means of V have smoothed. The force is the
/// derivative of sum_a V_a(X) U(J_a), so momentum, angular momentum and energy are kept by
/// construction, and sum_a V_a(X) J_a is the volume that the boundary encloses. Sums of nodes have
/// a fixed order: the same bits for every number of threads. Test:
/// tests/common/scheme/volumes_test.cpp

#include "common/scheme/volumes/bulk_volumes.hpp"
#include "common/scheme/volumes/cell_laplacian.hpp"

namespace diptych::scheme {

/// Cells with the same number of corners, eight to a block, ordered by the segment of nodes that
/// their lowest corner is in. No cell reaches farther than into the next segment, so the forces of
/// every second segment can be added up at the same time.
struct CellGroup {
  int n_corners = 0;
  std::int64_t n_blocks = 0;
  std::int64_t first_cell = 0;                 ///< of all groups, whole blocks
  std::vector<std::int64_t> segment;           ///< [n_segments + 1] blocks
  algebra::AlignedArray<std::int32_t> corner;  ///< [n_blocks][n_corners][8] nodes
  algebra::AlignedArray<double> share;         ///< the same; empty where all are 1/n_corners
  algebra::AlignedArray<double> weight;        ///< [n_blocks][8] m^Dim, alpha_c V_c(X)
};

/// The cells around each node: block of eight nodes by block, the k-th of each side by side, padded
/// with a cell that holds nothing.
struct CellsOfNodes {
  algebra::AlignedArray<std::int64_t> first;  ///< [n_blocks + 1] eights
  algebra::AlignedArray<std::int32_t> cell;   ///< [eights][8]
  algebra::AlignedArray<double> share;        ///< [eights][8]; empty where all are the same
  double equal_share = 0;
  algebra::AlignedArray<double> weight;  ///< [n_nodes, padded] m^Dim, of all their cells by share
};

template <int Dim>
class CellVolumes : public BulkVolumes<Dim> {
 public:
  /// @param X           [n_nodes] m, reference positions
  /// @param with_shear  gradients of cells carry a part of the shear, too (notes 3.11)
  CellVolumes(const VolumeCells& cells, const std::vector<algebra::Vec3>& X, bool with_shear);

  std::int64_t bytes() const override;
  std::vector<CellWork> work_of(const parallel::Part& part, std::vector<char>& read) const override;
  void evaluate(const Body<Dim>& body, const MaterialModel& material) override;
  void evaluate_linear(const Body<Dim>& body, double modulus, double shear) override;
  void add_shear_energies(const Body<Dim>& body, std::vector<double>& sums) const override;
  std::vector<double> ratios(const Body<Dim>& body) const override;
  /// Those of the deformed faces.
  std::vector<algebra::Vec3> deformed_areas(const Body<Dim>& body,
                                            const BoundaryPatch& patch) override;

 private:
  using Base = BulkVolumes<Dim>;
  using Array = typename Base::Array;
  using Base::exchange;
  using Base::force_;
  using Base::n_nodes;
  using Base::put_positions;
  using Base::V_0_;
  using Base::x_;
  /// Volumes of all cells, or their rates of change.
  /// @param body  whose part it is; null: all
  /// @param rate  [n_nodes][4] m/s, or null
  void put_volumes(const Body<Dim>* body, const Array& x, const double* rate, Array& volume) const;
  /// V_a / V_a(X), or its rate, of the volumes of cells.
  void put_ratios(const parallel::Part& part, const Array& volume, Array& ratio) const;
  /// values <- M values.  @param of_cells  [n_cells + 8] of no more use
  void sharpen(const Body<Dim>& body, Array& values, Array& of_cells) const;
  void clear_forces(const Body<Dim>& body);
  /// force_ <- that of the pressures.
  void put_forces(const Body<Dim>& body);
  void list_cells_of_nodes(const VolumeCells& cells, const std::vector<std::int64_t>& place);

  std::vector<CellGroup> groups_;
  CellsOfNodes around_;
  CellLaplacian laplacian_;                    ///< empty where nodes carry all of the shear
  std::int64_t n_cells_ = 0, n_segments_ = 0;  ///< cells: whole blocks
  Array inverse_V_0_;                          ///< [n_nodes, padded] m^-Dim
  // of a sweep
  Array of_cells_;  ///< [n_cells + 8] m^Dim
  Array pressure_;  ///< [n_nodes, padded] U'(J_a)  [Pa]
};

extern template class CellVolumes<2>;
extern template class CellVolumes<3>;

}  // namespace diptych::scheme
