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

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"
#include "common/parallel/halo.hpp"
#include "common/scheme/graph/volume_cells.hpp"

#include <cstdint>
#include <vector>

namespace diptych::scheme {

/// What carries the bulk pressure: J of the nodes, volumes of cells, or these but for graphs whose
/// derivatives commute, where J of the nodes cannot cheat.
enum class Volumes { automatic, nodes, cells };

class MaterialModel;
template <int Dim>
struct Body;

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

/// Blocks of cells of a group that a rank works: those around its nodes, segment by segment.
struct CellWork {
  std::vector<std::vector<parallel::NodeRange>> segments;  ///< [n_segments] ranges of blocks
};

template <int Dim>
class CellVolumes {
 public:
  CellVolumes() = default;
  /// @param X  [n_nodes] m, reference positions
  CellVolumes(const VolumeCells& cells, const std::vector<algebra::Vec3>& X);

  bool empty() const { return groups_.empty(); }
  std::int64_t bytes() const;
  /// Volume of node a in the reference state  [m^Dim]
  double reference(std::int64_t a) const { return V_0_[a]; }

  /// What a rank works.
  /// @param corners  [n_nodes] set to 1 where these cells have a corner
  std::vector<CellWork> work_of(const parallel::Part& part, std::vector<char>& corners) const;

  /// Adds the forces of the pressure U'(J_a) of the material to body.T, for the displacements as
  /// they stand.
  void add_forces(Body<Dim>& body, const MaterialModel& material);

  /// The same linearised: adds the forces of modulus (dV_a/V_a), dV_a the change of volume with the
  /// body's velocities in the place of a change of displacement. For the frequencies of set-up.
  void add_linear_forces(Body<Dim>& body, double modulus);

  /// Power of the forces that were added last with the velocities as they are now  [W]
  double power(const Body<Dim>& body) const;

  /// J of the nodes by the volumes of cells, among ranks of the own ones  [n_nodes]
  std::vector<double> ratios(const Body<Dim>& body) const;

 private:
  using Array = algebra::AlignedArray<double>;
  void put_positions(const Body<Dim>& body, Array& x) const;
  /// Volumes of all cells, or their rates of change.
  /// @param body  whose part it is; null: all
  /// @param rate  [n_nodes][4] m/s, or null
  void put_volumes(const Body<Dim>* body, const Array& x, const double* rate, Array& volume) const;
  /// V_a / V_a(X), or its rate, of the volumes of cells.
  void put_ratios(const parallel::Part& part, const Array& volume, Array& ratio) const;
  /// values <- M values.  @param of_cells  [n_cells + 8] of no more use
  void sharpen(const Body<Dim>& body, Array& values, Array& of_cells) const;
  /// What neighbours of its nodes have in rows of n numbers, from their ranks.
  void exchange(const Body<Dim>& body, Array& values, int n) const;
  void clear_forces(const Body<Dim>& body);
  void sum_forces(Body<Dim>& body);
  void list_cells_of_nodes(const VolumeCells& cells, const std::vector<std::int64_t>& place);

  std::vector<CellGroup> groups_;
  CellsOfNodes around_;
  std::int64_t n_nodes_ = 0, n_cells_ = 0, n_segments_ = 0;  ///< cells: whole blocks
  Array V_0_, inverse_V_0_;                                  ///< [n_nodes, padded] m^Dim
  // of a sweep
  Array x_;         ///< [n_nodes][4] m, deformed positions
  Array of_cells_;  ///< [n_cells + 8] m^Dim
  Array pressure_;  ///< [n_nodes, padded] U'(J_a)  [Pa]
  Array force_;     ///< [n_nodes, padded][4] N
};

extern template class CellVolumes<2>;
extern template class CellVolumes<3>;

}  // namespace diptych::scheme
