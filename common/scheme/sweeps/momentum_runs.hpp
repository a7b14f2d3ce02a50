#pragma once
/// The momentum sweep of runs: every pair once, for both of its nodes. Part of momentum.hpp.

#include "common/scheme/sweeps/pair_forces.hpp"

namespace diptych::scheme {

/// sums[0..] += value
template <class T>
DIPTYCH_INLINE void add_to(algebra::Element<T>* sums, const T& value) {
  algebra::store(sums, algebra::load_as<T>(sums) + value);
}

/// A block whose pairs with nodes above it are being worked; of WideSingles two blocks, whose pairs
/// are at the same offsets.
template <int Dim, PairLimiter limiter, class T>
struct WorkedBlock {
  static constexpr int n_blocks = algebra::width_of<T> / n_lanes;
  std::int64_t b = 0, chunk = 0;
  typename GeometryArray<MutualGeometry, Dim>::Cursor geometry[n_blocks];
  SumsWith<Dim, limiter, T> sums;

  DIPTYCH_INLINE void begin(const MutualPairs<Dim>& mutual, std::int64_t block) {
    b = block;
    chunk = mutual.row[block];
    if (chunk == mutual.row[block + 1]) return;
    for (int k = 0; k < n_blocks; ++k)
      geometry[k] = {mutual.geometry, mutual.first[block + k]};
  }
};

template <int Dim, class T>
DIPTYCH_INLINE void next_geometry(
    typename GeometryArray<MutualGeometry, Dim>::Cursor (&geometry)[1],
    PairGeometry<Dim, T>& pair) {
  geometry[0].next([&](const auto& of_chunk) DIPTYCH_INLINE_LAMBDA {
    pair.area = algebra::load_as<T>(of_chunk.area);
    for (int i = 0; i < Dim; ++i) {
      pair.C_ab[i] = algebra::load_as<T>(of_chunk.C_ab[i]);
      pair.C_ba[i] = algebra::load_as<T>(of_chunk.C_ba[i]);
    }
  });
}
template <int Dim>
DIPTYCH_INLINE void next_geometry(
    typename GeometryArray<MutualGeometry, Dim>::Cursor (&geometry)[2],
    PairGeometry<Dim, algebra::WideSingles>& pair) {
  PairGeometry<Dim, algebra::SingleLanes> half[2];
  for (int k = 0; k < 2; ++k) {
    typename GeometryArray<MutualGeometry, Dim>::Cursor one[1] = {geometry[k]};
    next_geometry(one, half[k]);
    geometry[k] = one[0];
  }
  pair.area = algebra::joined(half[0].area, half[1].area);
  for (int i = 0; i < Dim; ++i) {
    pair.C_ab[i] = algebra::joined(half[0].C_ab[i], half[1].C_ab[i]);
    pair.C_ba[i] = algebra::joined(half[0].C_ba[i], half[1].C_ba[i]);
  }
}

/// Runs: use(geometry, records, positions, frames, v_b - v_a) of the next pairs of block b.
template <class T, int Dim, DissipationKind kind, class Cursors, class Use>
DIPTYCH_INLINE void read_pairs(const MomentumSweep<Dim>& sweep,
                               std::int64_t b,
                               std::int64_t offset,
                               Cursors& geometry,
                               const Use& use) {
  const RunPairs<T> pairs(sweep.body.records, b, offset);
  const RunPairs<T> positions(sweep.body.graph.X, b, offset);
  PairGeometry<Dim, T> pair;
  next_geometry(geometry, pair);
  for (int i = 0; i < Dim; ++i)
    pair.S[i] = pair.C_ab[i] - pair.C_ba[i];
  const Vector<T> plain = plain_jump<Dim>(RunPairs<T>(sweep.body.v, b, offset), 0);
  const auto frames = [&]() DIPTYCH_INLINE_LAMBDA {
    if constexpr (kind.reconstruction == Reconstruction::objective) {
      return RunPairs<T>(sweep.body.frames, b, offset);
    } else {
      return NoFrames{};
    }
  }();
  use(pair, pairs, positions, frames, plain);
}

/// Forces of the next n chunks of a block, added to its sums and taken from those of the others.
template <class T, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void work_chunks(const MomentumSweep<Dim>& sweep,
                                std::int64_t n,
                                WorkedBlock<Dim, kind.limiter, T>& block) {
  using Real = algebra::Element<T>;
  const SweepGraph<Dim>& graph = sweep.body.graph;
  const std::int64_t stride = sweep.body.T.component_stride();
  Real* const own_sums = sweep.body.T.template origin<Real>() + block.b * n_lanes;
  WorkedBlock<Dim, kind.limiter, T> work = block;
  auto& sums = work.sums;
  const std::int64_t end = work.chunk + n;
  for (; work.chunk < end; ++work.chunk) {
    const std::int64_t offset = graph.mutual.offset.data()[work.chunk];
    Real* const their_sums = own_sums + offset;
    read_pairs<T, Dim, kind>(sweep, work.b, offset, work.geometry,
                             [&](const auto& pair, const auto& pairs, const auto& positions,
                                 const auto& frames, const auto& plain) DIPTYCH_INLINE_LAMBDA {
                               const auto of_pairs = pair_forces<Dim, kind, has_H, Stresses::both>(
                                   sweep, pair, pairs, positions, frames, plain);
#pragma GCC unroll 3
                               for (int i = 0; i < Dim; ++i) {
                                 sums.force[i] += of_pairs.force[i];
                                 add_to<T>(their_sums + i * stride, -of_pairs.force[i]);
                               }
                               sums.power += of_pairs.power;
                               if constexpr (kind.limiter != PairLimiter::none)
                                 sums.limited += of_pairs.limited;
                               if (sweep.with_bound) {
                                 sums.rate += rate_of<Dim, T>(pair.C_ab, pairs);
                                 add_to<T>(their_sums + Dim * stride,
                                           rate_of<Dim, T>(pair.C_ba, pairs));
                               }
                             });
  }
  block = work;
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

/// Blocks that are worked together at most: more find no more lines in the first cache.
inline constexpr int most_blocks_together = 4;

/// Forces of the pairs of blocks b, b + 1, .. b + n_blocks - 1, which are at the same offsets, with
/// nodes above them, added to both: together, since their neighbours share cache lines.
/// @param n_blocks  as many as most_blocks_together at most; of WideSingles even
/// @param total     added to
template <class T, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void add_forces_of_blocks(const MomentumSweep<Dim>& sweep,
                                         std::int64_t b,
                                         int n_blocks,
                                         ChunkSums& total) {
  using Real = algebra::Element<T>;
  using Worked = WorkedBlock<Dim, kind.limiter, T>;
  const MutualPairs<Dim>& mutual = sweep.body.graph.mutual;
  const int n = n_blocks / Worked::n_blocks;
  Worked blocks[most_blocks_together / Worked::n_blocks];
  for (int k = 0; k < n; ++k)
    blocks[k].begin(mutual, b + k * Worked::n_blocks);
  const std::int64_t last = mutual.row[b + 1];
  while (blocks[0].chunk < last) {
    const std::int64_t n_chunks = consecutive_offsets(mutual, blocks[0].chunk, last);
    for (int k = 0; k < n; ++k)
      work_chunks<T, Dim, kind, has_H>(sweep, n_chunks, blocks[k]);
  }
  const std::int64_t stride = sweep.body.T.component_stride();
  for (int k = 0; k < n; ++k) {
    const auto& sums = blocks[k].sums;
    Real* const own_sums = sweep.body.T.template origin<Real>() + blocks[k].b * n_lanes;
    for (int i = 0; i < Dim; ++i)
      add_to<T>(own_sums + i * stride, sums.force[i]);
    if (sweep.with_bound) add_to<T>(own_sums + Dim * stride, sums.rate);
    total.power += 0.5 * algebra::lane_sum(sums.power);
    if constexpr (kind.limiter != PairLimiter::none)
      total.limited += algebra::lane_sum(sums.limited);
  }
}

/// Asks for what the pairs of the next blocks will be the first to read.
template <class Real, int Dim, bool exact>
DIPTYCH_INLINE void prefetch_layers(const MomentumSweep<Dim>& sweep, std::int64_t b, int n_blocks) {
  const MutualPairs<Dim>& mutual = sweep.body.graph.mutual;
  for_layers(mutual.row, mutual.offset, b, [&](std::int64_t offset) DIPTYCH_INLINE_LAMBDA {
    for (int k = 0; k < n_blocks; ++k) {
      prefetch_ahead<Real, NodeRecord<Dim>::n(exact)>(sweep.body.records, b + k, offset);
      prefetch_ahead<Real, Dim>(sweep.body.v, b + k, offset);
      prefetch_ahead<Real, Dim>(sweep.body.graph.X, b + k, offset);
      if (sweep.body.options.has_frames)
        prefetch_ahead<Real, NodeFrame<Dim>::n>(sweep.body.frames, b + k, offset);
    }
  });
}

/// Runs: forces of the pairs of the next blocks of [b, end) with nodes above them, added to both.
/// Moves b on and adds to `total`.
template <class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void add_forces_of_next(const MomentumSweep<Dim>& sweep,
                                       std::int64_t& b,
                                       std::int64_t end,
                                       ChunkSums& total) {
  const MutualPairs<Dim>& mutual = sweep.body.graph.mutual;
  int n_blocks = 1;
  while (n_blocks < most_blocks_together && b + n_blocks < end &&
         same_offsets(mutual.row, mutual.offset, b + n_blocks - 1))
    ++n_blocks;
  prefetch_layers<Real, Dim, kind.impedance == Impedance::exact>(sweep, b, n_blocks);
  const std::int64_t first = b;
  b += n_blocks;
  if constexpr (std::is_same_v<Real, float>) {
    const int n_wide = n_blocks / 2 * 2;
    if (n_wide > 0) {
      add_forces_of_blocks<algebra::WideSingles, Dim, kind, has_H>(sweep, first, n_wide, total);
    }
    if (n_wide == n_blocks) return;
    add_forces_of_blocks<algebra::SingleLanes, Dim, kind, has_H>(sweep, first + n_wide, 1, total);
  } else {
    add_forces_of_blocks<Lanes, Dim, kind, has_H>(sweep, first, n_blocks, total);
  }
}

}  // namespace diptych::scheme
