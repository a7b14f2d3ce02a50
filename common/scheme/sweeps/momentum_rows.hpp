#pragma once
/// The momentum sweep of rows: every node sums over its own pairs. Part of momentum.hpp.

#include "common/scheme/sweeps/pair_forces.hpp"

namespace diptych::scheme {

/// Rows: use(geometry, records, positions, frames, v_b - v_a) of eight pairs of node a after the
/// other.
template <InstructionSet isa, class Real, int Dim, DissipationKind kind, class Use>
DIPTYCH_INLINE void for_pairs_of_node(const MomentumSweep<Dim>& sweep,
                                      std::int64_t a,
                                      const Use& use) {
  using T = algebra::Pack<Real>;
  using Record = NodeRecord<Dim>;
  constexpr bool exact = kind.impedance == Impedance::exact;
  constexpr auto rows = Arrangement::rows;
  const SweepGraph<Dim>& graph = sweep.body.graph;
  const PairArea* area = graph.area.data() + graph.first[a];
  FaceCursor<Dim> geometry(graph, graph.first[a]);
  for (std::int64_t chunk = graph.row[a]; chunk < graph.row[a + 1]; ++chunk, ++area) {
    prefetch(area + chunks_ahead);
    const auto pairs =
        pairs_of<isa, rows, Real, Record::n_row(exact), Record::template stride<Real>(exact)>(
            graph, sweep.body.records, a, chunk);
    const auto positions = vector_pairs_of<isa, rows, Real>(graph, graph.X, a, chunk);
    PairGeometry<Dim, T> pair;
    pair.area = algebra::load_as<T>(area->area);
    T C_ba[Dim], S_ab[Dim];
    geometry.next(S_ab, C_ba);
    for (int i = 0; i < Dim; ++i) {
      pair.S[i] = S_ab[i];
      pair.C_ba[i] = C_ba[i];
    }
    const Vector<T> plain = plain_jump<Dim>(pairs, Record::v(exact));
    const auto frames = [&]() DIPTYCH_INLINE_LAMBDA {
      using Frame = NodeFrame<Dim>;
      if constexpr (kind.reconstruction == Reconstruction::objective) {
        return pairs_of<isa, rows, Real, Frame::n, Frame::stride>(graph, sweep.body.frames, a,
                                                                  chunk);
      } else {
        return NoFrames{};
      }
    }();
    use(pair, pairs, positions, frames, plain);
  }
}

/// Rows: the sums of node a.
template <InstructionSet isa, class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE auto sums_of_node(const MomentumSweep<Dim>& sweep, std::int64_t a) {
  using T = algebra::Pack<Real>;
  SumsWith<Dim, kind.limiter, T> sums;
  for_pairs_of_node<isa, Real, Dim, kind>(
      sweep, a,
      [&](const auto& pair, const auto& pairs, const auto& positions, const auto& frames,
          const auto& plain) DIPTYCH_INLINE_LAMBDA {
        const auto of_pairs = pair_forces<Dim, kind, has_H, Stresses::of_neighbour>(
            sweep, pair, pairs, positions, frames, plain);
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i)
          sums.force[i] += of_pairs.force[i];
        sums.power += of_pairs.power;
        if constexpr (kind.limiter != PairLimiter::none) sums.limited += of_pairs.limited;
        if (sweep.with_bound) {
          Vector<T> C_ab{};
          for (int i = 0; i < Dim; ++i)
            C_ab[i] = 2.0 * pair.S[i] + pair.C_ba[i];
          sums.rate += rate_of<Dim, T>(C_ab, pairs);
        }
      });
  return sums;
}

/// Rows: forces on the eight nodes of block b, each over its pairs.
/// @param total  of their halves of the pairs; added to
template <InstructionSet isa, class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void forces_on_block(const MomentumSweep<Dim>& sweep,
                                    std::int64_t b,
                                    ChunkSums& total) {
  using Record = NodeRecord<Dim>;
  const SweepGraph<Dim>& graph = sweep.body.graph;
  NodeSums<Dim, Lanes> sums;
  for (int lane = 0; lane < n_lanes; ++lane) {
    const auto of_node = sums_of_node<isa, Real, Dim, kind, has_H>(sweep, b * n_lanes + lane);
    for (int i = 0; i < Dim; ++i)
      sums.force[i][lane] = algebra::lane_sum(of_node.force[i]);
    sums.power[lane] = algebra::lane_sum(of_node.power);
    sums.rate[lane] = algebra::lane_sum(of_node.rate);
    if constexpr (kind.limiter != PairLimiter::none)
      total.limited += 0.5 * algebra::lane_sum(of_node.limited);
  }
  for (int i = 0; i < Dim; ++i) {
    Lanes PC{};
    for (int j = 0; j < Dim; ++j) {
      PC += sweep.body.records.get(b, Record::P + i * Dim + j) * graph.C_sum.get(b, j);
    }
    sweep.body.T.put(b, i, 0.5 * (PC + sums.force[i]));
  }
  if (sweep.with_bound) {
    const Lanes rate = (0.5 / sweep.body.options.rho_R) * sums.rate *
                       algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int lane = 0; lane < n_lanes; ++lane)
      total.rate = algebra::larger(total.rate, rate[lane]);
  }
  total.power += 0.25 * algebra::lane_sum(sums.power);
}

}  // namespace diptych::scheme
