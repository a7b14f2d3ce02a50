#pragma once
/// First pair sweep of an evaluation: strain rates (18b), Omega_a dF_a/dt = sum_b 1/2 (v_b - v_a)
/// (x) C_ab, then per node relaxation (14), stress (9) and wave speeds, left where the momentum
/// sweep reads them. (18c) and (18d) are pointwise in dF/dt and stand in the update.
///
/// Cost per directed pair in 3-D: 9 multiply-adds and 3 subtractions on 32 bytes gathered and at
/// most 28 of geometry.

#include "common/algebra/layout.hpp"
#include "common/physics/wave_speeds.hpp"
#include "common/scheme/face_correction.hpp"
#include "common/scheme/gather.hpp"
#include "common/scheme/pointwise.hpp"
#include "common/scheme/sweep_graph.hpp"
#include "common/scheme/update.hpp"

namespace diptych::scheme {

template <int Dim, class Material>
struct StrainRateSweep {
  const Model<Material>& model;
  const SweepGraph<Dim>& graph;
  State<Dim>& state;
  const Relaxation& relaxation;
  bool exact_impedance;
  bool with_dissipation;   ///< sum the viscous dissipation
  double face_correction;  ///< kappa_f, 0: none; else state.gradients hold the uncorrected dF/dt
  double drift;            ///< s, leapfrog: moves u, F, H, J by the new rates before the stress
  // results, one per chunk of parallel::for_chunks
  double* viscous_power;  ///< W
  double* least_J;        ///< NaN where a node has not J > 0
};

/// A compiled sweep over blocks [begin, end) of a chunk.
template <int Dim, class Material>
using StrainRateFunction = void (*)(const StrainRateSweep<Dim, Material>& sweep,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    std::int64_t chunk);

/// dF/dt of the eight nodes of block b, into state.L.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void strain_rates_of_block(const SweepGraph<Dim>& graph,
                                          State<Dim>& state,
                                          std::int64_t b) {
  constexpr int stride = vector_stride<Dim>;
  const double* velocity = state.velocity.data();
  double* L = state.L.block(b);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const std::int64_t a = b * n_lanes + lane;
    Lanes sum[Dim * Dim] = {};
    const Neighbours* neighbours = graph.neighbours.data() + graph.row[a];
    const StrainGeometry<Dim>* geometry = graph.strain.data() + graph.first[a];
    const std::int64_t n_chunks = graph.row[a + 1] - graph.row[a];
    for (std::int64_t c = 0; c < n_chunks; ++c) {
      prefetch(geometry + c + chunks_ahead);
      Lanes v[4];
      gather_nodes<isa, Dim, stride>(velocity, neighbours[c], v);
#pragma GCC unroll 3
      for (int i = 0; i < Dim; ++i) {
        const Lanes jump = v[i] - velocity[a * stride + i];
#pragma GCC unroll 3
        for (int j = 0; j < Dim; ++j)
          sum[i * Dim + j] += jump * algebra::load(geometry[c].C_ab[j]);
      }
    }
    const double half_inverse_Omega = 0.5 * graph.inverse_Omega[a];
    for (int k = 0; k < Dim * Dim; ++k) {
      L[k * n_lanes + lane] = half_inverse_Omega * algebra::lane_sum(sum[k]);
    }
  }
}

/// Writes component c of the records of block b.
template <int Dim>
DIPTYCH_INLINE void put_in_records(State<Dim>& state, std::int64_t b, int c, const Lanes& value) {
  double* record = state.records.data() + b * n_lanes * state.record_stride + c;
  for (int lane = 0; lane < n_lanes; ++lane)
    record[lane * state.record_stride] = value[lane];
}

template <int Dim>
DIPTYCH_INLINE void put_tensor_in_records(State<Dim>& state,
                                          std::int64_t b,
                                          int c,
                                          const Tensor<Lanes>& value) {
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      put_in_records(state, b, c + i * Dim + j, value(i, j));
}

/// Writes the in-plane part of a tensor of block b to an array of rows.
template <int Dim>
DIPTYCH_INLINE void put_tensor(double* rows,
                               int stride,
                               std::int64_t b,
                               const Tensor<Lanes>& value) {
  double* row = rows + b * n_lanes * stride;
  for (int k = 0; k < Dim * Dim; ++k) {
    for (int lane = 0; lane < n_lanes; ++lane) {
      row[lane * stride + k] = value(k / Dim, k % Dim)[lane];
    }
  }
}

/// Fills the records of block b: what the momentum sweep reads of a neighbour.
template <int Dim>
DIPTYCH_INLINE void write_records(State<Dim>& state,
                                  std::int64_t b,
                                  const Deformation<Lanes>& X,
                                  const Response<Lanes>& response,
                                  const Tensor<Lanes>& P,
                                  bool exact_impedance) {
  using Record = NodeRecord<Dim>;
  constexpr int stride = vector_stride<Dim>;
  const double* velocity = state.velocity.data() + b * n_lanes * stride;
  for (int i = 0; i < Dim; ++i) {
    Lanes v;
    for (int lane = 0; lane < n_lanes; ++lane)
      v[lane] = velocity[lane * stride + i];
    put_in_records(state, b, Record::v + i, v);
  }
  if (state.has_face_correction()) {
    put_tensor<Dim>(state.stresses.data(), tensor_stride<Dim>, b,
                    P);  // P' follows in a sweep of its own
  } else {
    put_tensor_in_records(state, b, Record::P, P);
  }
  put_tensor_in_records(state, b, Record::L, algebra::load_tensor<Dim>(state.L.block(b), 0));
  put_tensor_in_records(state, b, Record::H, X.H);
  if (!exact_impedance) return;
  put_tensor_in_records(state, b, Record::F, X.F);
  constexpr int order_A[6] = {0, 1, Dim == 3 ? 2 : 3, 3, 4, 5};
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k) {
    put_in_records(state, b, Record::A_tot + k, response.A_tot.s[order_A[k]]);
  }
  constexpr int order_S[6] = {0, 1, Dim == 3 ? 2 : 3, Dim == 3 ? 3 : 2, 4, 5};
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k) {
    put_in_records(state, b, Record::S_tot + k, response.S_tot.s[order_S[k]]);
  }
  put_in_records(state, b, Record::W_JJ, response.W_JJ);
  put_in_records(state, b, Record::W_FJ, response.W_FJ);
}

