#pragma once
/// A body: its sub-graph, the fields of its nodes and the table that says what each field is.
///
/// What pair sweeps read of neighbours stands in node tables (algebra/node_table.hpp), all else in
/// block fields (algebra/field.hpp), in double or in single precision (TableShape::single). No
/// value stands twice, but for the velocity in rows. Sweeps name the fields they need; whatever is
/// done to all of them (memory, unknowns per node, hash, checkpoint, exchange) is a loop over
/// fields(). Test: tests/common/scheme/body_test.cpp.

#include "common/algebra/field.hpp"
#include "common/algebra/flush_to_zero.hpp"
#include "common/algebra/layout.hpp"
#include "common/parallel/part.hpp"
#include "common/scheme/graph/sweep_graph.hpp"
#include "common/scheme/hourglass/hourglass_control.hpp"
#include "common/scheme/volumes/bulk_volumes.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace diptych::scheme {

using algebra::BlockField;
using algebra::NodeTable;

/// Which of H and J are unknowns of their own, evolved by (18c,d); the others follow from F.
enum class Unknowns { F, FJ, FHJ };

/// What a field is to a step.
enum class Role {
  unknown,     ///< what the scheme evolves: all that a state is, with the time
  step_begin,  ///< unknowns at the beginning of the step
  derived,     ///< follows from the unknowns; what neighbours read is exchanged with them
  accumulated  ///< summed over pairs: the internal forces
};

/// Layout of the record that neighbours read in the momentum sweep. The only home of H, and of L
/// where the reconstruction has no slopes of its own. In rows a copy of v ends it, so that one
/// gather brings all.
template <int Dim>
struct NodeRecord {
  static constexpr int P = 0;                ///< in-plane first Piola stress, row-major [Pa]
  static constexpr int L = P + Dim * Dim;    ///< dF/dt or slopes along lines, row-major [1/s]
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

/// What neighbours read beside it for the objective reconstruction: where a node is, and how it
/// spins. F and u stand twice then.
template <int Dim>
struct NodeFrame {
  static constexpr int F = 0;           ///< F - I in plane, row-major [-]
  static constexpr int u = Dim * Dim;   ///< displacement [m]
  static constexpr int spin = u + Dim;  ///< axial vector of the skew part of L F^-1 [1/s]
  static constexpr int n_spin = Dim == 3 ? 3 : 1;  ///< in the plane: about its normal
  static constexpr int n = spin + n_spin;
  static constexpr int stride = Dim == 3 ? 16 : 8;
};

/// Row of a tensor, padded to whole gathers (face correction).
template <int Dim>
inline constexpr int tensor_stride = Dim == 3 ? 12 : 4;

/// What a scene needs of its body; what it does not need takes no memory and no work.
struct BodyOptions {
  double rho_R = 0;    ///< kg/m^3
  int n_branches = 0;  ///< Maxwell branches
  bool has_G = false;  ///< branches keep S = G_v^-1
  Unknowns unknowns = Unknowns::FHJ;
  bool exact_impedance = false;
  bool has_frames = false;   ///< objective reconstruction
  bool has_moments = false;  ///< symmetric reconstruction
  bool has_slopes = false;   ///< those of the graph stand in for dF/dt in the reconstruction
  bool keeps_L_0 = false;    ///< dF/dt at the beginning of the step, for GEXP (notes 5.3)
  bool face_correction = false;
  Volumes volumes = Volumes::nodes;  ///< what carries the pressure, resolved
  double cell_shear = 0;  ///< Pa, shear modulus that gradients of cells carry (notes 3.11)
  double hourglass = 0;   ///< Pa, s of scheme/hourglass; takes the symmetric reconstruction
};

/// What of a body is worked where it is divided among ranks (ranks/division.hpp).
struct Division;

template <int Dim>
struct Body;

/// A row of the table of fields: components `first` to `first + n_components` of a node table or of
/// a block field. A field in two places (H in plane and H_33) has a row for each, under one name.
template <int Dim>
struct Field {
  std::string_view name;
  std::string_view unit;
  int n_components = 0;
  Role role = Role::derived;
  NodeTable Body<Dim>::*table = nullptr;   ///< where it stands: here
  BlockField Body<Dim>::*block = nullptr;  ///< or here
  int first = 0;
  int stride = 0;                   ///< of the rows of the table
  bool read_by_neighbours = false;  ///< what ranks exchange

