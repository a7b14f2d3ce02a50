#pragma once
/// What the momentum sweep makes of eight pairs, in rows and in runs alike: the jump of the
/// velocities, reconstructed and limited, 2 D_ab, and the rate of the graph CFL. Part of
/// momentum.hpp.

#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/sweeps/frames.hpp"
#include "common/scheme/sweeps/momentum.hpp"
#include "common/scheme/sweeps/pair_access.hpp"

#include <type_traits>

namespace diptych::scheme {

/// Sums of nodes over their pairs. T, here and below: Lanes, SingleLanes or WideSingles.
template <int Dim, class T>
struct NodeSums {
  T force[Dim] = {};  ///< 2 T; in rows without P_a sum C_ab
  T power{};          ///< sum (v_b - v_a) . |S| Z jump
  T rate{};           ///< sum |C_ab| z_ab
};
template <int Dim, class T>
struct CountedSums : NodeSums<Dim, T> {
  T limited{};  ///< pairs whose jump the limiter has changed by limited_share
};
/// With a count where there is a limiter.
template <int Dim, PairLimiter limiter, class T>
using SumsWith =
    std::conditional_t<limiter == PairLimiter::none, NodeSums<Dim, T>, CountedSums<Dim, T>>;

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
      const double one = i == j ? 1 : 0;
      X.F(i, j) = mean(Record::F + i * Dim + j) + one;
      X.H(i, j) = mean(Record::H + i * Dim + j) + one;
    }
  }
  if constexpr (Dim == 2) X.F(2, 2) = Lanes{} + 1.0;
  r.A_tot = SymmetricTensor<Lanes>{};
  r.S_tot = SymmetricTensor<Lanes>{};
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k)
    r.A_tot.s[algebra::order_of_A<Dim>[k]] = mean(Record::A_tot + k);
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k)
    r.S_tot.s[algebra::order_of_S<Dim>[k]] = mean(Record::S_tot + k);
  r.W_JJ = mean(Record::W_JJ);
  r.W_FJ = mean(Record::W_FJ);
}

/// L X_ab of both nodes, or only their sum where the limiter needs no more.
template <int Dim, class T>
struct Slopes {
  Vector<T> sum{}, a{}, b{};
};

/// A change of a jump by this share of the plain one counts as limited: smooth limiters change all
/// a little.
inline constexpr float limited_share = 0.01F;

/// v_b^rec - v_a^rec, limited.
/// @param plain    v_b - v_a
/// @param seen     the same, as it is seen in the frame of the slopes
/// @param h        along the normal of the pair in space
/// @param limited  one of pairs that the limiter has changed, zero of others
template <int Dim, PairLimiter limiter, class T>
DIPTYCH_INLINE Vector<T> reconstructed_jump(const Vector<T>& plain,
                                            const Vector<T>& seen,
                                            const Slopes<Dim, T>& slopes,
                                            const Vector<T>& h,
                                            T& limited) {
  Vector<T> jump{};
  for (int i = 0; i < Dim; ++i) {
    const T sum = limits_slopes(limiter) ? slopes.a[i] + slopes.b[i] : slopes.sum[i];
    jump[i] = seen[i] - 0.5 * sum;
  }
  if constexpr (limiter == PairLimiter::none) return jump;
  T h_h{};
  for (int i = 0; i < Dim; ++i)
    h_h += h[i] * h[i];
  const T inverse = algebra::inverse_or_zero(algebra::square_root(h_h));
  Vector<T> n{};
  for (int i = 0; i < Dim; ++i)
    n[i] = h[i] * inverse;
  if constexpr (limiter != PairLimiter::none) {
    const Vector<T> reconstructed = jump;
    jump = LimiterOf<limiter>::template limited<Dim>(jump, plain, slopes.a, slopes.b, n);
    T change{}, size{};
    for (int i = 0; i < Dim; ++i) {
      change += (jump[i] - reconstructed[i]) * (jump[i] - reconstructed[i]);
      size += plain[i] * plain[i];
    }
    limited = change > limited_share * limited_share * size ? T{} + 1.0F : T{};
  }
  return jump;
}

