#pragma once
/// Volumes of the nodes of a lattice by derivatives along its lines, and the forces of a pressure
/// in them (notes 3.10). With the tangents G_d = D_d x in units of the lattice, n_d the cofactors
/// n_1 = G_2 x G_3 and cyclic (in the plane G_3 = e_z),
///   J_a = G_1 . n_1 / (volume of a cell),   V_a(X) = Omega_a,
///   T_a = sum_d across_d sum_b Q_ab (pi_a^d + pi_b^d),   pi^d = U'(J) n_d,
/// T the negative derivative of sum_a Omega_a U(J_a), since Q_ba = -Q_ab. The D_d commute, so a
/// state of uniform F is in balance but for the boundary, where its forces are those of a uniform
/// pressure on H A_aN_a, and the second variation of sum_a Omega_a J_a there is of boundary nodes
/// alone: J cannot cheat inside. Sums have a fixed order. Test:
/// tests/common/scheme/volumes_test.cpp

#include "common/scheme/volumes/bulk_volumes.hpp"

#include <array>

namespace diptych::scheme {

/// Derivatives along lines of one direction, the k-th neighbours of eight nodes side by side.
struct LineRows {
  algebra::AlignedArray<std::int64_t> first;      ///< [n_blocks + 1] eights
  algebra::AlignedArray<std::int32_t> neighbour;  ///< [eights][8]
  algebra::AlignedArray<double> Q;                ///< [eights][8], zero where there is none
  algebra::AlignedArray<double> inverse_H;        ///< [n_nodes, padded]
  algebra::AlignedArray<double> across;           ///< [n_nodes, padded]
};

template <int Dim>
class LineVolumes : public BulkVolumes<Dim> {
 public:
  /// @pre graph.lines is not empty
  explicit LineVolumes(const PairGraph& graph);

  std::int64_t bytes() const override;
  std::vector<CellWork> work_of(const parallel::Part& part, std::vector<char>& read) const override;
  void evaluate(const Body<Dim>& body, const MaterialModel& material) override;
  void evaluate_linear(const Body<Dim>& body, double modulus, double) override;
  std::vector<double> ratios(const Body<Dim>& body) const override;
  /// Cofactors of the nodes' own derivatives along lines times A_aN_a.
  std::vector<algebra::Vec3> deformed_areas(const Body<Dim>& body,
                                            const BoundaryPatch& patch) override;

 private:
  using Base = BulkVolumes<Dim>;
  using Array = typename Base::Array;
  using Base::exchange;
  using Base::force_;
  using Base::n_nodes;
  using Base::put_positions;
  using Base::stride;
  using Base::V_0_;
  using Base::x_;
  /// J and cofactors of the part's nodes.
  /// @param x     [n_nodes, padded][4]  m
  /// @param rate  [n_nodes][4] velocities, for the rate of J in the place of J; or null
  /// @param normal  [n_nodes, padded][4] of each direction; or null
  void put_tangents(const parallel::Part& part,
                    const Array& x,
                    const double* rate,
                    Array& J,
                    std::array<Array, Dim>* normal) const;
  /// n_d of node a, as columns  [m^(Dim-1)]
  algebra::Mat3 cofactors_at(std::int64_t a) const;
  /// Adds the forces of the pressures times the normals that stand.
  void sum_forces(const Body<Dim>& body);

  std::array<LineRows, Dim> rows_;
  double inverse_cell_ = 0;          ///< m^-Dim
  algebra::Mat3 inverse_cofactors_;  ///< of cofactors_at in the reference state
  // of a sweep
  Array pressure_;                 ///< [n_nodes, padded] U'(J_a)  [Pa]
  std::array<Array, Dim> normal_;  ///< [n_nodes, padded][4] n_d, then pi^d
};

extern template class LineVolumes<2>;
extern template class LineVolumes<3>;

}  // namespace diptych::scheme
