#pragma once
/// The unknowns of a body and what the sweeps keep beside them.
///
/// Two forms of the same values: block fields (algebra/field.hpp) for pointwise work, and node
/// tables (algebra/node_table.hpp) that pair sweeps read of neighbours.

#include "common/algebra/field.hpp"
#include "common/algebra/layout.hpp"
#include "common/scheme/sweep_graph.hpp"

namespace diptych::scheme {

using algebra::BlockField;

/// Which of H and J are unknowns of their own, evolved by (18c,d); the others follow from F.
enum class Unknowns { F, FJ, FHJ };

/// Layout of the record that neighbours read in the momentum sweep (doubles).
template <int Dim>
struct NodeRecord {
  static constexpr int v = 0;                ///< velocity [m/s]
  static constexpr int P = Dim;              ///< in-plane first Piola stress, row-major [Pa]
  static constexpr int L = P + Dim * Dim;    ///< velocity gradient dF/dt, row-major [1/s]
  static constexpr int H = L + Dim * Dim;    ///< in-plane cofactor, row-major [-]
  static constexpr int z_p = H + Dim * Dim;  ///< rho_R c_p [kg/(m^2 s)]
  static constexpr int z_s = z_p + 1;        ///< rho_R c_s
  static constexpr int n_isotropic = z_s + 1;
  // exact impedance only
  static constexpr int F = n_isotropic;  ///< in-plane, row-major
  static constexpr int A_tot = F + Dim * Dim;
  static constexpr int S_tot = A_tot + algebra::Layout<Dim>::n_A;
  static constexpr int W_JJ = S_tot + algebra::Layout<Dim>::n_S;
  static constexpr int W_FJ = W_JJ + 1;
  static constexpr int n_exact = W_FJ + 1;
  static constexpr int n(bool exact) { return exact ? n_exact : n_isotropic; }
  /// Length of a row in doubles, padded to whole cache lines.
  static constexpr int stride(bool exact) { return (n(exact) + 7) / 8 * 8; }
};

/// Row of a tensor, padded to whole gathers (face correction).
template <int Dim>
inline constexpr int tensor_stride = Dim == 3 ? 12 : 4;

template <int Dim>
struct State {
  std::int64_t n_nodes = 0, n_blocks = 0;
  int n_branches = 0;
  bool has_G = false;  ///< branches keep S = G_v^-1
  Unknowns unknowns = Unknowns::FHJ;
  algebra::TableShape shape;  ///< of the tables

  // unknowns
  BlockField v, u, F;  ///< velocity p/rho_R [m/s], displacement [m], deformation gradient [-]
  BlockField H, J;     ///< where evolved
  BlockField A, S;     ///< [n_branches * n_A], [n_branches * n_S]: C_v^-1, G_v^-1 at step begin
  // at the beginning of the step
  BlockField v_0, u_0, F_0, H_0, J_0, L_0;
  // rates
  BlockField L;  ///< dF/dt = velocity gradient [1/s]
  BlockField T;  ///< internal force and loads, force on the node [N]
  // what neighbours read
  algebra::NodeTable velocity;
  algebra::NodeTable records;  ///< NodeRecord
  // runs only: what the momentum sweep adds up for both nodes of a pair
  algebra::NodeTable pair_sums;  ///< 2 T before the loads [N]; 2 rho_R Omega times the rate [kg/s]
  // face correction only: what its sweeps read
  algebra::NodeTable gradients;  ///< uncorrected dF/dt
  algebra::NodeTable stresses;   ///< P

  State() = default;
  State(std::int64_t n,
        int branches,
        bool G,
        Unknowns which,
        bool exact_impedance,
        bool keep_L_0,
        const algebra::TableShape& table_shape);
  std::int64_t bytes() const;
  /// Makes room for the face correction.
  void allow_face_correction();
  bool has_face_correction() const { return !gradients.empty(); }
  /// Unknowns per node, as reported: v, u, F, H, J, A, S as stored.
  int unknowns_per_node() const;
};

extern template struct State<2>;
extern template struct State<3>;

}  // namespace diptych::scheme
