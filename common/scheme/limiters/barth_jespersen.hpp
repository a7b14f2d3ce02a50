#pragma once
/// Limiter of Barth and Jespersen (AIAA 89-0366): the value reconstructed at the face stays between
/// those of the neighbours, phi = min(1, y), y = (largest change to a neighbour) / (change to the
/// face); zero at an extremum. The sharpest: fronts of `impact` overshoot by some 3 %.

#include "common/algebra/lanes.hpp"

namespace diptych::scheme {

struct BarthJespersen {
  /// @param  forward, backward  jumps to both sides; the mean slope is half of their sum
  DIPTYCH_INLINE static algebra::Lanes factor(const algebra::Lanes& forward,
                                              const algebra::Lanes& backward) {
    const algebra::Lanes f = algebra::magnitude(forward), b = algebra::magnitude(backward);
    const algebra::Lanes y = algebra::ratio_or_zero(4.0 * algebra::smaller(f, b), f + b);
    const algebra::Lanes phi = algebra::smaller(y, algebra::Lanes{} + 1.0);
    return (forward > 0) == (backward > 0) ? phi : algebra::Lanes{};
  }
};

}  // namespace diptych::scheme
