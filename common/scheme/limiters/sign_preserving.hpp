#pragma once
/// Sign-preserving limiter (physics note 3.4): a reconstructed jump is split along n and across it;
/// both parts keep their sign against the plain jump and do not exceed it, so that every pair
/// dissipates. It is a guard of the entropy, not a shock-capturing limiter: where the signs differ,
/// as at the ripples behind a front, it takes the dissipation away instead of adding some.

#include "common/algebra/layout.hpp"

namespace diptych::scheme {

using algebra::Lanes;
using algebra::Vector;

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

}  // namespace diptych::scheme
