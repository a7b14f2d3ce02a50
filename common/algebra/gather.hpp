#pragma once
/// Eight rows of memory, to and from one vector per component. Four components at a time: a row is
/// read as four numbers and the 8x4 block is transposed with shuffles. On AVX-512, and of singles,
/// rows k and k+4 share a register (8 shuffles and 4 loads with insertion per 32 values, against 7
/// shuffles per 8 values of a plain element-wise gather).

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

template <class Real>
struct QuadOf;
template <>
struct QuadOf<double> {
  using type = HalfLanes;
};
template <>
struct QuadOf<float> {
  using type = float __attribute__((vector_size(4 * sizeof(float))));
};
/// Four of Real = double or float.
template <class Real>
using Quad = typename QuadOf<Real>::type;

template <class Real>
DIPTYCH_INLINE Quad<Real> load_quad(const Real* p) {
  Quad<Real> r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}

template <class Real>
DIPTYCH_INLINE Pack<Real> joined_quads(const Quad<Real>& low, const Quad<Real>& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Transposes four rows of four: column c of rows 0..3.
template <class Quad>
DIPTYCH_INLINE void transpose_quads(const Quad (&row)[4], Quad (&column)[4]) {
  const Quad t0 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
  const Quad t1 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
  const Quad t2 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
  const Quad t3 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
  column[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
  column[1] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
  column[2] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
  column[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

/// Components c..c+3 of eight rows into r[0..3].
template <InstructionSet isa>
DIPTYCH_INLINE void gather_four(const double* const* row, int c, Lanes* r) {
  const auto quad = [&](int k) DIPTYCH_INLINE_LAMBDA { return load_quad(row[k] + c); };
  if constexpr (isa == InstructionSet::avx512) {
    const Lanes r0 = joined_quads<double>(quad(0), quad(4));
    const Lanes r1 = joined_quads<double>(quad(1), quad(5));
    const Lanes r2 = joined_quads<double>(quad(2), quad(6));
    const Lanes r3 = joined_quads<double>(quad(3), quad(7));
    const Lanes t0 = __builtin_shufflevector(r0, r1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes t1 = __builtin_shufflevector(r0, r1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes t2 = __builtin_shufflevector(r2, r3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes t3 = __builtin_shufflevector(r2, r3, 1, 9, 3, 11, 5, 13, 7, 15);
    r[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
    r[1] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
    r[2] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
    r[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
  } else {
    const HalfLanes low[4] = {quad(0), quad(1), quad(2), quad(3)};
    const HalfLanes high[4] = {quad(4), quad(5), quad(6), quad(7)};
    HalfLanes column_low[4], column_high[4];
    transpose_quads(low, column_low);
    transpose_quads(high, column_high);
    for (int k = 0; k < 4; ++k)
      r[k] = joined_quads<double>(column_low[k], column_high[k]);
  }
}
template <InstructionSet isa>
DIPTYCH_INLINE void gather_four(const float* const* row, int c, SingleLanes* r) {
  const auto pair = [&](int k) DIPTYCH_INLINE_LAMBDA {
    return joined_quads<float>(load_quad(row[k] + c), load_quad(row[k + 4] + c));
  };
  const SingleLanes r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
  const SingleLanes t0 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
  const SingleLanes t1 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
  const SingleLanes t2 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
  const SingleLanes t3 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
  r[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
  r[1] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
  r[2] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
  r[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// The first n components of eight rows. Reads up to the next multiple of four.
template <InstructionSet isa, int n, class Real>
DIPTYCH_INLINE void gather(const Real* const* row, Pack<Real>* r) {
#pragma GCC unroll 16
  for (int c = 0; c < n; c += 4)
    gather_four<isa>(row, c, r + c);
}

/// Four components of eight rows that are `stride` apart, from columns[0..3].
template <class Real>
DIPTYCH_INLINE void scatter_four(const Pack<Real>* columns, Real* rows, std::int64_t stride) {
  Quad<Real> low[4], high[4], row[4];
#pragma GCC unroll 4
  for (int c = 0; c < 4; ++c) {
    low[c] = __builtin_shufflevector(columns[c], columns[c], 0, 1, 2, 3);
    high[c] = __builtin_shufflevector(columns[c], columns[c], 4, 5, 6, 7);
  }
  transpose_quads(low, row);
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k)
    __builtin_memcpy(rows + k * stride, &row[k], sizeof row[k]);
  transpose_quads(high, row);
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k)
    __builtin_memcpy(rows + (k + 4) * stride, &row[k], sizeof row[k]);
}

// GCC 12 takes the first of eight writes to the lanes of a vector for a use of all of it.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
/// Components 0..n-1 of eight rows that are `stride` apart; no other is read.
template <int n, class Real>
DIPTYCH_INLINE void read_rows(const Real* rows, std::int64_t stride, Pack<Real>* columns) {
  constexpr int by_four = n / 4 * 4;
  const Real* row[n_lanes];
  for (int lane = 0; lane < n_lanes; ++lane)
    row[lane] = rows + lane * stride;
  if constexpr (by_four > 0) gather<InstructionSet::baseline, by_four>(row, columns);
#pragma GCC unroll 4
  for (int c = by_four; c < n; ++c) {
#pragma GCC unroll 8
    for (int lane = 0; lane < n_lanes; ++lane)
      columns[c][lane] = row[lane][c];
  }
}
#pragma GCC diagnostic pop
/// Writes them.
template <int n, class Real>
DIPTYCH_INLINE void write_rows(const Pack<Real>* columns, std::int64_t stride, Real* rows) {
  constexpr int by_four = n / 4 * 4;
#pragma GCC unroll 4
  for (int c = 0; c < by_four; c += 4)
    scatter_four(columns + c, rows + c, stride);
#pragma GCC unroll 4
  for (int c = by_four; c < n; ++c) {
#pragma GCC unroll 8
    for (int lane = 0; lane < n_lanes; ++lane)
      rows[lane * stride + c] = columns[c][lane];
  }
}

}  // namespace diptych::algebra
