#pragma once
/// Second pair sweep of an evaluation: internal forces of (18a) with the dissipation D_ab,
///   T_a = sum_b 1/2 (P_a C_ab - P_b C_ba) + sum_b D_ab,
/// summed per node: every pair is worked twice, each time for one of its nodes, so that no node
/// is written by two threads and the sum has a fixed order. P_a sum_b C_ab is taken out of the sum.
///
/// Also per node: numerical dissipation 1/2 sum_b (v_b - v_a).D_ab, and on demand the graph CFL
/// rate sum_b |C_ab| c_ab / (2 Omega_a) with c_ab = max(c_p,a, c_p,b) (physics note 2.1).
///
/// Cost per directed pair in 3-D (linear reconstruction, isotropic): about 75 multiply-adds on 280
/// bytes of the neighbour and at most 44 bytes of geometry.

#include "common/scheme/dissipation.hpp"
#include "common/scheme/state.hpp"
#include "common/scheme/strain_rates.hpp"
#include "common/scheme/sweep_graph.hpp"

namespace diptych::scheme {

/// Arguments and results of the sweep.
template <int Dim>
struct MomentumSweep {
  const SweepGraph<Dim>& graph;
  State<Dim>& state;
  double rho_R;
  double factor;    ///< multiplies D_ab
  bool with_bound;  ///< fill largest_rate
  // results, one per chunk of parallel::for_chunks
  double* numerical_power;  ///< W
  double* largest_rate;     ///< 1/s, graph CFL: dt <= 1/rate
};

/// A compiled sweep over blocks [begin, end) of a chunk.
template <int Dim>
using MomentumFunction = void (*)(const MomentumSweep<Dim>& sweep,
                                  std::int64_t begin,
                                  std::int64_t end,
                                  std::int64_t chunk);

/// The compiled sweep of this kind. has_H: the material's pressure wave is polarised along H N.
template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H);

// What follows is for the files that compile sweeps (sweeps/momentum_*.cpp).

/// Sums of a node over its row.
template <int Dim>
struct NodeSums {
  Lanes force[Dim] = {};  ///< -sum P_b C_ba + sum |S| Z jump (both to be halved)
  Lanes power{};          ///< sum (v_b - v_a) . |S| Z jump
  Lanes rate{};           ///< sum |C_ab| z_ab
};

/// Mean response of the pair from the records of its nodes, for the exact impedance.
template <int Dim, class Pairs>
DIPTYCH_INLINE void mean_state(const Pairs& pairs,
                               physics::Response<Lanes>& r,
                               physics::Deformation<Lanes>& X) {
  using Record = NodeRecord<Dim>;
  const auto mean = [&](int c) { return 0.5 * (pairs.neighbour(c) + pairs.own(c)); };
  X.F = Tensor<Lanes>{};
  X.H = Tensor<Lanes>{};
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      X.F(i, j) = mean(Record::F + i * Dim + j);
      X.H(i, j) = mean(Record::H + i * Dim + j);
    }
  }
  if constexpr (Dim == 2) X.F(2, 2) = Lanes{} + 1.0;
  constexpr int order_A[6] = {0, 1, Dim == 3 ? 2 : 3, 3, 4, 5};
  constexpr int order_S[6] = {0, 1, Dim == 3 ? 2 : 3, Dim == 3 ? 3 : 2, 4, 5};
  r.A_tot = SymmetricTensor<Lanes>{};
  r.S_tot = SymmetricTensor<Lanes>{};
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k)
    r.A_tot.s[order_A[k]] = mean(Record::A_tot + k);
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k)
    r.S_tot.s[order_S[k]] = mean(Record::S_tot + k);
  r.W_JJ = mean(Record::W_JJ);
  r.W_FJ = mean(Record::W_FJ);
}

/// L X_ab of both nodes, or only their sum where the limiter needs no more.
template <int Dim>
struct Slopes {
  Vector<Lanes> sum{}, a{}, b{};
};

