#pragma once
/// Second pair sweep of an evaluation: internal forces of (18a) with the dissipation D_ab,
///   T_a = sum_b 1/2 (P_a C_ab - P_b C_ba) + sum_b D_ab.
/// Runs: every pair is worked once, from its lower node, and its force added to one node and taken
/// from the other. Segments of blocks go no farther than into the next segment: all even ones are
/// worked at the same time, then all odd ones, so that no node is written by two threads and every
/// sum has an order of its own. Rows: every pair is worked twice, each time for one of its nodes,
/// with P_a sum_b C_ab taken out of the sum.
///
/// Also per node: numerical dissipation 1/2 sum_b (v_b - v_a).D_ab, and on demand the graph CFL
/// rate sum_b |C_ab| c_ab / (2 Omega_a) with c_ab = max(c_p,a, c_p,b) (physics note 2.1).
///
/// Cost in 3-D (linear reconstruction, isotropic): about 75 multiply-adds for a directed pair of
/// rows, about 90 for both directions in runs, on 280 bytes of the neighbour; geometry at most 44
/// bytes of a directed pair in rows, 26 in runs.

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

/// A compiled sweep over blocks [begin, end) of a chunk: forces of rows into state.T, of runs added
/// to its sums.
template <int Dim>
using MomentumFunction = void (*)(const MomentumSweep<Dim>& sweep,
                                  std::int64_t begin,
                                  std::int64_t end,
                                  std::int64_t chunk);

/// The compiled sweep of this kind. has_H: the material's pressure wave is polarised along H N.
template <int Dim>
MomentumFunction<Dim> momentum_function(const DissipationKind& kind, bool has_H);

/// The sweep over all blocks: internal forces into state.T.
template <int Dim>
void sum_forces(const MomentumSweep<Dim>& sweep, MomentumFunction<Dim> momentum);

// What follows is for the files that compile sweeps (sweeps/momentum_*.cpp).

/// Sums of a node over its pairs.
template <int Dim>
struct NodeSums {
  Lanes force[Dim] = {};  ///< 2 T; in rows without P_a sum C_ab
  Lanes power{};          ///< sum (v_b - v_a) . |S| Z jump
  Lanes rate{};           ///< sum |C_ab| z_ab
};

/// Mean response of the pair from the records of its nodes, for the exact impedance.
template <int Dim, class Pairs>
DIPTYCH_INLINE void mean_state(const Pairs& pairs,
                               physics::Response<Lanes>& r,
                               physics::Deformation<Lanes>& X) {
  using Record = NodeRecord<Dim>;
  const auto mean = [&](int c)
                        DIPTYCH_INLINE_LAMBDA { return 0.5 * (pairs.neighbour(c) + pairs.own(c)); };
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

/// What the dissipation of eight pairs needs of their geometry; the length of S is free.
template <int Dim>
struct PairFace {
  Vector<Lanes> S{};  ///< along S_ab
  Lanes area;         ///< m^2, |S_ab|
};

/// 2 D_ab of eight pairs.
/// @param pairs      of the records
/// @param positions  pairs of X
/// @param plain      v_b - v_a
template <int Dim, DissipationKind kind, bool has_H, class Pairs, class Positions>
DIPTYCH_INLINE Vector<Lanes> dissipation_of(const MomentumSweep<Dim>& sweep,
                                            const PairFace<Dim>& face,
                                            const Pairs& pairs,
                                            const Positions& positions,
                                            const Vector<Lanes>& plain) {
  using Record = NodeRecord<Dim>;
  Vector<Lanes> h{};
  Slopes<Dim> slopes;
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) {
      const int ij = i * Dim + j;
      h[i] += (pairs.neighbour(Record::H + ij) + pairs.own(Record::H + ij)) * face.S[j];
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
  }
  const Vector<Lanes> jump = reconstructed_jump<Dim, kind.limiter>(plain, slopes, h);
  Vector<Lanes> D{};
  if constexpr (kind.impedance == Impedance::isotropic) {
    D = isotropic_impedance_times<Dim>(
        0.5 * (pairs.neighbour(Record::z_p) + pairs.own(Record::z_p)),
        0.5 * (pairs.neighbour(Record::z_s) + pairs.own(Record::z_s)), h, jump);
  } else {
    physics::Response<Lanes> response;
    physics::Deformation<Lanes> X;
    mean_state<Dim>(pairs, response, X);
    Lanes S2{};
    for (int i = 0; i < Dim; ++i)
      S2 += face.S[i] * face.S[i];
    const Lanes inverse = algebra::inverse_or_zero(algebra::square_root(S2));
    Vector<Lanes> N{};
    for (int i = 0; i < Dim; ++i)
      N[i] = face.S[i] * inverse;
    if constexpr (Dim == 2) N[1] = face.area > 0 ? N[1] : Lanes{};
    N[0] = face.area > 0 ? N[0] : Lanes{} + 1.0;  // padding: any unit vector, its area is zero
    D = algebra::product(physics::impedance<has_H>(response, X, sweep.rho_R, N), jump);
  }
  for (int i = 0; i < Dim; ++i)
    D[i] *= sweep.factor * face.area;
  return D;
}

