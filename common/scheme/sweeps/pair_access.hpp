#pragma once
/// How sweeps read a table at the eight pairs of a chunk, the same for both arrangements:
///   pairs.neighbour(c)   component c of the nodes b, one per lane
///   pairs.own(c)         component c of the node a (rows: a number) or nodes a (runs: lanes)
/// A unit is what a row of chunks belongs to: a node in rows, a block of eight in runs.

#include "common/scheme/graph/sweep_graph.hpp"

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::Lanes;
using algebra::n_lanes;
using algebra::NodeTable;

/// Eight neighbours of one node, gathered.
template <InstructionSet isa, class Real, int n, int stride>
class GatheredPairs {
 public:
  using T = algebra::Pack<Real>;
  template <class Graph>
  DIPTYCH_INLINE GatheredPairs(const Graph& graph,
                               const NodeTable& table,
                               std::int64_t a,
                               std::int64_t chunk)
      : own_(table.origin<Real>() + a * stride) {
    const Real* row[n_lanes];
    for (int l = 0; l < n_lanes; ++l) {
      row[l] = table.origin<Real>() +
               static_cast<std::int64_t>(graph.neighbours.data()[chunk].node[l]) * stride;
    }
    algebra::gather<isa, n>(row, values_);
  }
  DIPTYCH_INLINE T neighbour(int c) const { return values_[c]; }
  DIPTYCH_INLINE Real own(int c) const { return own_[c]; }

 private:
  T values_[(n + 3) / 4 * 4];
  const Real* own_;
};

/// A neighbour of each of the eight or sixteen nodes from block b on, side by side.
template <class T_>
class RunPairs {
 public:
  using T = T_;
  using Real = algebra::Element<T>;
  DIPTYCH_INLINE RunPairs(const NodeTable& table, std::int64_t b, std::int64_t offset)
      : own_(table.origin<Real>() + b * n_lanes),
        neighbour_(own_ + offset),
        stride_(table.component_stride()) {}
  DIPTYCH_INLINE T neighbour(int c) const { return algebra::load_as<T>(neighbour_ + c * stride_); }
  DIPTYCH_INLINE T own(int c) const { return algebra::load_as<T>(own_ + c * stride_); }

 private:
  const Real *own_, *neighbour_;
  std::int64_t stride_;
};

/// Runs: whether the pairs of blocks b and b + 1 are at the same offsets.
DIPTYCH_INLINE bool same_offsets(const algebra::AlignedArray<std::int64_t>& row,
                                 const algebra::AlignedArray<std::int32_t>& offset,
                                 std::int64_t b) {
  const std::int64_t first = row[b], next = row[b + 1], n = next - first;
  return row[b + 2] - next == n &&
         __builtin_memcmp(offset.data() + first, offset.data() + next,
                          static_cast<size_t>(n) * sizeof(std::int32_t)) == 0;
}

/// Asks for n components of what the next blocks will be the first to read: the run farthest ahead.
/// The processor does not follow as many streams as there are components.
template <class Real, int n>
DIPTYCH_INLINE void prefetch_ahead(const NodeTable& table, std::int64_t b, std::int64_t offset) {
  const Real* ahead = table.origin<Real>() + (b + 4) * n_lanes + offset;
#pragma GCC unroll 8
  for (int c = 0; c < n; ++c)
    __builtin_prefetch(ahead + c * table.component_stride(), 0, 2);
}

/// Nodes between two pairs of a block beyond which what the nearer has read has left the second
/// cache since the farther read it.
inline constexpr std::int64_t far_apart = 2000;

/// Runs: use(offset) of the farthest pair of block b in every layer of neighbours that has left the
/// second cache: what the next blocks will be the first to read lies there.
template <class Use>
DIPTYCH_INLINE void for_layers(const algebra::AlignedArray<std::int64_t>& row,
                               const algebra::AlignedArray<std::int32_t>& offsets,
                               std::int64_t b,
                               const Use& use) {
  const std::int64_t end = row[b + 1];
  for (std::int64_t c = row[b]; c < end; ++c) {
    const std::int64_t offset = offsets[c];
    if (c + 1 < end && offsets[c + 1] - offset < far_apart) continue;
    use(offset);
  }
}

/// Asks, for writing, for n components of a block that will be written soon.
template <int n>
DIPTYCH_INLINE void prefetch_to_write(NodeTable& table, std::int64_t b) {
  table.visit([&](const auto* origin) DIPTYCH_INLINE_LAMBDA {
    const auto* ahead = origin + (b + 4) * n_lanes;
#pragma GCC unroll 8
    for (int c = 0; c < n; ++c)
      __builtin_prefetch(ahead + c * table.component_stride(), 1, 2);
  });
}

/// @tparam n       components that are read
/// @tparam stride  of the rows of the table
/// @tparam Graph   SweepGraph or SlopeGraph
template <InstructionSet isa, Arrangement arrangement, class Real, int n, int stride, class Graph>
DIPTYCH_INLINE auto pairs_of(const Graph& graph,
                             const NodeTable& table,
                             std::int64_t unit,
                             std::int64_t chunk) {
  if constexpr (arrangement == Arrangement::rows) {
    return GatheredPairs<isa, Real, n, stride>(graph, table, unit, chunk);
  } else {
    return RunPairs<algebra::Pack<Real>>(table, unit, graph.offset.data()[chunk]);
  }
}

/// The same of a table of vectors.
template <InstructionSet isa,
          Arrangement arrangement,
          class Real,
          int Dim,
          template <int>
          class Graph>
DIPTYCH_INLINE auto vector_pairs_of(const Graph<Dim>& graph,
                                    const NodeTable& table,
                                    std::int64_t unit,
                                    std::int64_t chunk) {
  return pairs_of<isa, arrangement, Real, Dim, vector_stride<Dim>>(graph, table, unit, chunk);
}

}  // namespace diptych::scheme
