#pragma once
/// The limiter of the smaller slope, as an example of one that is a function of two slopes.

#include "common/algebra/lanes.hpp"

namespace diptych::scheme {

struct minmod {
  template <class T>
  DIPTYCH_INLINE static T factor(const T& forward, const T& backward) {
    const T f = algebra::magnitude(forward), b = algebra::magnitude(backward);
    const T phi = algebra::ratio_or_zero<T>(2.0 * algebra::smaller(f, b), f + b);
    return (forward > 0) == (backward > 0) ? phi : T{};
  }
};

}  // namespace diptych::scheme
