#pragma once
/// The momentum sweeps that are compiled, by instruction set and kind of dissipation: for the files
/// that compile them (sweeps/momentum_*.cpp) and for tests.

#include "common/algebra/versions.hpp"
#include "common/scheme/sweeps/momentum_rows.hpp"
#include "common/scheme/sweeps/momentum_runs.hpp"

namespace diptych::scheme {

template <InstructionSet isa, class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void forces_in(const MomentumSweep<Dim>& sweep,
                              std::int64_t begin,
                              std::int64_t end,
                              std::int64_t chunk) {
  const algebra::FlushToZero flush(sweep.body.is_single());
  ChunkSums total;
  if (sweep.body.graph.shape.arrangement == Arrangement::runs) {
    for (std::int64_t b = begin; b < end;)
      add_forces_of_next<Real, Dim, kind, has_H>(sweep, b, end, total);
  } else {
    for (std::int64_t b = begin; b < end; ++b)
      forces_on_block<isa, Real, Dim, kind, has_H>(sweep, b, total);
  }
  sweep.numerical_power[chunk] = total.power;
  sweep.largest_rate[chunk] = total.rate;
  sweep.limited_pairs[chunk] = total.limited;
}

template <int Dim, DissipationKind kind, bool has_H>
struct MomentumKernel {
  /// In the precision of the state.
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const MomentumSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t chunk) {
    if constexpr (has_single_precision(kind)) {
      if (sweep.body.is_single()) {
        forces_in<isa, float, Dim, kind, has_H>(sweep, begin, end, chunk);
        return;
      }
    }
    forces_in<isa, double, Dim, kind, has_H>(sweep, begin, end, chunk);
  }
};
template <int Dim, DissipationKind kind, bool has_H>
using MomentumVersions = algebra::Versions<MomentumKernel<Dim, kind, has_H>,
                                           const MomentumSweep<Dim>&,
                                           std::int64_t,
                                           std::int64_t,
                                           std::int64_t>;

/// The sweep of one kind for this processor.
template <int Dim, DissipationKind kind, bool has_H>
MomentumFunction<Dim> momentum_sweep() {
  return algebra::version_here<MomentumVersions<Dim, kind, has_H>>();
}

/// Sweeps of a reconstruction with one impedance, by limiter; null where there is none.
template <int Dim, Reconstruction reconstruction, Impedance impedance, bool has_H>
MomentumFunction<Dim> limited_sweep(PairLimiter limiter) {
  return with_limiter(limiter, []<PairLimiter which, class>() -> MomentumFunction<Dim> {
    constexpr DissipationKind kind{reconstruction, which, impedance};
    if constexpr (is_compiled(kind)) {
      return momentum_sweep<Dim, kind, has_H>();
    } else {
      return nullptr;
    }
  });
}

template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> momentum_sweep_of(const DissipationKind& kind) {
  switch (kind.reconstruction) {
    case Reconstruction::none:
      return limited_sweep<Dim, Reconstruction::none, impedance, has_H>(kind.limiter);
    case Reconstruction::linear:
      return limited_sweep<Dim, Reconstruction::linear, impedance, has_H>(kind.limiter);
    case Reconstruction::symmetric:
      return limited_sweep<Dim, Reconstruction::symmetric, impedance, has_H>(kind.limiter);
    case Reconstruction::objective:
      break;
  }
  return limited_sweep<Dim, Reconstruction::objective, impedance, has_H>(kind.limiter);
}

}  // namespace diptych::scheme
