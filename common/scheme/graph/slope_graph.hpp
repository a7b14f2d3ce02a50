#pragma once
/// Slopes for the reconstruction of jumps other than dF/dt of (18b): G_a = sum_b (v_b - v_a) (x)
/// weight_ab over rows of their own, as pair sweeps read them (sweep_graph.hpp). Weights stand once
/// for all units that have the same. Test: tests/graphs/line_slopes_test.cpp

#include "common/algebra/node_table.hpp"
#include "common/algebra/shared_vectors.hpp"
#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <vector>

namespace diptych::scheme {

/// As a backend makes them; empty: the slopes are dF/dt.
struct SlopeRows {
  std::vector<std::int64_t> row;        ///< [n_nodes + 1]
  std::vector<std::int32_t> neighbour;  ///< [n_pairs] ascending in each row
  algebra::SharedVectors weight;        ///< [n_pairs] 1/m
  /// Of the pairs whose jumps they are for, the nearest neighbours: |metric (X_b - X_a)| <= 1. The
  /// others dissipate nothing then (dissipation_area.hpp).  [1/m]
  algebra::Mat3 metric = algebra::Mat3::Zero();

  bool empty() const { return row.empty(); }
  /// Largest |b - a|.
  std::int64_t reach() const;
};

/// The neighbours b_0..7 of eight pairs of one node a.
struct Neighbours {
  std::int32_t node[algebra::n_lanes];
};

/// Weights of eight pairs.
template <int Dim>
struct SlopeWeights {
  double component[Dim][algebra::n_lanes];  ///< 1/m
};

template <int Dim>
struct SlopeGraph {
  algebra::AlignedArray<std::int64_t> row;       ///< into chunks; by node (rows) or block (runs)
  algebra::AlignedArray<Neighbours> neighbours;  ///< rows: of each chunk; padded with the node
  algebra::AlignedArray<std::int32_t> offset;    ///< runs: b - a of each chunk
  algebra::AlignedArray<std::int64_t> first;     ///< into the weights; by node or block
  algebra::AlignedArray<SlopeWeights<Dim>> weights;

  SlopeGraph() = default;
  SlopeGraph(const SlopeRows& rows, algebra::Arrangement arrangement);
  bool empty() const { return row.size() == 0; }
  std::int64_t bytes() const {
    return row.bytes() + neighbours.bytes() + offset.bytes() + first.bytes() + weights.bytes();
  }
};

extern template struct SlopeGraph<2>;
extern template struct SlopeGraph<3>;

}  // namespace diptych::scheme
