#pragma once
/// A vector of space and a fourth number as one register: set-up loops over pairs take the three
/// components in one operation. What stands in the fourth place is not used.

#include "common/algebra/lanes.hpp"
#include "common/algebra/vectors.hpp"

namespace diptych::algebra {

using Four = double __attribute__((vector_size(4 * sizeof(double))));

DIPTYCH_INLINE Four load_four(const double* p) {
  Four r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}
/// Three numbers; zero in the fourth place.
DIPTYCH_INLINE Four load_three(const double* p) {
  return Four{p[0], p[1], p[2], 0};
}
DIPTYCH_INLINE Four load_three(const Vec3& v) {
  return load_three(v.data());
}
/// The first three places.
DIPTYCH_INLINE void store_three(double* p, const Four& a) {
  p[0] = a[0];
  p[1] = a[1];
  p[2] = a[2];
}
/// Sum of the first three places.
DIPTYCH_INLINE double sum_three(const Four& a) {
  return a[0] + a[1] + a[2];
}

}  // namespace diptych::algebra
