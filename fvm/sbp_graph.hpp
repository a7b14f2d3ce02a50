#pragma once
/// Operators that sum by parts as a pair graph, on an undistorted block of hexahedra or
/// quadrilaterals: along every line of nodes the one-dimensional operator (H, Q) of
/// sbp_operator.hpp, transverse to it the weights H. With the edges e_1, e_2, e_3 of a cell, M_1 =
/// e_2 x e_3 and cyclic, V = e_1 . M_1, and i, j, k the places of a node on its lines,
///   Omega = V H_i H_j H_k,
///   C_ab = 2 Q_ii' H_j H_k M_1 for nodes a = (i, j, k), b = (i', j, k), and cyclic,
///   A_aN_a = -+ H_j H_k M_1 at the two ends of the lines, and cyclic.
/// Rows are exact for polynomials up to the order of the pair inside and half of it in the boundary
/// blocks, closure is exact, and the derivatives commute. On lines too short for the pair (8 nodes
/// for order 4, 12 for 6) the widest pair that fits, on three to seven nodes one that is exact for
/// quadratics. Order 2 is the edge stencil.
///
/// A boundary group that covers a part of a side has, at its edge, the part of H of its faces:
/// exact where that is no nearer to the edge of the side than the boundary block; else it is
/// refused. Source: notes 4.3. Test: tests/graphs/sbp_graph_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>
#include <vector>

namespace diptych::fvm {

/// @param order  2, 4 or 6
scheme::PairGraph sbp_graph(const meshes::Mesh& mesh, int order);

/// One direction of the block.
struct SbpLines {
  algebra::Vec3 direction;  ///< unit vector
  int n_nodes = 0;          ///< on each line
  int order = 2;            ///< of the pair there
};

/// Why stencil = "auto" does not take sbp_graph on a mesh; empty where it does: on undistorted
/// blocks with lines that an order above two fits on, whose boundary groups have areas of their
/// own.
std::string unsure_because(const meshes::Mesh& mesh, int order);

/// What sbp_graph makes of a mesh.
std::vector<SbpLines> sbp_lines(const meshes::Mesh& mesh, int order);

/// "sbp: order 4 on 17 nodes along (1, 0, 0), ..."
std::string lines_text(const std::vector<SbpLines>& lines);

}  // namespace diptych::fvm
