#pragma once
/// First pair sweep of an evaluation, after F, H, J have been moved to its time: strain rates
/// (18b), Omega_a dF_a/dt = sum_b 1/2 (v_b - v_a) (x) C_ab, then per node relaxation (14), stress
/// (9) and wave speeds, left where the momentum sweep reads them. (18c) and (18d) are pointwise in
/// dF/dt and stand in the update.
///
/// Cost per directed pair in 3-D: 9 multiply-adds and 3 subtractions on 32 bytes gathered and at
/// most 28 of geometry (double precision).

#include "common/algebra/layout.hpp"
#include "common/algebra/versions.hpp"
#include "common/physics/wave_speeds.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/graph/sweep_graph.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/pair_access.hpp"
#include "common/scheme/sweeps/update.hpp"

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
  const StageCombination* stage;  ///< SSP: moves F, H, J by the old rates first; may be null
  double drift;                   ///< s, leapfrog: moves u, F, H, J by the new rates
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

/// Of block b, runs.
template <int Dim, class T, class Cursor>
DIPTYCH_INLINE void sum_gradients_of_runs(const SweepGraph<Dim>& graph,
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

/// Of block b, of a table in the precision of Real.
template <InstructionSet isa, class Real, int Dim>
DIPTYCH_INLINE void sum_gradients_of_block(const SweepGraph<Dim>& graph,
                                           const NodeTable& velocity,
                                           std::int64_t b,
                                           Lanes (&L)[Dim * Dim]) {
  using T = algebra::Pack<Real>;
  T sum[Dim * Dim];
  if (graph.shape.arrangement == Arrangement::runs) {
    sum_gradients_of_runs(graph, velocity, b, VectorCursor<Dim>(graph.strain, graph.first[b]), sum);
#pragma GCC unroll 9
    for (int k = 0; k < Dim * Dim; ++k)
      L[k] = algebra::widened(sum[k]);
    return;
  }
  for (int lane = 0; lane < n_lanes; ++lane) {
    const std::int64_t a = b * n_lanes + lane, first = graph.row[a];
    sum_gradients<Dim>(
        graph.row[a + 1] - first, VectorCursor<Dim>(graph.strain, graph.first[a]),
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
DIPTYCH_INLINE void strain_rates_of_block(const SweepGraph<Dim>& graph,
                                          const State<Dim>& state,
                                          std::int64_t b,
                                          Lanes (&L)[Dim * Dim]) {
  if (state.shape.single) {
    sum_gradients_of_block<isa, float>(graph, state.v, b, L);
  } else {
    sum_gradients_of_block<isa, double>(graph, state.v, b, L);
  }
  scale_gradients(graph, b, L);
}

/// dF/dt of block b, and of b + 1 where both can be summed at once: singles whose pairs are at the
/// same offsets.
/// @return number of blocks
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE int strain_rates_of_next(const SweepGraph<Dim>& graph,
                                        const State<Dim>& state,
                                        std::int64_t b,
                                        std::int64_t end,
                                        Lanes (&L)[2][Dim * Dim]) {
  const bool two = state.shape.single && graph.shape.arrangement == Arrangement::runs &&
                   b + 1 < end && same_offsets(graph.row, graph.offset, b);
  if (!two) {
    strain_rates_of_block<isa>(graph, state, b, L[0]);
    return 1;
  }
  algebra::WideSingles sum[Dim * Dim];
  sum_gradients_of_runs(graph, state.v, b,
                        TwoCursors<Dim>(graph.strain, graph.first[b], graph.first[b + 1]), sum);
  for (int k = 0; k < Dim * Dim; ++k) {
    L[0][k] = algebra::widened(algebra::first_half(sum[k]));
    L[1][k] = algebra::widened(algebra::second_half(sum[k]));
  }
  scale_gradients(graph, b, L[0]);
  scale_gradients(graph, b + 1, L[1]);
  return 2;
}

/// Fills the records of block b, but for L, and for H where it is evolved, which are there.
template <int Dim>
DIPTYCH_INLINE void write_records(State<Dim>& state,
                                  std::int64_t b,
                                  const Deformation<Lanes>& X,
                                  const Response<Lanes>& response,
                                  const Tensor<Lanes>& P,
                                  bool exact_impedance) {
  using Record = NodeRecord<Dim>;
  if (state.records.arrangement() == Arrangement::rows) {
    for (int i = 0; i < Dim; ++i)
      state.records.put(b, Record::v(exact_impedance) + i, state.v.get(b, i));
  }
  if (state.has_face_correction()) {
    put_tensor<Dim>(state.stresses, b, 0, P);  // P' follows in a sweep of its own
  } else {
    put_tensor<Dim>(state.records, b, Record::P, P);
  }
  if (state.unknowns != Unknowns::FHJ) put_tensor<Dim>(state.records, b, Record::H, X.H, 1);
  if (!exact_impedance) return;
  put_tensor<Dim>(state.records, b, Record::F, X.F, 1);
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k) {
    state.records.put(b, Record::A_tot + k, response.A_tot.s[algebra::order_of_A<Dim>[k]]);
  }
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k) {
    state.records.put(b, Record::S_tot + k, response.S_tot.s[algebra::order_of_S<Dim>[k]]);
  }
  state.records.put(b, Record::W_JJ, response.W_JJ);
  state.records.put(b, Record::W_FJ, response.W_FJ);
}

/// One block of the sweep. @return sum of the viscous dissipation over the block [W]
template <int Dim, class Material>
DIPTYCH_INLINE double evaluate_block(const StrainRateSweep<Dim, Material>& sweep,
                                     std::int64_t b,
                                     const Lanes (&L)[Dim * Dim],
                                     Lanes& least_J,
                                     Lanes& n_bad) {
  using Layout = algebra::Layout<Dim>;
  constexpr bool has_H = Material::has_H;
  State<Dim>& state = sweep.state;
  if (state.records.arrangement() == Arrangement::runs) {
    prefetch_to_write<NodeRecord<Dim>::n_isotropic>(state.records, b);
  }
  if (sweep.stage != nullptr) update_deformation_of_block(state, *sweep.stage, b);
  state.records.template put_each<Dim * Dim>(b, NodeRecord<Dim>::L,
                                             [&](int k) DIPTYCH_INLINE_LAMBDA { return L[k]; });
  if (sweep.drift != 0) drift_block(state, sweep.drift, b);
  const Deformation<Lanes> X = load_deformation(state, b);
  least_J = algebra::smaller(least_J, X.J);
  n_bad += X.J > 0 ? Lanes{} : Lanes{} + 1.0;  // a comparison with NaN is false
  Lanes dissipation{};
  const Response<Lanes> response = response_of_block(
      sweep.model, state, sweep.relaxation, X, b,
      [&](int k, const BranchState<Lanes>& branch,
          const physics::RightTensors<Lanes>& now) DIPTYCH_INLINE_LAMBDA {
        if (sweep.with_dissipation) {
          dissipation += physics::branch_dissipation<has_H>(sweep.model.branches[k], branch, now);
        }
        if (!sweep.relaxation.commit) return;
        algebra::put_A<Dim>(state.A, b, k * Layout::n_A, branch.A);
        if constexpr (has_H) {
          algebra::put_S<Dim>(state.S, b, k * Layout::n_S, branch.S);
        }
      });
  const Tensor<Lanes> P = physics::piola_stress<has_H>(response, X);
  write_records(state, b, X, response, P, sweep.exact_impedance);
  const double rho_R = sweep.model.rho_R;
  const auto speeds = physics::speed_bounds(response, X, rho_R, has_H, Material::has_W_FJ);
  state.records.put(b, NodeRecord<Dim>::z_p, rho_R * speeds.c_p);
  state.records.put(b, NodeRecord<Dim>::z_s, rho_R * speeds.c_s);
  return algebra::lane_sum(dissipation * algebra::load(sweep.graph.Omega.data() + b * n_lanes));
}

template <InstructionSet isa, int Dim, class Material>
DIPTYCH_INLINE void evaluate_blocks(const StrainRateSweep<Dim, Material>& sweep,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    std::int64_t chunk) {
  const algebra::FlushToZero flush(sweep.state.shape.single);
  double power = 0;
  Lanes least = Lanes{} + 1e300, n_bad{};
  for (std::int64_t b = begin; b < end;) {
    Lanes L[2][Dim * Dim];
    int n = 1;
    if (sweep.face_correction == 0) {
      n = strain_rates_of_next<isa>(sweep.graph, sweep.state, b, end, L);
    } else {
      corrected_block<isa, Side::rates>(sweep.graph, sweep.state.gradients, sweep.face_correction,
                                        b, L[0]);
    }
    for (int k = 0; k < n; ++k)
      power += evaluate_block(sweep, b + k, L[k], least, n_bad);
    b += n;
  }
  sweep.viscous_power[chunk] = power;
  double least_of_all = least[0];
  for (int l = 1; l < n_lanes; ++l)
    least_of_all = algebra::smaller(least_of_all, least[l]);
  sweep.least_J[chunk] = algebra::lane_sum(n_bad) > 0 ? __builtin_nan("") : least_of_all;
}

template <int Dim, class Material>
struct StrainRateKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const StrainRateSweep<Dim, Material>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t chunk) {
    evaluate_blocks<isa>(sweep, begin, end, chunk);
  }
};
template <int Dim, class Material>
using StrainRateVersions = algebra::Versions<StrainRateKernel<Dim, Material>,
                                             const StrainRateSweep<Dim, Material>&,
                                             std::int64_t,
                                             std::int64_t,
                                             std::int64_t>;

/// The sweep for this processor.
template <int Dim, class Material>
StrainRateFunction<Dim, Material> strain_rate_function() {
  return algebra::version_here<StrainRateVersions<Dim, Material>>();
}

}  // namespace diptych::scheme