/// |C| max(z_p,a, z_p,b) of eight pairs.
template <int Dim, class Pairs>
DIPTYCH_INLINE Lanes rate_of(const Vector<Lanes>& C, const Pairs& pairs) {
  using Record = NodeRecord<Dim>;
  Lanes C2{};
  for (int i = 0; i < Dim; ++i)
    C2 += C[i] * C[i];
  return algebra::square_root(C2) *
         algebra::larger(pairs.neighbour(Record::z_p), Lanes{} + pairs.own(Record::z_p));
}

/// v_b - v_a of eight pairs.
/// @param pairs  with v from component c
template <int Dim, class Pairs>
DIPTYCH_INLINE Vector<Lanes> plain_jump(const Pairs& pairs, int c) {
  Vector<Lanes> plain{};
  for (int i = 0; i < Dim; ++i)
    plain[i] = pairs.neighbour(c + i) - pairs.own(c + i);
  return plain;
}

/// Rows: the sums of node a.
template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE NodeSums<Dim> sums_of_node(const MomentumSweep<Dim>& sweep, std::int64_t a) {
  using Record = NodeRecord<Dim>;
  constexpr bool exact = kind.impedance == Impedance::exact;
  constexpr auto rows = Arrangement::rows;
  const SweepGraph<Dim>& graph = sweep.graph;
  const PairArea* area = graph.area.data() + graph.first[a];
  ForceCursor<Dim> force(graph, graph.first[a]);
  FaceCursor<Dim> face_geometry(graph, graph.first[a]);
  NodeSums<Dim> sums;
  for (std::int64_t chunk = graph.row[a]; chunk < graph.row[a + 1]; ++chunk, ++area) {
    prefetch(area + chunks_ahead);
    const auto pairs = pairs_of<isa, rows, Record::n_row(exact), Record::stride(exact)>(
        graph, sweep.state.records, a, chunk);
    const auto positions = vector_pairs_of<isa, rows>(graph, graph.X, a, chunk);
    PairFace<Dim> face;
    face.area = algebra::load(area->area);
    Lanes C_ba[Dim], S_ab[Dim];
    force.next(C_ba);
    face_geometry.next(S_ab);
    for (int i = 0; i < Dim; ++i)
      face.S[i] = S_ab[i];
    const Vector<Lanes> plain = plain_jump<Dim>(pairs, Record::v(exact));
    const Vector<Lanes> D = dissipation_of<Dim, kind, has_H>(sweep, face, pairs, positions, plain);
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      Lanes PC{};
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j)
        PC += pairs.neighbour(Record::P + i * Dim + j) * C_ba[j];
      sums.force[i] += D[i] - PC;
      sums.power += plain[i] * D[i];
    }
    if (sweep.with_bound) {
      Vector<Lanes> C_ab{};
      for (int i = 0; i < Dim; ++i)
        C_ab[i] = 2.0 * face.S[i] + C_ba[i];
      sums.rate += rate_of<Dim>(C_ab, pairs);
    }
  }
  return sums;
}

