#pragma once
/// Limiter of Venkatakrishnan (J. Comput. Phys. 118, 1995), without his threshold (K = 0, so that
/// no scale of velocity is needed): phi = (y^2 + 2 y) / (y^2 + y + 2), y as for Barth and
/// Jespersen, here y <= 2. Smooth, hence it limits earlier: fronts of `impact` overshoot by less
/// than 1 % down to a compression of 0.7.

#include "common/algebra/lanes.hpp"

namespace diptych::scheme {

struct Venkatakrishnan {
  /// @param  forward, backward  jumps to both sides; the mean slope is half of their sum
  template <class T>
  DIPTYCH_INLINE static T factor(const T& forward, const T& backward) {
    const T f = algebra::magnitude(forward), b = algebra::magnitude(backward);
    const T y = algebra::ratio_or_zero<T>(4.0 * algebra::smaller(f, b), f + b);
    const T phi = (y * y + 2.0 * y) / (y * y + y + 2.0);
    return (forward > 0) == (backward > 0) ? phi : T{};
  }
};

}  // namespace diptych::scheme
