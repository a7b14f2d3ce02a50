#pragma once
/// Limiter of Barth and Jespersen (AIAA 89-0366): the value reconstructed at the face stays between
/// those of the neighbours, phi = min(1, y), y = (largest change to a neighbour) / (change to the
/// face); zero at an extremum. The sharpest: fronts of `impact` overshoot by some 3 %.

#include "common/algebra/lanes.hpp"

namespace diptych::scheme {

struct BarthJespersen {
  /// @param  forward, backward  jumps to both sides; the mean slope is half of their sum
  template <class T>
  DIPTYCH_INLINE static T factor(const T& forward, const T& backward) {
    const T f = algebra::magnitude(forward), b = algebra::magnitude(backward);
    const T y = algebra::ratio_or_zero<T>(4.0 * algebra::smaller(f, b), f + b);
    const T phi = algebra::smaller(y, T{} + 1.0F);
    return (forward > 0) == (backward > 0) ? phi : T{};
  }
};

}  // namespace diptych::scheme
