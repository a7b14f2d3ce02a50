#pragma once
/// Godunov-type dissipation D_ab of (18a), for eight pairs at once (notes 3.4):
///   D_ab = 1/2 |S_ab| Z_ab (v_b^rec - v_a^rec),  S_ab = 1/2 (C_ab - C_ba),
/// so D_ab = -D_ba. Entropy production of the pair: (v_b - v_a) . D_ab.
/// Impedance: isotropic, Z = z_p n(x)n + z_s (I - n(x)n) with n along (H_a + H_b) S_ab and the node
/// means of z = rho_R c from the exact largest speeds; or exact, (rho_R Q(N))^(1/2) of the mean
/// state of the pair with all branches. Limiters: one file each in limiters/.

#include "common/algebra/layout.hpp"
#include "common/physics/wave_speeds.hpp"

#define DIPTYCH_LIMITER(name, id, Type)  // the headers
#include "common/scheme/dissipation/limiters/limiters.def"
#undef DIPTYCH_LIMITER

namespace diptych::scheme {

enum class Reconstruction {
  none,
  linear,     ///< with slopes: velocities linear in X have no jump
  objective,  ///< linear, and in the frame that spins with the pair (notes 3.4): nor have rigid
              ///< spins
  symmetric   ///< linear, with the adjoint of the slopes (sweeps/jump_adjoint.hpp)
};
/// What a case asks for: with the slopes of (18b) ("linear"), with those along lines of nodes where
/// the graph has them ("quartic", meshes/line_slopes.hpp), or what suits graph and limiter.
enum class ReconstructionChoice { automatic, none, linear, quartic, objective, symmetric };

enum class PairLimiter {
#define DIPTYCH_LIMITER(name, id, Type) id,
#include "common/scheme/dissipation/limiters/limiters.def"
#undef DIPTYCH_LIMITER
};
enum class Impedance { isotropic, exact };

/// use.operator()<limiter, Type>() of the one that is asked for.
template <class Use>
constexpr auto with_limiter(PairLimiter limiter, const Use& use) {
  switch (limiter) {
#define DIPTYCH_LIMITER(name, id, Type) \
  case PairLimiter::id:                 \
    return use.template operator()<PairLimiter::id, Type>();
#include "common/scheme/dissipation/limiters/limiters.def"
#undef DIPTYCH_LIMITER
  }
  __builtin_unreachable();
}

/// Limiters that are a function of the slopes of both nodes.
constexpr bool limits_slopes(PairLimiter limiter) {
  return with_limiter(limiter, []<PairLimiter, class Limiter>() { return Limiter::of_slopes; });
}

template <PairLimiter limiter>
struct LimiterType;
#define DIPTYCH_LIMITER(name, id, Type_) \
  template <>                            \
  struct LimiterType<PairLimiter::id> {  \
    using Type = Type_;                  \
  };
#include "common/scheme/dissipation/limiters/limiters.def"
#undef DIPTYCH_LIMITER
template <PairLimiter limiter>
using LimiterOf = typename LimiterType<limiter>::Type;

/// Largest D_ab over that of the same jump without limiter.
constexpr double strength_of(PairLimiter limiter) {
  return limits_slopes(limiter) ? largest_strength : 1;
}

/// What is compiled into a momentum sweep.
struct DissipationKind {
  Reconstruction reconstruction = Reconstruction::linear;
  PairLimiter limiter = PairLimiter::none;
  Impedance impedance = Impedance::isotropic;
};

/// Whether it is compiled: the objective reconstruction with the isotropic impedance and without
/// slope limiters, whose jumps have a known sign in the spinning frame only; the symmetric one,
/// which has a sign, without limiters.
constexpr bool is_compiled(const DissipationKind& kind) {
  return kind.reconstruction == Reconstruction::linear ||
         ((kind.reconstruction == Reconstruction::none ||
           kind.reconstruction == Reconstruction::symmetric) &&
          kind.limiter == PairLimiter::none) ||
         (kind.reconstruction == Reconstruction::objective && !limits_slopes(kind.limiter) &&
          kind.impedance == Impedance::isotropic);
}

/// Whether it is compiled for states in single precision: the square root of the acoustic tensor
/// is not.
constexpr bool has_single_precision(const DissipationKind& kind) {
  return kind.impedance == Impedance::isotropic;
}

/// Z of isotropic form applied to a jump: z_s jump + (z_p - z_s) h (h . jump)/(h . h).
template <int Dim, class T>
DIPTYCH_INLINE Vector<T> isotropic_impedance_times(const T& z_p,
                                                   const T& z_s,
                                                   const Vector<T>& h,
                                                   const Vector<T>& jump) {
  T h_jump{}, h_h{};
  for (int i = 0; i < Dim; ++i) {
    h_jump += h[i] * jump[i];
    h_h += h[i] * h[i];
  }
  const T along = (z_p - z_s) * h_jump * algebra::inverse_or_zero(h_h);
  Vector<T> D{};
  for (int i = 0; i < Dim; ++i)
    D[i] = z_s * jump[i] + along * h[i];
  return D;
}

}  // namespace diptych::scheme