/// v_b^rec - v_a^rec, limited.  @param h  along the normal of the pair in space
template <int Dim, PairLimiter limiter>
DIPTYCH_INLINE Vector<Lanes> reconstructed_jump(const Vector<Lanes>& plain,
                                                const Slopes<Dim>& slopes,
                                                const Vector<Lanes>& h) {
  Vector<Lanes> jump{};
  for (int i = 0; i < Dim; ++i)
    jump[i] = plain[i] - 0.5 * slopes.sum[i];
  if constexpr (limiter == PairLimiter::none) return jump;
  Lanes h_h{};
  for (int i = 0; i < Dim; ++i)
    h_h += h[i] * h[i];
  const Lanes inverse = algebra::inverse_or_zero(algebra::square_root(h_h));
  Vector<Lanes> n{};
  for (int i = 0; i < Dim; ++i)
    n[i] = h[i] * inverse;
  if constexpr (limiter == PairLimiter::sign_preserving) limit_sign_preserving<Dim>(jump, plain, n);
  if constexpr (limiter == PairLimiter::barth_jespersen)
    return slope_limited_jump<BarthJespersen, Dim>(plain, slopes.a, slopes.b, n);
  if constexpr (limiter == PairLimiter::venkatakrishnan)
    return slope_limited_jump<Venkatakrishnan, Dim>(plain, slopes.a, slopes.b, n);
  return jump;
}

/// Geometry of eight pairs.
template <int Dim>
struct PairGeometry {
  const ForceGeometry<Dim>& force;
  const FaceGeometry<Dim>& face;
};

/// Adds eight pairs to the sums of their unit.
/// @param pairs      of the records
/// @param positions  pairs of X
template <int Dim, DissipationKind kind, bool has_H, class Pairs, class Positions>
DIPTYCH_INLINE void add_pairs(const MomentumSweep<Dim>& sweep,
                              const PairGeometry<Dim>& geometry,
                              const Pairs& pairs,
                              const Positions& positions,
                              NodeSums<Dim>& sums) {
  using Record = NodeRecord<Dim>;
  Vector<Lanes> C_ba{}, S{}, plain{}, h{};
  Slopes<Dim> slopes;
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
    C_ba[i] = algebra::load(geometry.force.C_ba[i]);
    S[i] = algebra::load(geometry.face.S_ab[i]);
    plain[i] = pairs.neighbour(Record::v + i) - pairs.own(Record::v + i);
  }
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
    Lanes PC{};
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) {
      const int ij = i * Dim + j;
      PC += pairs.neighbour(Record::P + ij) * C_ba[j];
      h[i] += (pairs.neighbour(Record::H + ij) + pairs.own(Record::H + ij)) * S[j];
      if constexpr (kind.reconstruction == Reconstruction::linear) {
        const Lanes X = positions.neighbour(j) - positions.own(j);
        if constexpr (limits_slopes(kind.limiter)) {
          slopes.a[i] += pairs.own(Record::L + ij) * X;
          slopes.b[i] += pairs.neighbour(Record::L + ij) * X;
        } else {
          slopes.sum[i] += (pairs.neighbour(Record::L + ij) + pairs.own(Record::L + ij)) * X;
        }
      }
    }
    sums.force[i] -= PC;
  }
  const Lanes area = algebra::load(geometry.face.area);
  const Lanes z_p = pairs.neighbour(Record::z_p);
  const Vector<Lanes> jump = reconstructed_jump<Dim, kind.limiter>(plain, slopes, h);
  Vector<Lanes> D{};
  if constexpr (kind.impedance == Impedance::isotropic) {
    const Lanes z_s = pairs.neighbour(Record::z_s);
    D = isotropic_impedance_times<Dim>(0.5 * (z_p + pairs.own(Record::z_p)),
                                       0.5 * (z_s + pairs.own(Record::z_s)), h, jump);
  } else {
    physics::Response<Lanes> response;
    physics::Deformation<Lanes> X;
    mean_state<Dim>(pairs, response, X);
    Lanes S2{};
    for (int i = 0; i < Dim; ++i)
      S2 += S[i] * S[i];
    const Lanes inverse = algebra::inverse_or_zero(algebra::square_root(S2));
    Vector<Lanes> N{};
    for (int i = 0; i < Dim; ++i)
      N[i] = S[i] * inverse;
    if constexpr (Dim == 2) N[1] = area > 0 ? N[1] : Lanes{};
    N[0] = area > 0 ? N[0] : Lanes{} + 1.0;  // padding: any unit vector, its area is zero
    D = algebra::product(physics::impedance<has_H>(response, X, sweep.rho_R, N), jump);
  }
  for (int i = 0; i < Dim; ++i) {
    const Lanes AD = (sweep.factor * area) * D[i];
    sums.force[i] += AD;
    sums.power += plain[i] * AD;
  }
  if (sweep.with_bound) {
    Lanes C2{};
    for (int i = 0; i < Dim; ++i) {
      const Lanes C_ab = 2.0 * S[i] + C_ba[i];
      C2 += C_ab * C_ab;
    }
    sums.rate += algebra::square_root(C2) * algebra::larger(z_p, Lanes{} + pairs.own(Record::z_p));
  }
}

