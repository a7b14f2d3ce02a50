#pragma once
/// Face correction with its exact adjoint (physics note 3.8, point 4). The face value 1/2 (v_a +
/// v_b) of the strain rates becomes 1/2 (v_a + v_b) + kappa_f (L_a - L_b) X_ab, which gives
///   L'_a = L_a + kappa_f/Omega_a sum_b [(L_a - L_b) X_ab] (x) S_ab,
/// and the force takes, instead of P,
///   P'_a = P_a + kappa_f/Omega_a sum_b [(P_a - P_b) S_ab] (x) X_ab,
/// the transpose of the same operator: sum Omega P:L' = sum Omega P':L for all L and P. So energy
/// duality, momentum and, since F evolves with L', torque identities hold as without it. The
/// adjoint is the same sweep with X and S exchanged. kappa_f = 1/6: first derivatives of fourth
/// order on a lattice; 1/8: exact face values of quadratics. Test:
/// tests/common/scheme/face_correction_test.cpp.

#include "common/scheme/gather.hpp"
#include "common/scheme/state.hpp"
#include "common/scheme/sweep_graph.hpp"

namespace diptych::scheme {

/// Which side of the duality a sweep works on.
enum class Side { rates, stress };

/// Sums over the row of node a: [(Q_a - Q_b) x] (x) y, row-major, from tensors stored per node.
/// @param  tensors  [n_nodes][tensor_stride]
template <InstructionSet isa, Side side, int Dim>
DIPTYCH_INLINE void correction_of_node(const SweepGraph<Dim>& graph,
                                       const double* tensors,
                                       std::int64_t a,
                                       double (&correction)[Dim * Dim]) {
  constexpr int stride = tensor_stride<Dim>;
  const double* own = tensors + a * stride;
  const double* X = graph.X.data();
  const Neighbours* neighbours = graph.neighbours.data() + graph.row[a];
  const FaceGeometry<Dim>* geometry = graph.face.data() + graph.first[a];
  const std::int64_t n_chunks = graph.row[a + 1] - graph.row[a];
  Lanes sum[Dim * Dim] = {};
  for (std::int64_t c = 0; c < n_chunks; ++c) {
    prefetch(geometry + c + chunks_ahead);
    Lanes q[stride], X_b[4];
    gather_nodes<isa, Dim * Dim, stride>(tensors, neighbours[c], q);
    gather_nodes<isa, Dim, vector_stride<Dim>>(X, neighbours[c], X_b);
    Lanes x[Dim], y[Dim];
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      const Lanes X_ab = X_b[i] - X[a * vector_stride<Dim> + i];
      const Lanes S_ab = algebra::load(geometry[c].S_ab[i]);
      x[i] = side == Side::rates ? X_ab : S_ab;
      y[i] = side == Side::rates ? S_ab : X_ab;
    }
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      Lanes w{};
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        w += (own[i * Dim + j] - q[i * Dim + j]) * x[j];
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        sum[i * Dim + j] += w * y[j];
    }
  }
  for (int k = 0; k < Dim * Dim; ++k)
    correction[k] = algebra::lane_sum(sum[k]);
}

/// state.L of block b <- L' from state.gradients.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void correct_rates_of_block(const SweepGraph<Dim>& graph,
                                           State<Dim>& state,
                                           double kappa_f,
                                           std::int64_t b) {
  double* L = state.L.block(b);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const std::int64_t a = b * n_lanes + lane;
    double correction[Dim * Dim];
    correction_of_node<isa, Side::rates>(graph, state.gradients.data(), a, correction);
    const double* plain = state.gradients.data() + a * tensor_stride<Dim>;
    for (int k = 0; k < Dim * Dim; ++k) {
      L[k * n_lanes + lane] = plain[k] + kappa_f * graph.inverse_Omega[a] * correction[k];
    }
  }
}

/// Records of the nodes of blocks [begin, end): P <- P' from state.stresses.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void correct_stresses(const SweepGraph<Dim>& graph,
                                     State<Dim>& state,
                                     double kappa_f,
                                     std::int64_t begin,
                                     std::int64_t end) {
  const std::int64_t last = end * n_lanes < graph.n_nodes ? end * n_lanes : graph.n_nodes;
  for (std::int64_t a = begin * n_lanes; a < last; ++a) {
    double correction[Dim * Dim];
    correction_of_node<isa, Side::stress>(graph, state.stresses.data(), a, correction);
    double* P = state.records.data() + a * state.record_stride + NodeRecord<Dim>::P;
    const double* plain = state.stresses.data() + a * tensor_stride<Dim>;
    for (int k = 0; k < Dim * Dim; ++k) {
      P[k] = plain[k] + kappa_f * graph.inverse_Omega[a] * correction[k];
    }
  }
}

/// By how much the correction raises the largest frequency of a lattice, and so lowers the stable
/// step: max over theta of sin(theta) [1 + 2 kappa_f (1 - cos(theta))].
double frequency_factor(double kappa_f);

/// The two sweeps that the correction adds, over blocks [begin, end).
template <int Dim>
struct FaceCorrectionSweeps {
  /// state.gradients <- dF/dt without correction, before the strain-rate sweep
  void (*gradients)(const SweepGraph<Dim>& graph,
                    State<Dim>& state,
                    std::int64_t begin,
                    std::int64_t end);
  /// P of the records <- P', before the momentum sweep
  void (*stresses)(const SweepGraph<Dim>& graph,
                   State<Dim>& state,
                   double kappa_f,
                   std::int64_t begin,
                   std::int64_t end);
};

/// For this processor.
template <int Dim>
FaceCorrectionSweeps<Dim> face_correction_sweeps();

}  // namespace diptych::scheme
