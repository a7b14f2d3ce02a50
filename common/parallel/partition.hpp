#pragma once
/// Which rank owns which chunk of a body: a partitioner is a function of the graph of chunks. Menu:
/// partitioners(). Test: tests/common/parallel/partition_test.cpp

#include "common/base/registry.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych::parallel {

/// Chunks and the pairs between them, both ways.
struct ChunkGraph {
  std::vector<std::int64_t> work;             ///< [n_chunks] of a sweep, in pairs
  std::vector<std::int64_t> row;              ///< [n_chunks + 1] into neighbour and weight
  std::vector<std::int32_t> neighbour;        ///< ascending in each row, without the chunk itself
  std::vector<std::int64_t> weight;           ///< pairs between the two
  std::vector<std::array<double, 3>> centre;  ///< [n_chunks] m, mean place of the nodes

  std::int64_t n_chunks() const { return static_cast<std::int64_t>(work.size()); }
};

/// Owner of each chunk, 0 to n_parts - 1; the same for the same arguments.
/// @pre n_parts <= n_chunks
using Partitioner = std::vector<int> (*)(const ChunkGraph& graph, int n_parts);

/// "metis": few pairs between parts; "slab": consecutive chunks; "bisection": halves along the
/// longest side, again and again.
const base::Registry<Partitioner>& partitioners();

/// Largest work of a part over the mean.
double imbalance(const ChunkGraph& graph, const std::vector<int>& owner, int n_parts);

}  // namespace diptych::parallel