/// Rows: forces on the eight nodes of block b, each over its pairs.
/// @return numerical dissipation of their halves of the pairs [W]; updates the largest rate
template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE double forces_on_block(const MomentumSweep<Dim>& sweep,
                                      std::int64_t b,
                                      double& largest_rate) {
  using Record = NodeRecord<Dim>;
  const SweepGraph<Dim>& graph = sweep.graph;
  NodeSums<Dim> sums;
  for (int lane = 0; lane < n_lanes; ++lane) {
    const auto of_node = sums_of_node<isa, Dim, kind, has_H>(sweep, b * n_lanes + lane);
    for (int i = 0; i < Dim; ++i)
      sums.force[i][lane] = algebra::lane_sum(of_node.force[i]);
    sums.power[lane] = algebra::lane_sum(of_node.power);
    sums.rate[lane] = algebra::lane_sum(of_node.rate);
  }
  for (int i = 0; i < Dim; ++i) {
    Lanes PC{};
    for (int j = 0; j < Dim; ++j) {
      PC += sweep.state.records.get(b, Record::P + i * Dim + j) *
            algebra::load(graph.C_sum.block(b) + j * n_lanes);
    }
    sweep.state.T.put(b, i, 0.5 * (PC + sums.force[i]));
  }
  if (sweep.with_bound) {
    const Lanes rate =
        (0.5 / sweep.rho_R) * sums.rate * algebra::load(graph.inverse_Omega.data() + b * n_lanes);
    for (int lane = 0; lane < n_lanes; ++lane)
      largest_rate = algebra::larger(largest_rate, rate[lane]);
  }
  return 0.25 * algebra::lane_sum(sums.power);
}

/// sums[0..7] += value
DIPTYCH_INLINE void add_to(double* sums, const Lanes& value) {
  algebra::store(sums, algebra::load(sums) + value);
}

/// Runs: a block whose pairs with nodes above it are being worked.
template <int Dim>
struct WorkedBlock {
  std::int64_t b = 0, chunk = 0;
  typename GeometryArray<MutualGeometry, Dim>::Cursor geometry;
  NodeSums<Dim> sums;
  DIPTYCH_INLINE WorkedBlock(const MutualPairs<Dim>& mutual, std::int64_t block)
      : b(block),
        chunk(mutual.row[block]),
        geometry(mutual.geometry,
                 mutual.row[block] == mutual.row[block + 1] ? 0 : mutual.first[block]) {}
};

/// Forces of the next n chunks of a block, added to its sums and taken from those of the others.
template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void work_chunks(const MomentumSweep<Dim>& sweep,
                                std::int64_t n,
                                WorkedBlock<Dim>& block) {
  using Record = NodeRecord<Dim>;
  const SweepGraph<Dim>& graph = sweep.graph;
  const std::int64_t stride = sweep.state.T.component_stride();
  double* const own_sums = sweep.state.T.origin() + block.b * n_lanes;
  NodeSums<Dim> sums = block.sums;
  auto geometry = block.geometry;
  const std::int64_t end = block.chunk + n;
  for (std::int64_t chunk = block.chunk; chunk < end; ++chunk) {
    const std::int64_t offset = graph.mutual.offset.data()[chunk];
    const RunPairs pairs(sweep.state.records, block.b, offset);
    const RunPairs positions(graph.X, block.b, offset);
    PairFace<Dim> face;
    Vector<Lanes> C_ab{}, C_ba{};
    geometry.next([&](const auto& of_chunk) DIPTYCH_INLINE_LAMBDA {
      face.area = algebra::load(of_chunk.area);
      for (int i = 0; i < Dim; ++i) {
        C_ab[i] = algebra::load(of_chunk.C_ab[i]);
        C_ba[i] = algebra::load(of_chunk.C_ba[i]);
      }
    });
    for (int i = 0; i < Dim; ++i)
      face.S[i] = C_ab[i] - C_ba[i];
    const Vector<Lanes> plain = plain_jump<Dim>(RunPairs(sweep.state.v, block.b, offset), 0);
    const Vector<Lanes> D = dissipation_of<Dim, kind, has_H>(sweep, face, pairs, positions, plain);
    double* const their_sums = own_sums + offset;
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      Lanes force = D[i];
#pragma GCC unroll 3
      for (int j = 0; j < Dim; ++j) {
        const int ij = Record::P + i * Dim + j;
        force += pairs.own(ij) * C_ab[j];
        force -= pairs.neighbour(ij) * C_ba[j];
      }
      sums.force[i] += force;
      add_to(their_sums + i * stride, -force);
      sums.power += plain[i] * D[i];
    }
    if (sweep.with_bound) {
      sums.rate += rate_of<Dim>(C_ab, pairs);
      add_to(their_sums + Dim * stride, rate_of<Dim>(C_ba, pairs));
    }
  }
  block.sums = sums;
  block.geometry = geometry;
  block.chunk = end;
}

