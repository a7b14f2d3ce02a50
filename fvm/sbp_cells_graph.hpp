#pragma once
/// Finite volumes that sum by parts on any cells: rows reach two rings
/// of edges, three where that is too few for a quadratic, and the C_ab are those of the edge
/// stencil, changed least, with the weight Omega_a Omega_b exp(-(r/1.2 h)^2), to sum by parts. Rows
/// are exact for quadratics, the adjoint for linear stresses, up to the boundary. Source:
/// notes 4.5. Test: tests/graphs/summation_by_parts_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/mesh.hpp"

namespace diptych::fvm {

/// @throws base::InputError where sides are curved, or rows cannot meet the conditions
scheme::PairGraph sbp_graph_of_cells(const meshes::Mesh& mesh);

}  // namespace diptych::fvm
