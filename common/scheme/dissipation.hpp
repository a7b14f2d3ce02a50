#pragma once
/// Godunov-type dissipation D_ab of (18a), for eight pairs at once (physics note 3.4):
///   D_ab = 1/2 |S_ab| Z_ab (v_b^rec - v_a^rec),  S_ab = 1/2 (C_ab - C_ba),
/// so D_ab = -D_ba. Entropy production of the pair: (v_b - v_a) . D_ab.
/// Impedance: isotropic, Z = z_p n(x)n + z_s (I - n(x)n) with n along (H_a + H_b) S_ab and the node
/// means of z = rho_R c from the exact largest speeds; or exact, (rho_R Q(N))^(1/2) of the mean
/// state of the pair with all branches.

#include "common/algebra/layout.hpp"
#include "common/physics/wave_speeds.hpp"

namespace diptych::scheme {

using algebra::Lanes;
using algebra::Vector;

enum class Reconstruction { none, linear };
enum class PairLimiter { none, sign_preserving };
enum class Impedance { isotropic, exact };

/// What is compiled into a momentum sweep.
struct DissipationKind {
  Reconstruction reconstruction = Reconstruction::linear;
  PairLimiter limiter = PairLimiter::none;
  Impedance impedance = Impedance::isotropic;
};

/// A jump split along n and across it: both parts keep their sign against the plain jump and do not
/// exceed it, so that every pair dissipates; affine fields are untouched (their jump is zero).
template <int Dim>
DIPTYCH_INLINE void limit_sign_preserving(Vector<Lanes>& jump,
                                          const Vector<Lanes>& plain,
                                          const Vector<Lanes>& n) {
  Lanes jump_n{}, plain_n{};
  for (int i = 0; i < Dim; ++i) {
    jump_n += jump[i] * n[i];
    plain_n += plain[i] * n[i];
  }
  Lanes along{}, jump_2{}, plain_2{};
  Vector<Lanes> jump_t{};
  for (int i = 0; i < Dim; ++i) {
    jump_t[i] = jump[i] - jump_n * n[i];
    const Lanes plain_t = plain[i] - plain_n * n[i];
    along += jump_t[i] * plain_t;
    jump_2 += jump_t[i] * jump_t[i];
    plain_2 += plain_t * plain_t;
  }
  const Lanes zero{};
  const Lanes magnitude_n =
      algebra::smaller(algebra::magnitude(jump_n), algebra::magnitude(plain_n));
  const Lanes limited_n = jump_n * plain_n > 0 ? (plain_n > 0 ? magnitude_n : -magnitude_n) : zero;
  const Lanes ratio = algebra::square_root(plain_2 * algebra::inverse_or_zero(jump_2));
  const Lanes scale_t = along > 0 ? algebra::smaller(ratio, zero + 1.0) : zero;
  for (int i = 0; i < Dim; ++i)
    jump[i] = limited_n * n[i] + scale_t * jump_t[i];
}

/// Z of isotropic form applied to a jump: z_s jump + (z_p - z_s) h (h . jump)/(h . h).
template <int Dim>
DIPTYCH_INLINE Vector<Lanes> isotropic_impedance_times(const Lanes& z_p,
                                                       const Lanes& z_s,
                                                       const Vector<Lanes>& h,
                                                       const Vector<Lanes>& jump) {
  Lanes h_jump{}, h_h{};
  for (int i = 0; i < Dim; ++i) {
    h_jump += h[i] * jump[i];
    h_h += h[i] * h[i];
  }
  const Lanes along = (z_p - z_s) * h_jump * algebra::inverse_or_zero(h_h);
  Vector<Lanes> D{};
  for (int i = 0; i < Dim; ++i)
    D[i] = z_s * jump[i] + along * h[i];
  return D;
}

}  // namespace diptych::scheme