  double at(const Body<Dim>& body, std::int64_t node, int component) const {
    return table != nullptr ? (body.*table).at(node, first + component)
                            : (body.*block).at(node, first + component);
  }
  void set(Body<Dim>& body, std::int64_t node, int component, double value) const {
    if (table != nullptr) {
      (body.*table).set(node, first + component, value);
    } else {
      (body.*block).set(node, first + component, value);
    }
  }
};

template <int Dim>
struct Body {
  SweepGraph<Dim> graph;
  BodyOptions options;
  std::int64_t n_owned = 0;   ///< nodes
  std::int64_t n_stored = 0;  ///< nodes that arrays have room for: on every rank all of them
  std::int64_t n_blocks = 0;
  std::vector<Vec3> X;  ///< [n_stored] m, reference positions
  Vec3 centroid;        ///< m, of the undeformed body: moments are about it

  // unknowns
  NodeTable v;         ///< velocity p/rho_R [m/s]
  BlockField u, F;     ///< displacement [m]; F - I [-]
  BlockField J, H_33;  ///< J - 1, H_33 - 1, where evolved (H_33 in plane strain); other H in the
                       ///< records
  BlockField A, S;     ///< [n_branches * n_A], [n_branches * n_S]: C_v^-1 - I, G_v^-1 - I at the
                       ///< beginning of the step
  // at the beginning of the step
  BlockField v_0, u_0, F_0, H_0, J_0, L_0;
  NodeTable records;  ///< NodeRecord: H, L, P and wave speeds
  BlockField rates;   ///< dF/dt, where the records hold slopes along lines
  /// Internal force and loads on the node [N]. Runs, during the momentum sweep: twice that, and a
  /// last component with 2 rho_R Omega times the rate [kg/s].
  NodeTable T;
  NodeTable frames;  ///< NodeFrame, objective reconstruction only
  /// Symmetric reconstruction only: N/Omega of jump_adjoint.hpp [Pa], which P of the records is
  /// without; runs, during its sweep: 4 N [N m].
  NodeTable moments;
  // face correction only: what its sweeps read
  NodeTable gradients;  ///< uncorrected dF/dt
  NodeTable stresses;   ///< P
  /// What carries the pressure in place of J of the nodes (notes 3.9); P of the records is then
  /// without it, and without what gradients of cells carry of the shear (3.11). Null: nodes do.
  std::unique_ptr<BulkVolumes<Dim>> bulk;
  /// What holds displacements that F of the nodes does not see; null: nothing does.
  std::unique_ptr<HourglassControl<Dim>> hourglass;
  /// Among ranks; null: this one works all of it.
  std::shared_ptr<Division> division;

  /// At rest: u = v = 0, F = H = I, J = 1, A = S = I.
  Body(const PairGraph& whole, const BodyOptions& what);
  /// In an arrangement of choice, for tests and measurements.
  Body(const PairGraph& whole, const BodyOptions& what, Arrangement arrangement);
  /// Of a graph that is ready for sweeps, of which `whole` may have the nodes alone.
  Body(const PairGraph& whole, const BodyOptions& what, SweepGraph<Dim> sub_graph);

  const std::vector<Field<Dim>>& fields() const { return fields_; }
  /// Of all fields, without the graph.
  std::int64_t bytes() const;
  /// Unknowns per node, as reported: v, u, F, H, J, A, S as stored.
  int unknowns_per_node() const;

  /// Chunks of blocks that this rank works.
  const parallel::Part& part() const;
  bool is_single() const { return graph.shape.single; }
  bool in_runs() const { return graph.shape.arrangement == Arrangement::runs; }
  /// Reference position about the centroid  [m]
  Vec3 X_centred(std::int64_t node) const { return X[node] - centroid; }
  /// Component k of dF/dt of a node, row-major  [1/s]
  double L(std::int64_t node, int k) const {
    return options.has_slopes ? rates.at(node, k) : records.at(node, NodeRecord<Dim>::L + k);
  }
  /// Component k < Layout::n_H of H - I of a node, where H is evolved.
  double H(std::int64_t node, int k) const {
    return k < Dim * Dim ? records.at(node, NodeRecord<Dim>::H + k) : H_33.at(node, 0);
  }

 private:
  void list_fields();
  void allocate();
  std::vector<Field<Dim>> fields_;
};

/// Values of a field at nodes, node by node, as they are stored (deviations from I).
template <int Dim>
std::vector<double> values_of(const Body<Dim>& body,
                              std::string_view field,
                              const std::vector<std::int64_t>& nodes);

extern template struct Body<2>;
extern template struct Body<3>;

}  // namespace diptych::scheme