/// Chunks from c on, before `end`, whose offsets are consecutive: they read the same cache lines.
template <int Dim>
DIPTYCH_INLINE std::int64_t consecutive_offsets(const MutualPairs<Dim>& mutual,
                                                std::int64_t c,
                                                std::int64_t end) {
  const std::int32_t* offset = mutual.offset.data();
  std::int64_t n = 1;
  while (c + n < end && offset[c + n] == offset[c] + n)
    ++n;
  return n;
}

/// Whether the pairs of blocks b and b + 1 are at the same offsets.
template <int Dim>
DIPTYCH_INLINE bool same_offsets(const MutualPairs<Dim>& mutual, std::int64_t b) {
  const std::int64_t first = mutual.row[b], next = mutual.row[b + 1], n = next - first;
  return mutual.row[b + 2] - next == n &&
         __builtin_memcmp(mutual.offset.data() + first, mutual.offset.data() + next,
                          static_cast<size_t>(n) * sizeof(std::int32_t)) == 0;
}

/// Runs: forces of the pairs of blocks [b, end) with nodes above them, added to both: of two blocks
/// together where their pairs are at the same offsets, since their neighbours share cache lines.
/// @return their numerical dissipation [W]; moves b on
template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE double add_forces_of_next(const MomentumSweep<Dim>& sweep,
                                         std::int64_t& b,
                                         std::int64_t end) {
  using Record = NodeRecord<Dim>;
  constexpr bool exact = kind.impedance == Impedance::exact;
  const SweepGraph<Dim>& graph = sweep.graph;
  const MutualPairs<Dim>& mutual = graph.mutual;
  const int n_blocks = b + 1 < end && same_offsets(mutual, b) ? 2 : 1;
  const std::int64_t last = mutual.row[b + 1];
  WorkedBlock<Dim> blocks[2] = {{mutual, b}, {mutual, b + n_blocks - 1}};
  if (blocks[0].chunk < last) {
    for (int k = 0; k < n_blocks; ++k) {
      const std::int64_t offset = mutual.offset[last - 1];
      prefetch_ahead<Record::n(exact)>(sweep.state.records, b + k, offset);
      prefetch_ahead<Dim>(sweep.state.v, b + k, offset);
      prefetch_ahead<Dim>(graph.X, b + k, offset);
    }
  }
  while (blocks[0].chunk < last) {
    const std::int64_t n = consecutive_offsets(mutual, blocks[0].chunk, last);
    for (int k = 0; k < n_blocks; ++k)
      work_chunks<isa, Dim, kind, has_H>(sweep, n, blocks[k]);
  }
  double power = 0;
  const std::int64_t stride = sweep.state.T.component_stride();
  for (int k = 0; k < n_blocks; ++k) {
    const NodeSums<Dim>& sums = blocks[k].sums;
    double* const own_sums = sweep.state.T.origin() + (b + k) * n_lanes;
    for (int i = 0; i < Dim; ++i)
      add_to(own_sums + i * stride, sums.force[i]);
    if (sweep.with_bound) add_to(own_sums + Dim * stride, sums.rate);
    power += 0.5 * algebra::lane_sum(sums.power);
  }
  b += n_blocks;
  return power;
}

template <InstructionSet isa, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void forces_on_blocks(const MomentumSweep<Dim>& sweep,
                                     std::int64_t begin,
                                     std::int64_t end,
                                     std::int64_t chunk) {
  double power = 0, rate = 0;
  if (sweep.graph.shape.arrangement == Arrangement::runs) {
    for (std::int64_t b = begin; b < end;)
      power += add_forces_of_next<isa, Dim, kind, has_H>(sweep, b, end);
  } else {
    for (std::int64_t b = begin; b < end; ++b)
      power += forces_on_block<isa, Dim, kind, has_H>(sweep, b, rate);
  }
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
