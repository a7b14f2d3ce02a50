#pragma once
/// Node orders of small bandwidth, so that a gather over neighbours stays in cache.

#include "meshes/mesh.hpp"

#include <cstdint>
#include <vector>

namespace diptych::meshes {

/// Reverse Cuthill-McKee order of the graph in which nodes of one cell are neighbours, each part
/// started at a pseudo-peripheral node. Ties go to the lower index, so the order is repeatable.
/// @return order[new index] = old index, [n_nodes]
/// @see E. Cuthill, J. McKee, ACM 1969; A. George, J. W. H. Liu, ACM TOMS 5 (1979) for the start
std::vector<std::int32_t> rcm_order(const Mesh& mesh);

/// The same mesh with its nodes in another order; cells, faces and groups keep theirs.
/// @pre order is a permutation of 0 .. n_nodes - 1
Mesh renumbered(const Mesh& mesh, const std::vector<std::int32_t>& order);

/// Largest difference of two node indices in one cell.
std::int64_t bandwidth(const Mesh& mesh);

}  // namespace diptych::meshes
