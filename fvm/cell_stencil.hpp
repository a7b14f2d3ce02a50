#pragma once
/// Rows and pseudo-area vectors of a mesh from its cells:
///   C_ab = 2 sum_q w_q N_a(X_q) grad N_b(X_q)
/// over the points q of a quadrature rule: the vertex rule gives the edge stencil of notes 4.2, the
/// exact rule 2 int N_a grad N_b dV of notes 4.1.

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"
#include "meshes/shape_integrals.hpp"

namespace diptych::fvm {

/// Fills graph.row and graph.neighbour: the pairs that share a cell (exact rule), or a cell's edge
/// (vertex rule; the same on simplices).
void find_pairs(const meshes::Mesh& mesh, meshes::Quadrature quadrature, scheme::PairGraph& graph);

/// Fills graph.C.
/// @return [n_nodes] sum_q w_q N_a(X_q), the volume for which the row is exact for linear fields
std::vector<double> add_cells(const meshes::Mesh& mesh,
                              meshes::Quadrature quadrature,
                              scheme::PairGraph& graph);

}  // namespace diptych::fvm
