#pragma once
/// The momentum sweeps that are compiled, by instruction set and kind of dissipation: for the files
/// that compile them (momentum_*.cpp) and for tests.

#include "common/scheme/sweeps/compiled/pair_sweep.hpp"
#include "common/scheme/sweeps/momentum_rows.hpp"
#include "common/scheme/sweeps/momentum_runs.hpp"

namespace diptych::scheme {

template <int Dim, DissipationKind kind, bool has_H>
struct ForcesOfBlocks {
  template <InstructionSet isa, class Real>
  DIPTYCH_INLINE static void run(const MomentumSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t chunk) {
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
};
template <int Dim, DissipationKind kind, bool has_H>
using MomentumVersions = PairSweepVersions<Dim, kind, ForcesOfBlocks<Dim, kind, has_H>>;

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