/// Sums of the pairs of a unit.
template <InstructionSet isa, Arrangement arrangement, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE NodeSums<Dim> sums_of(const MomentumSweep<Dim>& sweep, std::int64_t unit) {
  using Record = NodeRecord<Dim>;
  constexpr bool exact = kind.impedance == Impedance::exact;
  const SweepGraph<Dim>& graph = sweep.graph;
  const std::int64_t begin = graph.row[unit], end = graph.row[unit + 1];
  const ForceGeometry<Dim>* force = graph.force.data() + graph.first[unit];
  const FaceGeometry<Dim>* face = graph.face.data() + graph.first[unit];
  NodeSums<Dim> sums;
  if constexpr (arrangement == Arrangement::runs) {
    prefetch_last_run<Record::n(exact)>(graph, sweep.state.records, unit);
  }
  for (std::int64_t chunk = begin; chunk < end; ++chunk, ++force, ++face) {
    prefetch(force + chunks_ahead);
    prefetch(face + chunks_ahead);
    const auto pairs = pairs_of<isa, arrangement, Record::n(exact), Record::stride(exact)>(
        graph, sweep.state.records, unit, chunk);
    const auto positions = vector_pairs_of<isa, arrangement>(graph, graph.X, unit, chunk);
    add_pairs<Dim, kind, has_H>(sweep, {*force, *face}, pairs, positions, sums);
  }
  return sums;
}

/// Forces on the eight nodes of block b, each over its row of pairs.
/// @return numerical dissipation of their halves of the pairs [W]; updates the largest rate
template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE double forces_on_block(const MomentumSweep<Dim>& sweep,
                                      std::int64_t b,
                                      double& largest_rate) {
  using Record = NodeRecord<Dim>;
  const SweepGraph<Dim>& graph = sweep.graph;
  NodeSums<Dim> sums;
  if (graph.shape.arrangement == Arrangement::runs) {
    sums = sums_of<isa, Arrangement::runs, Dim, kind, has_H>(sweep, b);
  } else {
    for (int lane = 0; lane < n_lanes; ++lane) {
      const auto of_node =
          sums_of<isa, Arrangement::rows, Dim, kind, has_H>(sweep, b * n_lanes + lane);
      for (int i = 0; i < Dim; ++i)
        sums.force[i][lane] = algebra::lane_sum(of_node.force[i]);
      sums.power[lane] = algebra::lane_sum(of_node.power);
      sums.rate[lane] = algebra::lane_sum(of_node.rate);
    }
  }
  for (int i = 0; i < Dim; ++i) {
    Lanes PC{};
    for (int j = 0; j < Dim; ++j) {
      PC += sweep.state.records.get(b, Record::P + i * Dim + j) *
            algebra::load(graph.C_sum.block(b) + j * n_lanes);
    }
    algebra::store(sweep.state.T.block(b) + i * n_lanes, 0.5 * (PC + sums.force[i]));
  }
  if (sweep.with_bound) {
    const Lanes rate =
        (0.5 / sweep.rho_R) * sums.rate * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int lane = 0; lane < n_lanes; ++lane)
      largest_rate = algebra::larger(largest_rate, rate[lane]);
  }
  return 0.25 * algebra::lane_sum(sums.power);
}

