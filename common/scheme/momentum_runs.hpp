#pragma once
/// The momentum sweep of runs: every pair once, for both of its nodes. Part of momentum.hpp.

#include "common/scheme/pair_forces.hpp"

namespace diptych::scheme {

/// sums[0..7] += value
template <class Real>
DIPTYCH_INLINE void add_to(Real* sums, const algebra::Pack<Real>& value) {
  algebra::store(sums, algebra::load_as<algebra::Pack<Real>>(sums) + value);
}

/// Runs: a block whose pairs with nodes above it are being worked.
template <int Dim, class T>
struct WorkedBlock {
  std::int64_t b = 0, chunk = 0;
  typename GeometryArray<MutualGeometry, Dim>::Cursor geometry;
  NodeSums<Dim, T> sums;
  DIPTYCH_INLINE void begin(const MutualPairs<Dim>& mutual, std::int64_t block) {
    b = block;
    chunk = mutual.row[block];
    if (chunk < mutual.row[block + 1]) geometry = {mutual.geometry, mutual.first[block]};
  }
};

/// Forces of the next n chunks of a block, added to its sums and taken from those of the others.
template <class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void work_chunks(const MomentumSweep<Dim>& sweep,
                                std::int64_t n,
                                WorkedBlock<Dim, algebra::Pack<Real>>& block) {
  using T = algebra::Pack<Real>;
  using Record = NodeRecord<Dim>;
  const SweepGraph<Dim>& graph = sweep.graph;
  const std::int64_t stride = sweep.state.T.component_stride();
  Real* const own_sums = sweep.state.T.template origin<Real>() + block.b * n_lanes;
  NodeSums<Dim, T> sums = block.sums;
  auto geometry = block.geometry;
  const std::int64_t end = block.chunk + n;
  for (std::int64_t chunk = block.chunk; chunk < end; ++chunk) {
    const std::int64_t offset = graph.mutual.offset.data()[chunk];
    const RunPairs<Real> pairs(sweep.state.records, block.b, offset);
    const RunPairs<Real> positions(graph.X, block.b, offset);
    PairFace<Dim, T> face;
    Vector<T> C_ab{}, C_ba{};
    geometry.next([&](const auto& of_chunk) DIPTYCH_INLINE_LAMBDA {
      face.area = algebra::load_as<T>(of_chunk.area);
      for (int i = 0; i < Dim; ++i) {
        C_ab[i] = algebra::load_as<T>(of_chunk.C_ab[i]);
        C_ba[i] = algebra::load_as<T>(of_chunk.C_ba[i]);
      }
    });
    for (int i = 0; i < Dim; ++i)
      face.S[i] = C_ab[i] - C_ba[i];
    const Vector<T> plain = plain_jump<Dim>(RunPairs<Real>(sweep.state.v, block.b, offset), 0);
    const Vector<T> D = dissipation_of<Dim, kind, has_H>(sweep, face, pairs, positions, plain);
    Real* const their_sums = own_sums + offset;
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      T force = D[i];
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j) {
        const int ij = Record::P + i * Dim + j;
        force += pairs.own(ij) * C_ab[j];
        force -= pairs.neighbour(ij) * C_ba[j];
      }
      sums.force[i] += force;
      add_to<Real>(their_sums + i * stride, -force);
      sums.power += plain[i] * D[i];
    }
    if (sweep.with_bound) {
      sums.rate += rate_of<Dim, T>(C_ab, pairs);
      add_to<Real>(their_sums + Dim * stride, rate_of<Dim, T>(C_ba, pairs));
    }
  }
  block.sums = sums;
  block.geometry = geometry;
  block.chunk = end;
}

/// Chunks from c on, before `end`, whose offsets are consecutive: they read the same cache lines.
template <int Dim>
DIPTYCH_INLINE std::int64_t consecutive_offsets(const MutualPairs<Dim>& mutual,
                                                std::int64_t c,
                                                std::int64_t end) {
  const std::int32_t* offset = mutual.offset.data();
  std::int64_t n = 1;
  while (c + n < end && offset[c + n] == offset[c] + n)
    ++n;
  return n;
}

/// Nodes between two pairs of a block beyond which the records of the nearer have left the second
/// cache since the farther read them.
inline constexpr std::int64_t far_apart = 2000;

/// Blocks that are worked together at most: more find no more lines in the first cache.
inline constexpr int most_blocks_together = 4;

/// Whether the pairs of blocks b and b + 1 are at the same offsets.
template <int Dim>
DIPTYCH_INLINE bool same_offsets(const MutualPairs<Dim>& mutual, std::int64_t b) {
  const std::int64_t first = mutual.row[b], next = mutual.row[b + 1], n = next - first;
  return mutual.row[b + 2] - next == n &&
         __builtin_memcmp(mutual.offset.data() + first, mutual.offset.data() + next,
                          static_cast<size_t>(n) * sizeof(std::int32_t)) == 0;
}

/// Runs: forces of the pairs of the next blocks of [b, end) with nodes above them, added to both:
/// of blocks together whose pairs are at the same offsets, since their neighbours share cache
/// lines.
/// @return their numerical dissipation [W]; moves b on
template <class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE double add_forces_of_next(const MomentumSweep<Dim>& sweep,
                                         std::int64_t& b,
                                         std::int64_t end) {
  using Record = NodeRecord<Dim>;
  constexpr bool exact = kind.impedance == Impedance::exact;
  const SweepGraph<Dim>& graph = sweep.graph;
  const MutualPairs<Dim>& mutual = graph.mutual;
  int n_blocks = 1;
  while (n_blocks < most_blocks_together && b + n_blocks < end &&
         same_offsets(mutual, b + n_blocks - 1))
    ++n_blocks;
  const std::int64_t last = mutual.row[b + 1];
  WorkedBlock<Dim, algebra::Pack<Real>> blocks[most_blocks_together];
  for (int k = 0; k < n_blocks; ++k)
    blocks[k].begin(mutual, b + k);
  for (std::int64_t c = blocks[0].chunk; c < last; ++c) {
    const std::int64_t offset = mutual.offset.data()[c];
    if (c + 1 < last && mutual.offset.data()[c + 1] - offset < far_apart) continue;
    for (int k = 0; k < n_blocks; ++k) {
      prefetch_ahead<Real, Record::n(exact)>(sweep.state.records, b + k, offset);
      prefetch_ahead<Real, Dim>(sweep.state.v, b + k, offset);
      prefetch_ahead<Real, Dim>(graph.X, b + k, offset);
    }
  }
  while (blocks[0].chunk < last) {
    const std::int64_t n = consecutive_offsets(mutual, blocks[0].chunk, last);
    for (int k = 0; k < n_blocks; ++k)
      work_chunks<Real, Dim, kind, has_H>(sweep, n, blocks[k]);
  }
  double power = 0;
  const std::int64_t stride = sweep.state.T.component_stride();
  for (int k = 0; k < n_blocks; ++k) {
    const auto& sums = blocks[k].sums;
    Real* const own_sums = sweep.state.T.template origin<Real>() + (b + k) * n_lanes;
    for (int i = 0; i < Dim; ++i)
      add_to<Real>(own_sums + i * stride, sums.force[i]);
    if (sweep.with_bound) add_to<Real>(own_sums + Dim * stride, sums.rate);
    power += 0.5 * algebra::lane_sum(algebra::widened(sums.power));
  }
  b += n_blocks;
  return power;
}

}  // namespace diptych::scheme
