#pragma once
/// The sweeps of jump_adjoint.hpp that are compiled: for the files that compile them
/// (sweeps/compiled/jump_adjoint_*.cpp) and for tests.

#include "common/algebra/versions.hpp"
#include "common/scheme/sweeps/jump_adjoint.hpp"

namespace diptych::scheme {

template <InstructionSet isa, class Real, int Dim, DissipationKind kind, bool has_H>
DIPTYCH_INLINE void moments_in(const MomentumSweep<Dim>& sweep,
                               std::int64_t begin,
                               std::int64_t end) {
  const algebra::FlushToZero flush(sweep.body.is_single());
  const bool runs = sweep.body.graph.shape.arrangement == Arrangement::runs;
  for (std::int64_t b = begin; b < end; ++b) {
    if (runs) {
      add_moments_of_block<algebra::Pack<Real>, Dim, kind, has_H>(sweep, b);
    } else {
      put_moments_of_block<isa, Real, Dim, kind, has_H>(sweep, b);
    }
  }
}

template <int Dim, DissipationKind kind, bool has_H>
struct MomentsKernel {
  /// In the precision of the state.
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const MomentumSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t) {
    if constexpr (has_single_precision(kind)) {
      if (sweep.body.is_single()) {
        moments_in<isa, float, Dim, kind, has_H>(sweep, begin, end);
        return;
      }
    }
    moments_in<isa, double, Dim, kind, has_H>(sweep, begin, end);
  }
};

/// The sweep of one impedance for this processor.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> moments_sweep_of() {
  constexpr DissipationKind kind{Reconstruction::symmetric, PairLimiter::none, impedance};
  return algebra::version_here<
      algebra::Versions<MomentsKernel<Dim, kind, has_H>, const MomentumSweep<Dim>&, std::int64_t,
                        std::int64_t, std::int64_t>>();
}

}  // namespace diptych::scheme