template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void forces_on_blocks(const MomentumSweep<Dim>& sweep,
                                     std::int64_t begin,
                                     std::int64_t end,
                                     std::int64_t chunk) {
  double power = 0, rate = 0;
  for (std::int64_t b = begin; b < end; ++b)
    power += forces_on_block<isa, Dim, kind, has_H>(sweep, b, rate);
  sweep.numerical_power[chunk] = power;
  sweep.largest_rate[chunk] = rate;
}

template <int Dim, DissipationKind kind, bool has_H>
void momentum_sweep_baseline(const MomentumSweep<Dim>& sweep,
                             std::int64_t begin,
                             std::int64_t end,
                             std::int64_t chunk) {
  forces_on_blocks<InstructionSet::baseline, Dim, kind, has_H>(sweep, begin, end, chunk);
}
template <int Dim, DissipationKind kind, bool has_H>
DIPTYCH_AVX2 void momentum_sweep_avx2(const MomentumSweep<Dim>& sweep,
                                      std::int64_t begin,
                                      std::int64_t end,
                                      std::int64_t chunk) {
  forces_on_blocks<InstructionSet::avx2, Dim, kind, has_H>(sweep, begin, end, chunk);
}
template <int Dim, DissipationKind kind, bool has_H>
DIPTYCH_AVX512 void momentum_sweep_avx512(const MomentumSweep<Dim>& sweep,
                                          std::int64_t begin,
                                          std::int64_t end,
                                          std::int64_t chunk) {
  forces_on_blocks<InstructionSet::avx512, Dim, kind, has_H>(sweep, begin, end, chunk);
}

/// The sweep of one kind for this processor.
template <int Dim, DissipationKind kind, bool has_H>
MomentumFunction<Dim> momentum_sweep() {
  switch (algebra::instruction_set()) {
    case InstructionSet::avx512:
      return momentum_sweep_avx512<Dim, kind, has_H>;
    case InstructionSet::avx2:
      return momentum_sweep_avx2<Dim, kind, has_H>;
    default:
      return momentum_sweep_baseline<Dim, kind, has_H>;
  }
}

/// Sweeps of linear reconstruction with one impedance, by limiter.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> limited_sweep(PairLimiter limiter) {
  using enum PairLimiter;
  constexpr auto linear = Reconstruction::linear;
  switch (limiter) {
    case sign_preserving:
      return momentum_sweep<Dim, {linear, sign_preserving, impedance}, has_H>();
    case barth_jespersen:
      return momentum_sweep<Dim, {linear, barth_jespersen, impedance}, has_H>();
    case venkatakrishnan:
      return momentum_sweep<Dim, {linear, venkatakrishnan, impedance}, has_H>();
    default:
      return momentum_sweep<Dim, {linear, none, impedance}, has_H>();
  }
}

/// The menu of compiled sweeps of one dimension and impedance, by reconstruction and limiter.
/// Compiled in a file of its own for each.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> momentum_sweep_of(const DissipationKind& kind) {
  constexpr DissipationKind plain{Reconstruction::none, PairLimiter::none, impedance};
  if (kind.reconstruction == Reconstruction::none) return momentum_sweep<Dim, plain, has_H>();
  return limited_sweep<Dim, impedance, has_H>(kind.limiter);
}

}  // namespace diptych::scheme
