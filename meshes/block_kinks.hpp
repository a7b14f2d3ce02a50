#pragma once
/// Kinks of the lines of a block, where wide differences of the places of nodes would not see a
/// smooth map. With D2 the second differences of places along a line, over the spacing, a layer of
/// nodes across the lines is one where the sum of |D2|^2 over its nodes is more than 16 times that
/// of either layer beside it (there are two, else it is none), and |D2| more than 0.02 in root mean
/// square. Source: notes 4.6. Test: tests/graphs/lattice_blocks_test.cpp

#include "meshes/lattice_blocks.hpp"

#include <utility>

namespace diptych::meshes {

using CellPair = std::pair<std::int64_t, std::int64_t>;

/// Neighbours on either side of each layer with a kink.
std::vector<CellPair> cells_at_kinks(const Mesh& mesh, const LatticeBlock& block);

}  // namespace diptych::meshes