/// Geometry of eight pairs.
template <int Dim, class T>
struct PairGeometry {
  Vector<T> C_ab{}, C_ba{};  ///< m^2; C_ab only where a pair is worked for both of its nodes
  Vector<T> S{};             ///< along S_ab; its length is free
  T area;                    ///< m^2, |S_ab|
};

/// Z of the mean state of eight pairs applied to a jump.
template <int Dim, bool has_H, class Pairs>
DIPTYCH_INLINE Vector<Lanes> exact_impedance_times(double rho_R,
                                                   const PairGeometry<Dim, Lanes>& pair,
                                                   const Pairs& pairs,
                                                   const Vector<Lanes>& jump) {
  physics::Response<Lanes> response;
  physics::Deformation<Lanes> X;
  mean_state<Dim>(pairs, response, X);
  Lanes S2{};
  for (int i = 0; i < Dim; ++i)
    S2 += pair.S[i] * pair.S[i];
  const Lanes inverse = algebra::inverse_or_zero(algebra::square_root(S2));
  Vector<Lanes> N{};
  for (int i = 0; i < Dim; ++i)
    N[i] = pair.S[i] * inverse;
  if constexpr (Dim == 2) N[1] = pair.area > 0 ? N[1] : Lanes{};
  N[0] = pair.area > 0 ? N[0] : Lanes{} + 1.0;  // padding: any unit vector, its area is zero
  return algebra::product(physics::impedance<has_H>(response, X, rho_R, N), jump);
}

template <int Dim, class T>
struct PairDissipation {
  Vector<T> D{};     ///< 2 D_ab  [N]
  Vector<T> jump{};  ///< of the reconstructions, limited  [m/s]
  T limited{};       ///< one of pairs that the limiter has changed
};

/// D_ab of eight pairs.
/// @param pairs      of the records
/// @param positions  pairs of X
/// @param frames     pairs of Body::frames, where the reconstruction is objective
/// @param plain      v_b - v_a
template <int Dim,
          DissipationKind kind,
          bool has_H,
          class Pairs,
          class Positions,
          class Frames,
          class T>
DIPTYCH_INLINE PairDissipation<Dim, T> dissipation_of(const MomentumSweep<Dim>& sweep,
                                                      const PairGeometry<Dim, T>& pair,
                                                      const Pairs& pairs,
                                                      const Positions& positions,
                                                      const Frames& frames,
                                                      const Vector<T>& plain) {
  using Record = NodeRecord<Dim>;
  Vector<T> h{}, X_ab{};
  for (int j = 0; j < Dim; ++j)
    X_ab[j] = positions.neighbour(j) - positions.own(j);
  Slopes<Dim, T> slopes;
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
    h[i] = pair.S[i] + pair.S[i];  // records hold H - I
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) {
      const int ij = i * Dim + j;
      h[i] += (pairs.neighbour(Record::H + ij) + pairs.own(Record::H + ij)) * pair.S[j];
      if constexpr (kind.reconstruction != Reconstruction::none) {
        if constexpr (limits_slopes(kind.limiter)) {
          slopes.a[i] += pairs.own(Record::L + ij) * X_ab[j];
          slopes.b[i] += pairs.neighbour(Record::L + ij) * X_ab[j];
        } else {
          slopes.sum[i] += (pairs.neighbour(Record::L + ij) + pairs.own(Record::L + ij)) * X_ab[j];
        }
      }
    }
  }
  Vector<T> seen = plain;
  if constexpr (kind.reconstruction == Reconstruction::objective) {
    const SpinningPair<Dim, T> spinning = spinning_pair<Dim>(frames, X_ab);
    for (int i = 0; i < Dim; ++i) {
      seen[i] -= spinning.jump[i];
      slopes.sum[i] -= spinning.slopes[i];
    }
  }
  PairDissipation<Dim, T> of;
  of.jump = reconstructed_jump<Dim, kind.limiter>(plain, seen, slopes, h, of.limited);
  of.limited = pair.area > 0 ? of.limited : T{};  // lanes without a pair
  if constexpr (kind.impedance == Impedance::isotropic) {
    of.D = isotropic_impedance_times<Dim, T>(
        0.5 * (pairs.neighbour(Record::z_p) + pairs.own(Record::z_p)),
        0.5 * (pairs.neighbour(Record::z_s) + pairs.own(Record::z_s)), h, of.jump);
  } else {
    of.D = exact_impedance_times<Dim, has_H>(sweep.body.options.rho_R, pair, pairs, of.jump);
  }
  for (int i = 0; i < Dim; ++i)
    of.D[i] *= static_cast<algebra::Element<T>>(sweep.factor) * pair.area;
  return of;
}

