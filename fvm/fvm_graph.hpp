#pragma once
/// Vertex-centred finite volumes as a pair graph: nodal-quadrature edge stencil
/// C_ab = 2 sum_e w_a^e grad N_b(X_a) (quadrilaterals, hexahedra; notes 4.2), or
/// C_ab = 2 int N_a grad N_b dV (notes 4.1), or operators that sum by parts: along the lines of a
/// block (sbp_graph.hpp; notes 4.3) or of curved blocks glued at their nodes (sbp_blocks_graph.hpp;
/// notes 4.6), elsewhere over two rings of cells (sbp_cells_graph.hpp; notes 4.5).

#include "common/scheme/graph/operators.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::fvm {

struct Options {
  /// edge or integral, on simplices the same up to the boundary; sbp; auto: sbp where an order
  /// above two fits on a box, on blocks (over cells, as below, or where short lines are uneven),
  /// and where they go with them on other cells, edge elsewhere
  std::string stencil = "edge";
  int order = 4;                          ///< of sbp on blocks
  std::string second_order_because = {};  ///< auto: edge, for this reason, unless empty
  /// auto: off boxes, for this reason unless empty, those alone that bear any bulk pressure, in
  /// volumes of cells (notes 3.9)
  std::string strong_pressure_because = {};
  /// The dissipation is a sum of squares whatever the operators (notes 3.4), so that auto: sbp on
  /// curved lines of six nodes, too, on which it gives energy with linear jumps
  bool jumps_are_symmetric = false;
  /// auto: on curved blocks sbp over cells, whose pressures lock less than those of lines: a ring
  /// of 6, 8 and 12 nodes across, nu = 0.4995, swings within 5.0, 1.1 and 0.4 % (lines 43, 11, 2.6
  /// %); at nu = 0.495 2.1, 0.8, 0.4 (6.4, 1.2, 0.3), at 0.33 1.8, 0.8, 0.3 (1.9, 0.4, 0.2)
  bool is_hardly_compressible = false;
};

/// What Options::stencil may be.
const std::vector<std::string>& stencil_names();

/// @throws base::InputError where sbp was asked for and the mesh does not go with it
scheme::Operators operators_on(const meshes::Mesh& mesh, const Options& options);

/// Their graph alone.
scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::fvm
