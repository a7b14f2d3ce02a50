#pragma once
/// Runs of a pair graph: for each block of eight nodes the offsets b - a in the numbering at which
/// any of them has a neighbour.

#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::scheme {

struct PairRuns {
  std::vector<std::int64_t> row;     ///< [n_blocks + 1] into offset
  std::vector<std::int32_t> offset;  ///< ascending in each block
  std::int64_t reach = 0;            ///< largest |offset|
  double filling = 0;                ///< pairs of the graph / lanes of the runs
};

PairRuns find_runs(const PairGraph& graph);

/// The runs of positive offsets: every pair once, from its lower node.
PairRuns upward(const PairRuns& runs);

/// Pairs of the nodes of block b at each of its offsets.
/// @param pair [8 * chunks of the block] lane by lane; -1 where a node has no such neighbour
void pairs_of_block(const PairGraph& graph,
                    const PairRuns& runs,
                    std::int64_t b,
                    std::vector<std::int64_t>& pair);

}  // namespace diptych::scheme
