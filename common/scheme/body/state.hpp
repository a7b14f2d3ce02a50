#pragma once
/// The unknowns of a body and what the sweeps keep beside them.
///
/// What pair sweeps read of neighbours stands in node tables (algebra/node_table.hpp), all else in
/// block fields (algebra/field.hpp), in double or in single precision (TableShape::single). No
/// value stands twice, but for the velocity in rows.

#include "common/algebra/field.hpp"
#include "common/algebra/flush_to_zero.hpp"
#include "common/algebra/layout.hpp"
#include "common/scheme/graph/sweep_graph.hpp"

namespace diptych::scheme {

using algebra::BlockField;

/// Which of H and J are unknowns of their own, evolved by (18c,d); the others follow from F.
enum class Unknowns { F, FJ, FHJ };

/// Layout of the record that neighbours read in the momentum sweep. The only home of H and of L. In
/// rows a copy of v ends it, so that one gather brings all.
template <int Dim>
struct NodeRecord {
  static constexpr int P = 0;                ///< in-plane first Piola stress, row-major [Pa]
  static constexpr int L = P + Dim * Dim;    ///< velocity gradient dF/dt, row-major [1/s]
  static constexpr int H = L + Dim * Dim;    ///< H - I in plane, row-major [-]
  static constexpr int z_p = H + Dim * Dim;  ///< rho_R c_p [kg/(m^2 s)]
  static constexpr int z_s = z_p + 1;        ///< rho_R c_s
  static constexpr int n_isotropic = z_s + 1;
  // exact impedance only
  static constexpr int F = n_isotropic;  ///< F - I in plane, row-major
  static constexpr int A_tot = F + Dim * Dim;
  static constexpr int S_tot = A_tot + algebra::Layout<Dim>::n_A;
  static constexpr int W_JJ = S_tot + algebra::Layout<Dim>::n_S;
  static constexpr int W_FJ = W_JJ + 1;
  static constexpr int n_exact = W_FJ + 1;
  static constexpr int n(bool exact) { return exact ? n_exact : n_isotropic; }
  // rows only
  static constexpr int v(bool exact) { return n(exact); }  ///< velocity [m/s]
  static constexpr int n_row(bool exact) { return n(exact) + Dim; }
  /// Length of a row, padded to whole cache lines.
  template <class Real>
  static constexpr int stride(bool exact) {
    constexpr int line = 64 / sizeof(Real);
    return (n_row(exact) + line - 1) / line * line;
  }
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
  algebra::NodeTable v;  ///< velocity p/rho_R [m/s]
  BlockField u, F;       ///< displacement [m]; F - I [-]
  BlockField J, H_33;    ///< J - 1, H_33 - 1, where evolved (H_33 in plane strain); other H in the
                         ///< records
  BlockField A,
      S;  ///< [n_branches * n_A], [n_branches * n_S]: C_v^-1 - I, G_v^-1 - I at step begin
  // at the beginning of the step
  BlockField v_0, u_0, F_0, H_0, J_0, L_0;
  algebra::NodeTable records;  ///< NodeRecord: H, L = dF/dt, P and wave speeds
  /// Internal force and loads on the node [N]. Runs, during the momentum sweep: twice that, and a
  /// last component with 2 rho_R Omega times the rate [kg/s].
  algebra::NodeTable T;
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
  /// Component k < Layout::n_H of H - I of a node, where H is evolved.
  double H(std::int64_t node, int k) const {
    return k < Dim * Dim ? records.at(node, NodeRecord<Dim>::H + k) : H_33.at(node, 0);
  }
};

extern template struct State<2>;
extern template struct State<3>;

}  // namespace diptych::scheme
