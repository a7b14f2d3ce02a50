#pragma once
/// Vertex-centred finite volumes as a pair graph: nodal-quadrature edge stencil
/// C_ab = 2 sum_e w_a^e grad N_b(X_a) (quadrilaterals, hexahedra; notes 4.2), or
/// C_ab = 2 int N_a grad N_b dV (notes 4.1), or operators that sum by parts: along the lines of a
/// block (sbp_graph.hpp; notes 4.3) or of curved blocks glued at their nodes (sbp_blocks_graph.hpp;
/// notes 4.6), elsewhere over two rings of cells (sbp_cells_graph.hpp; notes 4.5).

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::fvm {

struct Options {
  /// edge or integral, on simplices the same up to the boundary; sbp; auto: sbp on blocks where an
  /// order above two fits, edge elsewhere
  std::string stencil = "edge";
  int order = 4;  ///< of sbp on blocks
};

/// What Options::stencil may be.
const std::vector<std::string>& stencil_names();

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

/// What build_graph makes of a mesh, where that depends on more than the options.
struct Operators {
  std::string text;               ///< for the record; empty where edge or integral was asked for
  std::vector<std::string> lost;  ///< where less than the order asked for fits, and why
  /// "auto" took the edge stencil because of the mesh alone: "sbp" may go with it.
  bool may_sum_by_parts = false;
};

Operators operators_of(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::fvm