/// One block of the sweep. @return sum of the viscous dissipation over the block [W]
template <InstructionSet isa, int Dim, class Material>
DIPTYCH_INLINE double evaluate_block(const StrainRateSweep<Dim, Material>& sweep,
                                     std::int64_t b,
                                     Lanes& least_J,
                                     Lanes& n_bad) {
  using Layout = algebra::Layout<Dim>;
  constexpr bool has_H = Material::has_H;
  State<Dim>& state = sweep.state;
  if (sweep.face_correction == 0) {
    strain_rates_of_block<isa>(sweep.graph, state, b);
  } else {
    correct_rates_of_block<isa>(sweep.graph, state, sweep.face_correction, b);
  }
  if (sweep.drift != 0) drift_block(state, sweep.drift, b);
  const Deformation<Lanes> X = load_deformation(state, b);
  least_J = algebra::smaller(least_J, X.J);
  n_bad += X.J > 0 ? Lanes{} : Lanes{} + 1.0;  // a comparison with NaN is false
  Lanes dissipation{};
  const Response<Lanes> response = response_of_block(
      sweep.model, state, sweep.relaxation, X, b, [&](int k, const BranchState<Lanes>& branch) {
        if (sweep.with_dissipation) {
          dissipation += physics::branch_dissipation<has_H>(sweep.model.branches[k], branch, X);
        }
        if (!sweep.relaxation.commit) return;
        algebra::store_A<Dim>(state.A.block(b) + k * Layout::n_A * n_lanes, branch.A);
        if constexpr (has_H) {
          algebra::store_S<Dim>(state.S.block(b) + k * Layout::n_S * n_lanes, branch.S);
        }
      });
  const Tensor<Lanes> P = physics::piola_stress<has_H>(response, X);
  write_records(state, b, X, response, P, sweep.exact_impedance);
  const double rho_R = sweep.model.rho_R;
  const auto speeds = physics::speed_bounds(response, X, rho_R, has_H);
  put_in_records(state, b, NodeRecord<Dim>::z_p, rho_R * speeds.c_p);
  put_in_records(state, b, NodeRecord<Dim>::z_s, rho_R * speeds.c_s);
  return algebra::lane_sum(dissipation * algebra::load(sweep.graph.Omega.data() + b * n_lanes));
}

template <InstructionSet isa, int Dim, class Material>
DIPTYCH_INLINE void evaluate_blocks(const StrainRateSweep<Dim, Material>& sweep,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    std::int64_t chunk) {
  double power = 0;
  Lanes least = Lanes{} + 1e300, n_bad{};
  for (std::int64_t b = begin; b < end; ++b) {
    power += evaluate_block<isa>(sweep, b, least, n_bad);
  }
  sweep.viscous_power[chunk] = power;
  double least_of_all = least[0];
  for (int l = 1; l < n_lanes; ++l)
    least_of_all = algebra::smaller(least_of_all, least[l]);
  sweep.least_J[chunk] = algebra::lane_sum(n_bad) > 0 ? __builtin_nan("") : least_of_all;
}

template <int Dim, class Material>
void strain_rate_sweep_baseline(const StrainRateSweep<Dim, Material>& sweep,
                                std::int64_t begin,
                                std::int64_t end,
                                std::int64_t chunk) {
  evaluate_blocks<InstructionSet::baseline>(sweep, begin, end, chunk);
}
template <int Dim, class Material>
DIPTYCH_AVX2 void strain_rate_sweep_avx2(const StrainRateSweep<Dim, Material>& sweep,
                                         std::int64_t begin,
                                         std::int64_t end,
                                         std::int64_t chunk) {
  evaluate_blocks<InstructionSet::avx2>(sweep, begin, end, chunk);
}
template <int Dim, class Material>
DIPTYCH_AVX512 void strain_rate_sweep_avx512(const StrainRateSweep<Dim, Material>& sweep,
                                             std::int64_t begin,
                                             std::int64_t end,
                                             std::int64_t chunk) {
  evaluate_blocks<InstructionSet::avx512>(sweep, begin, end, chunk);
}

/// The sweep for this processor.
template <int Dim, class Material>
StrainRateFunction<Dim, Material> strain_rate_function() {
  switch (algebra::instruction_set()) {
    case InstructionSet::avx512:
      return strain_rate_sweep_avx512<Dim, Material>;
    case InstructionSet::avx2:
      return strain_rate_sweep_avx2<Dim, Material>;
    default:
      return strain_rate_sweep_baseline<Dim, Material>;
  }
}

}  // namespace diptych::scheme
