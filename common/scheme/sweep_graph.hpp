#pragma once
/// The pair graph as the sweeps read it: each node's row padded to chunks of eight pairs (a lane
/// each), one stream of memory per sweep with the neighbour indices beside the geometry. Padding
/// pairs the node with itself, with zero area.
///
/// Per pair in 3-D the strain-rate sweep streams 28 bytes and the momentum sweep 68. What only
/// scales and directs the dissipation (S_ab and its length) is kept in single precision: S_ba =
/// -S_ab holds exactly, and the jump that it multiplies is exact, so no identity is touched.

#include "common/algebra/field.hpp"
#include "common/scheme/pair_graph.hpp"

#include <cstdint>

namespace diptych::scheme {

/// Eight pairs (a, b_0..7) of one node a, for the strain rates.
template <int Dim>
struct StrainPairs {
  double C_ab[Dim][algebra::n_lanes];  ///< m^2
  std::int32_t neighbour[algebra::n_lanes];
};

/// The same pairs for the forces.
template <int Dim>
struct ForcePairs {
  double C_ba[Dim][algebra::n_lanes];  ///< m^2
  double X_ab[Dim][algebra::n_lanes];  ///< m, X_b - X_a
  float S_ab[Dim][algebra::n_lanes];   ///< m^2, 1/2 (C_ab - C_ba)
  float area[algebra::n_lanes];        ///< m^2, |S_ab|
  std::int32_t neighbour[algebra::n_lanes];
};

template <int Dim>
struct SweepGraph {
  std::int64_t n_nodes = 0, n_blocks = 0, n_pairs = 0;
  algebra::AlignedArray<std::int64_t> row;  ///< [n_blocks * 8 + 1] into chunks
  algebra::AlignedArray<StrainPairs<Dim>> strain_pairs;
  algebra::AlignedArray<ForcePairs<Dim>> force_pairs;
  algebra::AlignedArray<double> inverse_Omega;  ///< [n_blocks * 8] 1/m^3, 0 in the padding
  algebra::AlignedArray<double> Omega;          ///< [n_blocks * 8] m^3, 0 in the padding
  algebra::BlockField C_sum;                    ///< [n_nodes][Dim] sum_b C_ab

  explicit SweepGraph(const PairGraph& graph);
  std::int64_t bytes() const;
};

extern template struct SweepGraph<2>;
extern template struct SweepGraph<3>;

}  // namespace diptych::scheme
