#pragma once
/// Gathering records of eight neighbours: rows of memory in, one vector per component out. Four
/// components at a time: a row is read as four doubles and the 8x4 block is transposed with
/// shuffles. On AVX-512 rows k and k+4 share a register (8 shuffles and 4 loads with insertion per
/// 32 values, against 7 shuffles per 8 values of a plain element-wise gather).

#include "common/algebra/lanes.hpp"

#include <cstdint>

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::Lanes;
using algebra::n_lanes;
using algebra::SingleLanes;

using algebra::HalfLanes;

DIPTYCH_INLINE HalfLanes load_half(const double* p) {
  HalfLanes r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}

DIPTYCH_INLINE Lanes joined(const HalfLanes& low, const HalfLanes& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Transposes four rows of four: column c of rows 0..3.
DIPTYCH_INLINE void transpose_half(const HalfLanes (&row)[4], HalfLanes (&column)[4]) {
  const HalfLanes t0 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
  const HalfLanes t1 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
  const HalfLanes t2 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
  const HalfLanes t3 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
  column[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
  column[1] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
  column[2] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
  column[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

using QuadSingles = float __attribute__((vector_size(4 * sizeof(float))));

DIPTYCH_INLINE QuadSingles load_four(const float* p) {
  QuadSingles r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}

/// Rows a and b of singles, four components each.
DIPTYCH_INLINE SingleLanes joined_rows(const float* a, const float* b) {
  return __builtin_shufflevector(load_four(a), load_four(b), 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Components c..c+3 of eight rows into r[0..3], of singles: rows k and k+4 share a register.
template <InstructionSet isa>
DIPTYCH_INLINE void gather_four(const float* const* row, int c, SingleLanes* r) {
  const SingleLanes r0 = joined_rows(row[0] + c, row[4] + c);
  const SingleLanes r1 = joined_rows(row[1] + c, row[5] + c);
  const SingleLanes r2 = joined_rows(row[2] + c, row[6] + c);
  const SingleLanes r3 = joined_rows(row[3] + c, row[7] + c);
  const SingleLanes t0 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
  const SingleLanes t1 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
  const SingleLanes t2 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
  const SingleLanes t3 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
  r[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
  r[1] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
  r[2] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
  r[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Of doubles.
template <InstructionSet isa>
DIPTYCH_INLINE void gather_four(const double* const* row, int c, Lanes* r) {
  if constexpr (isa == InstructionSet::avx512) {
    const Lanes r0 = joined(load_half(row[0] + c), load_half(row[4] + c));
    const Lanes r1 = joined(load_half(row[1] + c), load_half(row[5] + c));
    const Lanes r2 = joined(load_half(row[2] + c), load_half(row[6] + c));
    const Lanes r3 = joined(load_half(row[3] + c), load_half(row[7] + c));
    const Lanes t0 = __builtin_shufflevector(r0, r1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes t1 = __builtin_shufflevector(r0, r1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes t2 = __builtin_shufflevector(r2, r3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes t3 = __builtin_shufflevector(r2, r3, 1, 9, 3, 11, 5, 13, 7, 15);
    r[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
    r[1] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
    r[2] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
    r[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
  } else {
    const HalfLanes low[4] = {load_half(row[0] + c), load_half(row[1] + c), load_half(row[2] + c),
                              load_half(row[3] + c)};
    const HalfLanes high[4] = {load_half(row[4] + c), load_half(row[5] + c), load_half(row[6] + c),
                               load_half(row[7] + c)};
    HalfLanes column_low[4], column_high[4];
    transpose_half(low, column_low);
    transpose_half(high, column_high);
    for (int k = 0; k < 4; ++k)
      r[k] = joined(column_low[k], column_high[k]);
  }
}

/// The first n components of eight rows; n is rounded up to a multiple of four, which rows must
/// hold.
template <InstructionSet isa, int n, class Real>
DIPTYCH_INLINE void gather(const Real* const* row, algebra::Pack<Real>* r) {
#pragma GCC unroll 16
  for (int c = 0; c < n; c += 4)
    gather_four<isa>(row, c, r + c);
}

}  // namespace diptych::scheme
