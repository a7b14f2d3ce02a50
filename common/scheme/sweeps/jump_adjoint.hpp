#pragma once
/// The other half of a dissipation that is symmetric (notes 3.4). The jump of the linear
/// reconstruction is r_ab = v_b - v_a - 1/2 (L_a + L_b) X_ab, and D_ab = K_ab r_ab on a, -D_ab on b
/// is half of what conjugates the power sum r_ab . K_ab r_ab >= 0: since L is a sum over pairs,
/// too, the rest is that of a stress
///   P_a <- P_a - N_a/Omega_a,   N_a = 1/2 sum_b D_ab (x) X_ab,
/// in (18a), which keeps momentum like any other. The sums here are 4 N_a, of pairs worked once in
/// runs, of those of each node in rows. Test: tests/common/scheme/sweeps_test.cpp

#include "common/scheme/sweeps/momentum_rows.hpp"
#include "common/scheme/sweeps/momentum_runs.hpp"

namespace diptych::scheme {

/// 2 D_ab (x) X_ab of eight pairs, which is that of b, too: use(k, component), row-major.
template <int Dim, class T, class Positions, class Use>
DIPTYCH_INLINE void for_moments(const Vector<T>& D, const Positions& positions, const Use& use) {
#pragma GCC unroll 3
  for (int j = 0; j < Dim; ++j) {
    const T X_ab = positions.neighbour(j) - positions.own(j);
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i)
      use(i * Dim + j, D[i] * X_ab);
  }
}

/// Rows: N/Omega of the nodes of block b.
template <InstructionSet isa, class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void put_moments_of_block(const MomentumSweep<Dim>& sweep, std::int64_t b) {
  using T = algebra::Pack<Real>;
  Lanes of_block[Dim * Dim];
  for (int lane = 0; lane < n_lanes; ++lane) {
    T sum[Dim * Dim] = {};
    for_pairs_of_node<isa, Real, Dim, kind>(
        sweep, b * n_lanes + lane,
        [&](const auto& pair, const auto& pairs, const auto& positions, const auto& frames,
            const auto& plain) DIPTYCH_INLINE_LAMBDA {
          const auto of_pairs =
              dissipation_of<Dim, kind, has_H>(sweep, pair, pairs, positions, frames, plain);
          for_moments<Dim>(of_pairs.D, positions,
                           [&](int k, const T& moment) DIPTYCH_INLINE_LAMBDA { sum[k] += moment; });
        });
    for (int k = 0; k < Dim * Dim; ++k)
      of_block[k][lane] = algebra::lane_sum(sum[k]);
  }
  const Lanes scale = 0.25 * algebra::load(sweep.body.graph.inverse_Omega.data() + b * n_lanes);
  sweep.body.moments.template put_each<Dim * Dim>(
      b, 0, [&](int k) DIPTYCH_INLINE_LAMBDA { return scale * of_block[k]; });
}

/// Runs: 4 N of the pairs of block b with nodes above it, added to the sums of both.
template <class T, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void add_moments_of_block(const MomentumSweep<Dim>& sweep, std::int64_t b) {
  using Real = algebra::Element<T>;
  const MutualPairs<Dim>& mutual = sweep.body.graph.mutual;
  const std::int64_t stride = sweep.body.moments.component_stride();
  Real* const own_sums = sweep.body.moments.template origin<Real>() + b * n_lanes;
  T sum[Dim * Dim] = {};
  typename GeometryArray<MutualGeometry, Dim>::Cursor geometry[1] = {};
  const std::int64_t begin = mutual.row[b], end = mutual.row[b + 1];
  if (begin == end) return;
  geometry[0] = {mutual.geometry, mutual.first[b]};
  for (std::int64_t chunk = begin; chunk < end; ++chunk) {
    const std::int64_t offset = mutual.offset.data()[chunk];
    read_pairs<T, Dim, kind>(sweep, b, offset, geometry,
                             [&](const auto& pair, const auto& pairs, const auto& positions,
                                 const auto& frames, const auto& plain) DIPTYCH_INLINE_LAMBDA {
                               const auto of_pairs = dissipation_of<Dim, kind, has_H>(
                                   sweep, pair, pairs, positions, frames, plain);
                               for_moments<Dim>(of_pairs.D, positions,
                                                [&](int k, const T& moment) DIPTYCH_INLINE_LAMBDA {
                                                  sum[k] += moment;
                                                  add_to<T>(own_sums + offset + k * stride, moment);
                                                });
                             });
  }
  for (int k = 0; k < Dim * Dim; ++k)
    add_to<T>(own_sums + k * stride, sum[k]);
}

}  // namespace diptych::scheme
