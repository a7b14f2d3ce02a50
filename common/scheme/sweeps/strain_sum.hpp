#pragma once
/// The pair sum of the strain rates (18b), Omega_a dF_a/dt = sum_b 1/2 (v_b - v_a) (x) C_ab: the
/// formula once (sum_gradients), and how its pairs are walked in rows and in runs.
///
/// Cost per directed pair in 3-D: 9 multiply-adds and 3 subtractions on 32 bytes gathered and at
/// most 28 of geometry (double precision).

#include "common/scheme/body/body.hpp"
#include "common/scheme/sweeps/pair_access.hpp"

namespace diptych::scheme {

/// sum_b (v_b - v_a) (x) C_ab over n chunks, lane by lane.
/// @param geometry  cursor over C_ab
/// @param pairs     pairs(k): of v, of chunk k < n
template <int Dim, class T, class Cursor, class Pairs>
DIPTYCH_INLINE void sum_gradients(std::int64_t n,
                                  Cursor geometry,
                                  const Pairs& pairs,
                                  T (&sum)[Dim * Dim]) {
#pragma GCC unroll 9
  for (int k = 0; k < Dim * Dim; ++k)
    sum[k] = T{};
  for (std::int64_t chunk = 0; chunk < n; ++chunk) {
    T C_ab[Dim];
    geometry.next(C_ab);
    const auto v = pairs(chunk);
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      const T jump = v.neighbour(i) - v.own(i);
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        sum[i * Dim + j] += jump * C_ab[j];
    }
  }
}

/// The same for the eight nodes of block b, in runs. @tparam Graph  SweepGraph or SlopeGraph
template <int Dim, class T, class Cursor, template <int> class Graph>
DIPTYCH_INLINE void sum_gradients_of_runs(const Graph<Dim>& graph,
                                          const NodeTable& velocity,
                                          std::int64_t b,
                                          const Cursor& geometry,
                                          T (&sum)[Dim * Dim]) {
  const std::int64_t first = graph.row[b];
  sum_gradients<Dim>(
      graph.row[b + 1] - first, geometry,
      [&](std::int64_t k) DIPTYCH_INLINE_LAMBDA {
        return RunPairs<T>(velocity, b, graph.offset.data()[first + k]);
      },
      sum);
}

/// C_ab, or weights of slopes, of the chunks of a unit.
template <int Dim>
DIPTYCH_INLINE auto geometry_from(const SweepGraph<Dim>& graph, std::int64_t first) {
  return VectorCursor<Dim>(graph.strain, first);
}
template <int Dim>
DIPTYCH_INLINE auto geometry_from(const SlopeGraph<Dim>& graph, std::int64_t first) {
  return SlopeCursor<Dim>{graph.weights.data() + first};
}

/// The same for the eight nodes of block b, in either arrangement, of a table in the precision of
/// Real.
template <InstructionSet isa, class Real, int Dim, template <int> class Graph>
DIPTYCH_INLINE void sum_gradients_of_block(const Graph<Dim>& graph,
                                           const NodeTable& velocity,
                                           std::int64_t b,
                                           Lanes (&L)[Dim * Dim]) {
  using T = algebra::Pack<Real>;
  T sum[Dim * Dim];
  if (velocity.arrangement() == Arrangement::runs) {
    sum_gradients_of_runs(graph, velocity, b, geometry_from(graph, graph.first[b]), sum);
#pragma GCC unroll 9
    for (int k = 0; k < Dim * Dim; ++k)
      L[k] = algebra::widened(sum[k]);
    return;
  }
  for (int lane = 0; lane < n_lanes; ++lane) {
    const std::int64_t a = b * n_lanes + lane, first = graph.row[a];
    sum_gradients<Dim>(
        graph.row[a + 1] - first, geometry_from(graph, graph.first[a]),
        [&](std::int64_t k) DIPTYCH_INLINE_LAMBDA {
          return vector_pairs_of<isa, Arrangement::rows, Real>(graph, velocity, a, first + k);
        },
        sum);
    for (int k = 0; k < Dim * Dim; ++k)
      L[k][lane] = algebra::lane_sum(sum[k]);
  }
}

/// dF/dt of the eight nodes of block b from sums over their pairs.
template <int Dim>
DIPTYCH_INLINE void scale_gradients(const SweepGraph<Dim>& graph,
                                    std::int64_t b,
                                    Lanes (&L)[Dim * Dim]) {
  const Lanes scale = 0.5 * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
#pragma GCC unroll 9
  for (int k = 0; k < Dim * Dim; ++k)
    L[k] *= scale;
}

/// dF/dt of the eight nodes of block b.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void strain_rates_of_block(const Body<Dim>& body,
                                          std::int64_t b,
                                          Lanes (&L)[Dim * Dim]) {
  if (body.is_single()) {
    sum_gradients_of_block<isa, float>(body.graph, body.v, b, L);
  } else {
    sum_gradients_of_block<isa, double>(body.graph, body.v, b, L);
  }
  scale_gradients(body.graph, b, L);
}

/// Slopes along lines of the eight nodes of block b.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void slopes_of_block(const Body<Dim>& body,
                                    std::int64_t b,
                                    Lanes (&slopes)[Dim * Dim]) {
  if (body.is_single()) {
    sum_gradients_of_block<isa, float>(body.graph.slopes, body.v, b, slopes);
  } else {
    sum_gradients_of_block<isa, double>(body.graph.slopes, body.v, b, slopes);
  }
}

/// dF/dt of block b, and of b + 1 where both can be summed at once: singles whose pairs are at the
/// same offsets.
/// @return number of blocks
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE int strain_rates_of_next(const Body<Dim>& body,
                                        std::int64_t b,
                                        std::int64_t end,
                                        Lanes (&L)[2][Dim * Dim]) {
  const SweepGraph<Dim>& graph = body.graph;
  const bool two =
      body.is_single() && body.in_runs() && b + 1 < end && same_offsets(graph.row, graph.offset, b);
  if (!two) {
    strain_rates_of_block<isa>(body, b, L[0]);
    return 1;
  }
  algebra::WideSingles sum[Dim * Dim];
  sum_gradients_of_runs(graph, body.v, b,
                        TwoCursors<Dim>(graph.strain, graph.first[b], graph.first[b + 1]), sum);
  for (int k = 0; k < Dim * Dim; ++k) {
    L[0][k] = algebra::widened(algebra::first_half(sum[k]));
    L[1][k] = algebra::widened(algebra::second_half(sum[k]));
  }
  scale_gradients(graph, b, L[0]);
  scale_gradients(graph, b + 1, L[1]);
  return 2;
}

}  // namespace diptych::scheme
