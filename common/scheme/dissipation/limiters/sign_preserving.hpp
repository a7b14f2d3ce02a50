#pragma once
/// Sign-preserving limiter (notes 3.4): a reconstructed jump is split along n and across it;
/// each part is replaced by its projection on that part of the plain jump, kept between nothing and
/// all of it. Every pair then dissipates with any impedance that has the eigenvector n, isotropic
/// or exact; affine fields are untouched (their jump is zero). It is a guard of the entropy, not a
/// shock-capturing limiter: where the signs differ, as at the ripples behind a front, it takes the
/// dissipation away instead of adding some.

#include "common/algebra/layout.hpp"

namespace diptych::scheme {

using algebra::Vector;

template <int Dim, class T>
DIPTYCH_INLINE void limit_sign_preserving(Vector<T>& jump,
                                          const Vector<T>& plain,
                                          const Vector<T>& n) {
  const T zero{}, one = zero + 1.0F;
  T jump_n{}, plain_n{};
  for (int i = 0; i < Dim; ++i) {
    jump_n += jump[i] * n[i];
    plain_n += plain[i] * n[i];
  }
  T along{}, plain_2{};
  Vector<T> plain_t{};
  for (int i = 0; i < Dim; ++i) {
    plain_t[i] = plain[i] - plain_n * n[i];
    along += (jump[i] - jump_n * n[i]) * plain_t[i];
    plain_2 += plain_t[i] * plain_t[i];
  }
  const T magnitude_n = algebra::smaller(algebra::magnitude(jump_n), algebra::magnitude(plain_n));
  const T limited_n = jump_n * plain_n > 0 ? (plain_n > 0 ? magnitude_n : -magnitude_n) : zero;
  const T share = algebra::smaller(along * algebra::inverse_or_zero(plain_2), one);
  const T share_t = along > 0 ? share : zero;
  for (int i = 0; i < Dim; ++i)
    jump[i] = limited_n * n[i] + share_t * plain_t[i];
}

struct SignPreserving {
  static constexpr bool of_slopes = false;
  template <int Dim, class T>
  DIPTYCH_INLINE static Vector<T> limited(const Vector<T>& reconstructed,
                                          const Vector<T>& plain,
                                          const Vector<T>&,
                                          const Vector<T>&,
                                          const Vector<T>& n) {
    Vector<T> jump = reconstructed;
    limit_sign_preserving<Dim>(jump, plain, n);
    return jump;
  }
};

}  // namespace diptych::scheme
