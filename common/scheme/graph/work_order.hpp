#pragma once
/// In which order the chunks of runs are worked. It depends on the graph alone, and so do the sums.
///   - Segments of blocks are no shorter than the reach of a pair: what a segment adds to goes no
///     farther than into the next, so that all even ones can be worked at the same time, then all
///     odd ones.
///   - Inside a segment forces are summed as chunks are numbered, or, where the layers of the
///     numbering (planes of a lattice) do not fit into a second cache, tile by tile through its
///     layers: records of a tile stay there for the pairs of all layers that read them.
///   - A stage evaluates the records of a chunk just before the first forces that read them. (Of a
///     rank: ranks/run_work.hpp.)
/// Test: tests/common/scheme/work_order_test.cpp

#include "common/scheme/graph/pair_runs.hpp"

#include <span>

namespace diptych::scheme {

struct WorkOrder {
  std::int64_t segment = 0;  ///< blocks: a whole number of chunks of parallel::for_chunks
  std::int64_t layer = 0;    ///< nodes (layer_of)
  /// [n_chunks] as their forces are summed, segment by segment.
  std::vector<std::int32_t> forces;
  /// Of a stage, segment by segment: c stands for the forces of chunk c, ~c for its records. Those
  /// of even segments come before those of odd ones; what segments of the same parity evaluate and
  /// add to has nothing in common.
  std::vector<std::int32_t> stage;
  std::vector<std::int64_t> first;  ///< [n_segments + 1] into stage; neither on other ranks than 0

  /// Three smaller ones nearly fit a second cache of a megabyte (scheme/README.md).
  bool has_large_layers() const { return layer >= 2048; }
  std::int64_t n_segments() const;
  std::span<const std::int32_t> stage_of(std::int64_t s) const {
    return std::span(stage).subspan(first[s], first[s + 1] - first[s]);
  }
  std::span<const std::int32_t> forces_of(std::int64_t s) const;
  std::int64_t bytes() const {
    return std::ssize(forces) * 4 + std::ssize(stage) * 4 + std::ssize(first) * 8;
  }
};

/// @param upward  runs of positive offsets
WorkOrder work_order(const PairRuns& upward);

/// Chunks that the forces of chunk c read and add to, ascending, c among them.
/// @param row, offset  of upward runs
void find_reached(std::span<const std::int64_t> row,
                  std::span<const std::int32_t> offset,
                  std::int64_t c,
                  std::vector<std::int64_t>& reached);

/// Nodes of a layer of the numbering, as pairs with nodes above tell: of a plane of a lattice.
/// @return 0 where pairs have no layers
std::int64_t layer_of(const PairRuns& upward);

}  // namespace diptych::scheme
