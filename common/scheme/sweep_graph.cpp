#include "common/scheme/sweep_graph.hpp"

namespace diptych::scheme {

using algebra::n_lanes;

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph)
    : n_nodes(graph.n_nodes()),
      n_blocks(algebra::n_blocks_of(graph.n_nodes())),
      n_pairs(graph.n_pairs()),
      row(n_blocks * n_lanes + 1),
      inverse_Omega(n_blocks * n_lanes),
      Omega(n_blocks * n_lanes),
      C_sum(graph.n_nodes(), Dim) {
  for (std::int64_t a = 0; a < n_blocks * n_lanes; ++a) {
    const std::int64_t n = a < n_nodes ? graph.row[a + 1] - graph.row[a] : 0;
    row[a + 1] = row[a] + (n + n_lanes - 1) / n_lanes;
  }
  strain_pairs = algebra::AlignedArray<StrainPairs<Dim>>(row[n_blocks * n_lanes]);
  force_pairs = algebra::AlignedArray<ForcePairs<Dim>>(row[n_blocks * n_lanes]);
  for (std::int64_t a = 0; a < n_nodes; ++a) {
    Omega[a] = graph.Omega[a];
    inverse_Omega[a] = 1 / graph.Omega[a];
    for (std::int64_t c = row[a]; c < row[a + 1]; ++c) {
      for (int l = 0; l < n_lanes; ++l) {
        strain_pairs[c].neighbour[l] = force_pairs[c].neighbour[l] = static_cast<std::int32_t>(a);
      }
    }
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      const std::int64_t position = k - graph.row[a];
      StrainPairs<Dim>& strain = strain_pairs[row[a] + position / n_lanes];
      ForcePairs<Dim>& force = force_pairs[row[a] + position / n_lanes];
      const int l = static_cast<int>(position % n_lanes);
      const std::int32_t b = graph.neighbour[k];
      const Vec3& C_ab = graph.C[k];
      const Vec3& C_ba = graph.C[graph.reverse[k]];
      const Vec3 S_ab = 0.5 * (C_ab - C_ba), X_ab = graph.X[b] - graph.X[a];
      for (int i = 0; i < Dim; ++i) {
        strain.C_ab[i][l] = C_ab[i];
        force.C_ba[i][l] = C_ba[i];
        force.X_ab[i][l] = X_ab[i];
        force.S_ab[i][l] = static_cast<float>(S_ab[i]);
        C_sum.at(a, i) += C_ab[i];
      }
      force.area[l] = static_cast<float>(S_ab.norm());
      strain.neighbour[l] = force.neighbour[l] = b;
    }
  }
}

template <int Dim>
std::int64_t SweepGraph<Dim>::bytes() const {
  return strain_pairs.size() *
             static_cast<std::int64_t>(sizeof(StrainPairs<Dim>) + sizeof(ForcePairs<Dim>)) +
         row.size() * 8 + 2 * Omega.size() * 8 + C_sum.bytes();
}

template struct SweepGraph<2>;
template struct SweepGraph<3>;

}  // namespace diptych::scheme
