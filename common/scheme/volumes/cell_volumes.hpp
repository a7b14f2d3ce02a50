#pragma once
/// Volumes of nodes made of the volumes of deformed cells, and the forces of a pressure in them
/// (notes 3.9):
///   V_a = sum_cells share_ca V_c(x),   J_a = V_a / V_a(X),
///   T_b = -sum_a U'(J_a) dV_a/dx_b = -sum_c q_c dV_c/dx_b,   q_c = sum_a share_ca U'(J_a).
/// The force is the derivative of sum_a V_a(X) U(J_a), so momentum, angular momentum and energy are
/// kept by construction, and sum_a V_a is the volume that the boundary encloses. Sums of nodes have
/// a fixed order: the same bits for every number of threads. Test:
/// tests/common/scheme/volumes_test.cpp

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"
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

/// Cells with the same number of corners, eight to a block.
struct CellGroup {
  int n_corners = 0;
  std::int64_t n_blocks = 0;
  std::int64_t first_slot = 0;  ///< a slot is a corner of a cell: [block][corner][8], all groups
  algebra::AlignedArray<std::int32_t> corner;  ///< [slots of the group] nodes
  algebra::AlignedArray<double> share;         ///< the same; empty where all are 1/n_corners
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

  /// Adds the forces of the pressure U'(J_a) of the material to body.T, for the displacements as
  /// they stand.
  void add_forces(Body<Dim>& body, const MaterialModel& material);

  /// The same linearised: adds the forces of modulus (dV_a/V_a), dV_a the change of volume with the
  /// body's velocities in the place of a change of displacement. For the frequencies of set-up.
  void add_linear_forces(Body<Dim>& body, double modulus);

  /// Power of the forces that were added last with the velocities as they are now  [W]
  double power(const Body<Dim>& body) const;

  /// J_a = V_a / V_a(X)  [n_nodes]
  std::vector<double> ratios(const Body<Dim>& body) const;

 private:
  using Array = algebra::AlignedArray<double>;
  void put_positions(const Body<Dim>& body, Array& x) const;
  /// Volumes of all corners, or their rates of change.
  /// @param rate  [n_nodes][4] m/s, or null
  void put_volumes(const Array& x, const double* rate, Array& volume) const;
  double sum_at(std::int64_t a, const Array& volume) const;
  void sum_forces(Body<Dim>& body);

  std::vector<CellGroup> groups_;
  std::int64_t n_nodes_ = 0, n_slots_ = 0;
  std::vector<std::int64_t> row_;   ///< [n_nodes + 1] into slot_
  std::vector<std::int32_t> slot_;  ///< of each node, ascending
  Array V_0_;                       ///< [n_nodes] m^Dim
  // of a sweep
  Array x_;         ///< [n_nodes][4] m, deformed positions
  Array volume_;    ///< [n_slots] m^Dim
  Array pressure_;  ///< [n_nodes, padded] U'(J_a)  [Pa]
  Array force_;     ///< [n_slots / 8][Dim][8] N
};

extern template class CellVolumes<2>;
extern template class CellVolumes<3>;

}  // namespace diptych::scheme
