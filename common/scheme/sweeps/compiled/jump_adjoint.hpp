#pragma once
/// The sweeps of jump_adjoint.hpp that are compiled: for the files that compile them
/// (sweeps/compiled/jump_adjoint_*.cpp) and for tests.

#include "common/scheme/sweeps/compiled/pair_sweep.hpp"
#include "common/scheme/sweeps/jump_adjoint.hpp"

namespace diptych::scheme {

template <int Dim, DissipationKind kind, bool has_H>
struct MomentsOfBlocks {
  template <InstructionSet isa, class Real>
  DIPTYCH_INLINE static void run(const MomentumSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t) {
    const bool runs = sweep.body.graph.shape.arrangement == Arrangement::runs;
    for (std::int64_t b = begin; b < end; ++b) {
      if (runs) {
        add_moments_of_block<algebra::Pack<Real>, Dim, kind, has_H>(sweep, b);
      } else {
        put_moments_of_block<isa, Real, Dim, kind, has_H>(sweep, b);
      }
    }
  }
};

/// The sweep of one impedance for this processor.
template <int Dim, Impedance impedance, bool has_H>
MomentumFunction<Dim> moments_sweep_of() {
  constexpr DissipationKind kind{Reconstruction::symmetric, PairLimiter::none, impedance};
  using Versions = PairSweepVersions<Dim, kind, MomentsOfBlocks<Dim, kind, has_H>>;
  return algebra::version_here<Versions>();
}

}  // namespace diptych::scheme
