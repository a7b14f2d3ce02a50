#pragma once
/// The pair graph as the sweeps read it: each node's row padded to chunks of eight pairs (a lane
/// each). Padding pairs the node with itself, with zero area.
///
/// Geometry stands once for all nodes whose rows are translates of each other (row_classes.hpp): on
/// lattices it stays in the cache, elsewhere it is a stream of memory beside the neighbours. X_b -
/// X_a is made from the positions, which are gathered like the velocities. Per pair in 3-D the
/// strain-rate sweep streams 28 bytes at most and the momentum sweep 44; 4 where all is shared.
/// What only scales and directs the dissipation (S_ab and its length) is kept in single precision:
/// S_ba = -S_ab holds exactly, and the jump that it multiplies is exact, so no identity is touched.

#include "common/algebra/field.hpp"
#include "common/scheme/pair_graph.hpp"

#include <cstdint>

namespace diptych::scheme {

/// v or X of a node, padded to four (3-D) or two doubles, for gathers.
template <int Dim>
inline constexpr int vector_stride = Dim == 3 ? 4 : 2;

/// The neighbours b_0..7 of eight pairs of one node a.
struct Neighbours {
  std::int32_t node[algebra::n_lanes];
};

/// Of the same pairs: for the strain rates,
template <int Dim>
struct StrainGeometry {
  double C_ab[Dim][algebra::n_lanes];  ///< m^2
};

/// for the internal forces,
template <int Dim>
struct ForceGeometry {
  double C_ba[Dim][algebra::n_lanes];  ///< m^2
};

/// for dissipation and face correction.
template <int Dim>
struct FaceGeometry {
  float S_ab[Dim][algebra::n_lanes];  ///< m^2, 1/2 (C_ab - C_ba)
  float area[algebra::n_lanes];       ///< m^2, |S_ab|
};

template <int Dim>
struct SweepGraph {
  std::int64_t n_nodes = 0, n_blocks = 0, n_pairs = 0;
  algebra::AlignedArray<std::int64_t> row;       ///< [n_blocks * 8 + 1] into neighbours
  algebra::AlignedArray<Neighbours> neighbours;  ///< by row
  algebra::AlignedArray<std::int64_t> first;     ///< [n_blocks * 8] into the geometry
  algebra::AlignedArray<StrainGeometry<Dim>> strain;
  algebra::AlignedArray<ForceGeometry<Dim>> force;
  algebra::AlignedArray<FaceGeometry<Dim>> face;
  algebra::AlignedArray<double> X;              ///< [n_nodes][vector_stride] m
  algebra::AlignedArray<double> inverse_Omega;  ///< [n_blocks * 8] 1/m^3, 0 in the padding
  algebra::AlignedArray<double> Omega;          ///< [n_blocks * 8] m^3, 0 in the padding
  algebra::BlockField C_sum;                    ///< [n_nodes][Dim] sum_b C_ab

  explicit SweepGraph(const PairGraph& graph);
  std::int64_t bytes() const;
};

/// Chunks ahead of the work that the sweeps ask memory for: the processor's own prefetching stops
/// at pages.
inline constexpr std::int64_t chunks_ahead = 8;

template <class Chunk>
__attribute__((always_inline)) inline void prefetch(const Chunk* chunk) {
  const char* bytes = reinterpret_cast<const char*>(chunk);
#pragma GCC unroll 8
  for (size_t i = 0; i < sizeof(Chunk); i += 64)
    __builtin_prefetch(bytes + i);
}

extern template struct SweepGraph<2>;
extern template struct SweepGraph<3>;

}  // namespace diptych::scheme
