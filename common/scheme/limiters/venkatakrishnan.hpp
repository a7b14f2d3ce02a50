#pragma once
/// Limiter of Venkatakrishnan (J. Comput. Phys. 118, 1995), without his threshold (K = 0, so that
/// no scale of velocity is needed): phi = (y^2 + 2 y) / (y^2 + y + 2), y as for Barth and
/// Jespersen, here y <= 2. Smooth, hence it limits earlier: fronts of `impact` overshoot by less
/// than 1 % down to a compression of 0.7.

#include "common/algebra/lanes.hpp"

namespace diptych::scheme {

struct Venkatakrishnan {
  /// @param  forward, backward  jumps to both sides; the mean slope is half of their sum
  DIPTYCH_INLINE static algebra::Lanes factor(const algebra::Lanes& forward,
                                              const algebra::Lanes& backward) {
    const algebra::Lanes f = algebra::magnitude(forward), b = algebra::magnitude(backward);
    const algebra::Lanes y = algebra::ratio_or_zero(4.0 * algebra::smaller(f, b), f + b);
    const algebra::Lanes phi = (y * y + 2.0 * y) / (y * y + y + 2.0);
    return (forward > 0) == (backward > 0) ? phi : algebra::Lanes{};
  }
};

}  // namespace diptych::scheme
