#pragma once
/// Whether values of eight nodes are positive, for checks that are made everywhere. Test:
/// tests/common/algebra/lanes_test.cpp

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

/// Lanes in which all of some values are positive. By halves: of a comparison of eight doubles GCC
/// 12 makes eight with AVX2, and of what is made of several comparisons a hundred instructions.
class PositiveLanes {
 public:
  /// And those of a; not those where it is NaN.
  DIPTYCH_INLINE void keep(const Lanes& a) {
    low_ &= __builtin_shufflevector(a, a, 0, 1, 2, 3) > 0;
    high_ &= __builtin_shufflevector(a, a, 4, 5, 6, 7) > 0;
  }
  DIPTYCH_INLINE bool all() const {
    const Mask both = low_ & high_;
    return (both[0] & both[1] & both[2] & both[3]) != 0;
  }
  bool at(int lane) const { return (lane < 4 ? low_[lane] : high_[lane - 4]) != 0; }

 private:
  using Mask = decltype(HalfLanes{} > 0);
  Mask low_ = Mask{} - 1, high_ = low_;
};

}  // namespace diptych::algebra