/// Forces of eight pairs on their nodes a.
template <int Dim, class T>
struct PairForces {
  Vector<T> force{};  ///< 2 f_ab  [N]
  T power{};          ///< 2 (v_b - v_a) . D_ab, symmetric: 2 r_ab . D_ab  [W]
  T limited{};        ///< one of limited pairs
};

/// What a chunk sums over its pairs.
struct ChunkSums {
  double power = 0;    ///< W, numerical dissipation
  double rate = 0;     ///< 1/s, the largest of its nodes
  double limited = 0;  ///< pairs, those of rows by halves
};

/// Which stresses a pair force is made of: rows add P_a sum_b C_ab once for all pairs of a node.
enum class Stresses { both, of_neighbour };

/// The pair force of (18a) with the dissipation, for eight pairs:
///   2 f_ab = P_a C_ab - P_b C_ba + 2 D_ab,  f_ba = -f_ab.
template <int Dim,
          DissipationKind kind,
          bool has_H,
          Stresses which,
          class Pairs,
          class Positions,
          class Frames,
          class T>
DIPTYCH_INLINE PairForces<Dim, T> pair_forces(const MomentumSweep<Dim>& sweep,
                                              const PairGeometry<Dim, T>& pair,
                                              const Pairs& pairs,
                                              const Positions& positions,
                                              const Frames& frames,
                                              const Vector<T>& plain) {
  PairForces<Dim, T> f;
  const auto of = dissipation_of<Dim, kind, has_H>(sweep, pair, pairs, positions, frames, plain);
  f.limited = of.limited;
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
    f.force[i] = of.D[i];
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) {
      const int ij = NodeRecord<Dim>::P + i * Dim + j;
      if constexpr (which == Stresses::both) f.force[i] += pairs.own(ij) * pair.C_ab[j];
      f.force[i] -= pairs.neighbour(ij) * pair.C_ba[j];
    }
    f.power += (kind.reconstruction == Reconstruction::symmetric ? of.jump[i] : plain[i]) * of.D[i];
  }
  return f;
}

/// |C| max(z_p,a, z_p,b) of eight pairs.
template <int Dim, class T, class Pairs>
DIPTYCH_INLINE T rate_of(const Vector<T>& C, const Pairs& pairs) {
  using Record = NodeRecord<Dim>;
  T C2{};
  for (int i = 0; i < Dim; ++i)
    C2 += C[i] * C[i];
  return algebra::square_root(C2) *
         algebra::larger(pairs.neighbour(Record::z_p), T{} + pairs.own(Record::z_p));
}

/// Where no frames are read.
struct NoFrames {};

/// v_b - v_a of eight pairs.
/// @param pairs  with v from component c
template <int Dim, class Pairs>
DIPTYCH_INLINE auto plain_jump(const Pairs& pairs, int c) {
  Vector<typename Pairs::T> plain{};
  for (int i = 0; i < Dim; ++i)
    plain[i] = pairs.neighbour(c + i) - pairs.own(c + i);
  return plain;
}

}  // namespace diptych::scheme
