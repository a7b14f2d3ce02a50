#pragma once
/// Vertex-centred finite volumes as a pair graph: nodal-quadrature edge stencil
/// C_ab = 2 sum_e w_a^e grad N_b(X_a) (quadrilaterals, hexahedra; physics note 3.8), or
/// C_ab = 2 int N_a grad N_b dV (physics note 4.1).

#include "common/scheme/pair_graph.hpp"
#include "meshes/mesh.hpp"

#include <string>

namespace diptych::fvm {

struct Options {
  std::string stencil = "edge";  ///< edge or integral; simplices are the same up to the boundary
};

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options);

}  // namespace diptych::fvm
