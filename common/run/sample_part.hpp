#pragma once
/// A part of a large lattice that has rows of all its classes, on which the largest rates of the
/// whole are estimated: modes of a few cells are the fastest, and they are where some class of rows
/// is. Test: tests/common/run/sample_part_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

#include <optional>

namespace diptych::run {

/// Nodes of a part: rates within 0.5 % of those of the whole on cubes of 30^3 to 40^3 nodes, whose
/// own are from below by as much (16 iterations).
inline constexpr std::int64_t n_sample_nodes = 12'000;

struct SamplePart {
  scheme::PairGraph graph;  ///< without boundary, patches, classes, cells and slopes
  /// [n_nodes] 1 where all neighbours are nodes of the part, else 0: where they alone move, rates
  /// of the part are Rayleigh quotients of the whole, so that none is larger than the largest.
  std::vector<double> moves;
};

/// Nodes within so many steps from pair to pair of the first node of each class that there are
/// `wanted` of them or more.
/// @return nothing where that is a third of the graph or more, where it has no classes of its
/// factory, or a class for every twenty nodes wanted
std::optional<SamplePart> sample_part(const scheme::PairGraph& graph,
                                      std::int64_t wanted = n_sample_nodes);

}  // namespace diptych::run
