#pragma once
/// Face correction with its exact adjoint (notes 3.8). The face value 1/2 (v_a +
/// v_b) of the strain rates becomes 1/2 (v_a + v_b) + kappa_f (L_a - L_b) X_ab, which gives
///   L'_a = L_a + kappa_f/Omega_a sum_b [(L_a - L_b) X_ab] (x) S_ab,
/// and the force takes, instead of P,
///   P'_a = P_a + kappa_f/Omega_a sum_b [(P_a - P_b) S_ab] (x) X_ab,
/// the transpose of the same operator: sum Omega P:L' = sum Omega P':L for all L and P. So energy
/// duality, momentum and, since F evolves with L', torque identities hold as without it. The
/// adjoint is the same sweep with X and S exchanged. kappa_f = 1/6: first derivatives of fourth
/// order on a lattice; 1/8: exact face values of quadratics. Test:
/// tests/common/scheme/face_correction_test.cpp.

#include "common/scheme/body/body.hpp"
#include "common/scheme/sweeps/pair_access.hpp"

namespace diptych::scheme {

/// Which side of the duality a sweep works on.
enum class Side { rates, stress };

/// sum_b [(Q_a - Q_b) x] (x) y over the pairs of a unit, row-major, lane by lane.
/// @param tensors  Q: uncorrected dF/dt, or P
template <InstructionSet isa, Arrangement arrangement, class Real, Side side, int Dim>
DIPTYCH_INLINE void sum_correction(const SweepGraph<Dim>& graph,
                                   const NodeTable& tensors,
                                   std::int64_t unit,
                                   Lanes (&total)[Dim * Dim]) {
  using T = algebra::Pack<Real>;
  T sum[Dim * Dim] = {};
  const std::int64_t begin = graph.row[unit], end = graph.row[unit + 1];
  FaceCursor<Dim> geometry(graph, graph.first[unit]);
  for (std::int64_t chunk = begin; chunk < end; ++chunk) {
    T S_ab[Dim];
    geometry.next(S_ab);
    const auto Q = pairs_of<isa, arrangement, Real, Dim * Dim, tensor_stride<Dim>>(graph, tensors,
                                                                                   unit, chunk);
    const auto X = vector_pairs_of<isa, arrangement, Real>(graph, graph.X, unit, chunk);
    T x[Dim], y[Dim];
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      const T X_ab = X.neighbour(i) - X.own(i);
      x[i] = side == Side::rates ? X_ab : S_ab[i];
      y[i] = side == Side::rates ? S_ab[i] : X_ab;
    }
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      T w{};
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        w += (Q.own(i * Dim + j) - Q.neighbour(i * Dim + j)) * x[j];
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        sum[i * Dim + j] += w * y[j];
    }
  }
#pragma GCC unroll 9
  for (int k = 0; k < Dim * Dim; ++k)
    total[k] = algebra::widened(sum[k]);
}

/// Of the eight nodes of block b.
template <InstructionSet isa, class Real, Side side, int Dim>
DIPTYCH_INLINE void sum_correction_of_block(const SweepGraph<Dim>& graph,
                                            const NodeTable& tensors,
                                            std::int64_t b,
                                            Lanes (&sum)[Dim * Dim]) {
  if (graph.shape.arrangement == Arrangement::runs) {
    sum_correction<isa, Arrangement::runs, Real, side>(graph, tensors, b, sum);
  } else {
    for (int lane = 0; lane < n_lanes; ++lane) {
      Lanes of_node[Dim * Dim];
      sum_correction<isa, Arrangement::rows, Real, side>(graph, tensors, b * n_lanes + lane,
                                                         of_node);
      for (int k = 0; k < Dim * Dim; ++k)
        sum[k][lane] = algebra::lane_sum(of_node[k]);
    }
  }
}

/// Corrected tensors of block b: Q_a + kappa_f/Omega_a sum_b [(Q_a - Q_b) x] (x) y.
template <InstructionSet isa, Side side, int Dim>
DIPTYCH_INLINE void corrected_block(const SweepGraph<Dim>& graph,
                                    const NodeTable& tensors,
                                    double kappa_f,
                                    std::int64_t b,
                                    Lanes (&corrected)[Dim * Dim]) {
  Lanes sum[Dim * Dim];
  if (tensors.is_single()) {
    sum_correction_of_block<isa, float, side>(graph, tensors, b, sum);
  } else {
    sum_correction_of_block<isa, double, side>(graph, tensors, b, sum);
  }
  const Lanes scale = kappa_f * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
  tensors.get_each<Dim * Dim>(b, 0, [&](int k, const Lanes& Q) DIPTYCH_INLINE_LAMBDA {
    corrected[k] = Q + scale * sum[k];
  });
}

/// Records of the nodes of blocks [begin, end): P <- P' from state.stresses.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void correct_stresses(Body<Dim>& body,
                                     double kappa_f,
                                     std::int64_t begin,
                                     std::int64_t end) {
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    Lanes P[Dim * Dim];
    corrected_block<isa, Side::stress>(body.graph, body.stresses, kappa_f, b, P);
    body.records.template put_each<Dim * Dim>(b, NodeRecord<Dim>::P,
                                              [&](int k) DIPTYCH_INLINE_LAMBDA { return P[k]; });
  }
}

/// By how much the correction raises the largest frequency of a lattice, and so lowers the stable
/// step: max over theta of sin(theta) [1 + 2 kappa_f (1 - cos(theta))].
double frequency_factor(double kappa_f);

/// The two sweeps that the correction adds, over blocks [begin, end).
template <int Dim>
struct FaceCorrectionSweeps {
  /// state.gradients <- dF/dt without correction, before the strain-rate sweep
  void (*gradients)(Body<Dim>& body, std::int64_t begin, std::int64_t end);
  /// P of the records <- P', before the momentum sweep
  void (*stresses)(Body<Dim>& body, double kappa_f, std::int64_t begin, std::int64_t end);
};

/// For this processor.
template <int Dim>
FaceCorrectionSweeps<Dim> face_correction_sweeps();

}  // namespace diptych::scheme
