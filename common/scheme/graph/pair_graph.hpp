#pragma once
/// The pair graph: all that the scheme knows of a discretisation (design idea 1). A backend (sph,
/// fvm) is a factory of this object; it is built once, on the host, in double precision.
///
/// Equations: the pseudo-area vectors C_ab of (18a-d), (19); closure of notes 3.3:
///   -1/2 sum_b (C_ab - C_ba) = A_a N_a.
/// Tests: tests/graphs.

#include "common/algebra/shared_vectors.hpp"
#include "common/algebra/vectors.hpp"
#include "common/scheme/graph/row_classes.hpp"
#include "common/scheme/graph/slope_graph.hpp"
#include "common/scheme/graph/volume_cells.hpp"
#include "common/scheme/graph/volume_lines.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych::scheme {

using algebra::Mat3;
using algebra::Vec3;

/// A named part of the boundary as nodes with their share of its area.
struct BoundaryPatch {
  std::string name;
  std::vector<std::int32_t> nodes;  ///< ascending
  std::vector<Vec3> area;  ///< [nodes] m^2 (m per unit thickness in 2-D): int_patch N_a N dA
  /// Corners of its faces, outward; -1 where a face has fewer than four. Empty with operators that
  /// have no cells.
  std::vector<std::array<std::int32_t, 4>> faces{};
};

/// Of what sweeps read and write; set-up is always in double precision.
enum class Precision {
  full,   ///< all in double, but for |S_ab| and S_ab, which only scale the dissipation
  mixed,  ///< C_ab in single, all else in double
  single  ///< C_ab and the state in single; sums over pairs in single, pointwise physics in double
};

struct PairGraph {
  int dimension = 3;
  std::vector<Vec3> X;                 ///< [n_nodes] m, reference positions
  std::vector<double> Omega;           ///< [n_nodes] m^3 (m^2 in 2-D), all > 0
  std::vector<Vec3> boundary_area;     ///< [n_nodes] m^2, A_a N_a over the whole boundary
  std::vector<BoundaryPatch> patches;  ///< one per boundary group of the mesh, same order
  std::vector<std::int64_t> row;       ///< [n_nodes + 1]
  std::vector<std::int32_t>
      neighbour;  ///< [n_pairs] ascending in each row, without the node itself
  std::vector<std::int32_t> reverse_place;  ///< [n_pairs] where pair (b,a) stands in the row of b
  algebra::SharedVectors C;                 ///< [n_pairs] m^2, C_ab of the directed pair (a,b)
  /// Where the factory knows them, which takes that rows stand in their common order; else empty.
  RowClasses classes;
  VolumeCells cells;  ///< those between its nodes
  /// [.][2] nodes a < b of pairs that edges of the mesh join, where rows leave displacements that
  /// F of the nodes hardly sees (scheme/hourglass); else empty.
  std::vector<std::array<std::int32_t, 2>> edges;
  VolumeLines lines;  ///< those of its nodes, where boundary areas are theirs
  /// Pairs for which it makes |X_b - X_a| more than one dissipate nothing (dissipation_area.hpp).
  /// [1/m]
  Mat3 dissipation_metric = Mat3::Zero();
  /// Along lines of nodes, for jumps between the nearest on them; empty where there are no lines.
  SlopeRows slopes;
  bool commutes = false;  ///< its derivatives in different directions do, as of tensor products
  Precision precision = Precision::full;  ///< see set_precision

  std::int64_t n_nodes() const { return static_cast<std::int64_t>(X.size()); }
  std::int64_t n_pairs() const { return static_cast<std::int64_t>(neighbour.size()); }
  /// Index of pair (b,a), where that of (a,b) is p.
  std::int64_t reverse(std::int64_t p) const { return row[neighbour[p]] + reverse_place[p]; }
};

/// Figures of merit of a graph, for the log, the record and the tests. All are relative:
/// lengths to h_a = Omega_a^(1/d), areas to h_a^(d-1).
struct GraphQuality {
  double linear_exactness = 0;  ///< max |sum_b 1/2 (X_b - X_a) (x) C_ab / Omega_a - I|
  double closure = 0;           ///< max |-1/2 sum_b (C_ab - C_ba) - A_a N_a| / h_a^(d-1)
  double mean_neighbours = 0;
  int least_neighbours = 0;
};

GraphQuality quality(const PairGraph& graph);

/// Checks structure (sorted rows, reverse pairs, finite numbers, positive volumes).
/// @throws base::InputError that names the node and its place
void validate(const PairGraph& graph);

/// Below full: rounds every C_ab to single precision, in which sweeps then keep it. Forces of pairs
/// stay exactly opposite and dual to the strain rates (single: to rounding); closure and linear
/// exactness hold to 1e-7.
/// @throws base::InputError where squares of areas leave the range of single precision
void set_precision(PairGraph& graph, Precision precision);

/// The metric in which neighbours along the edges of a cell are at a distance of one, all others
/// farther away.  @param edges  as columns  [m]
Mat3 metric_of_lines(const Mat3& edges);

/// Frees rows, neighbours, reverse pairs, C_ab and slopes, of which a solver makes its own, and the
/// areas that only factories need. n_pairs() is 0 from now on.
void release_pairs(PairGraph& graph);

/// Frees cells, lines and edges, of which a solver makes its own too, but for those of other ranks.
void release_volumes(PairGraph& graph);

/// Fills graph.reverse_place from rows and neighbours (which must be structurally symmetric).
void link_reverse_pairs(PairGraph& graph);

}  // namespace diptych::scheme
