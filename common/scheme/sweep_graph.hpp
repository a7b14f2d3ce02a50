#pragma once
/// The pair graph as the sweeps read it: each node's row padded to chunks of eight pairs (a lane
/// each), geometry beside its neighbour indices. Padding pairs the node with itself, with zero
/// area.

#include "common/algebra/field.hpp"
#include "common/scheme/pair_graph.hpp"

#include <cstdint>

namespace diptych::scheme {

/// Eight pairs (a, b_0..7) of one node a.
template <int Dim>
struct PairChunk {
  double C_ab[Dim][algebra::n_lanes];  ///< m^2
  double C_ba[Dim][algebra::n_lanes];  ///< m^2
  double X_ab[Dim][algebra::n_lanes];  ///< m, X_b - X_a
  double area[algebra::n_lanes];       ///< m^2, |1/2 (C_ab - C_ba)|
  std::int32_t neighbour[algebra::n_lanes];
};

template <int Dim>
struct SweepGraph {
  std::int64_t n_nodes = 0, n_blocks = 0, n_pairs = 0;
  algebra::AlignedArray<std::int64_t> row;  ///< [n_blocks * 8 + 1] into chunks
  algebra::AlignedArray<PairChunk<Dim>> chunks;
  algebra::AlignedArray<double> inverse_Omega;  ///< [n_blocks * 8] 1/m^3, 0 in the padding
  algebra::AlignedArray<double> Omega;          ///< [n_blocks * 8] m^3, 0 in the padding
  algebra::BlockField C_sum;                    ///< [n_nodes][Dim] sum_b C_ab

  explicit SweepGraph(const PairGraph& graph);
  std::int64_t bytes() const;
};

extern template struct SweepGraph<2>;
extern template struct SweepGraph<3>;

}  // namespace diptych::scheme
