#pragma once
/// A sweep over pairs in the precision of the state and for every instruction set: for the headers
/// beside this one.

#include "common/algebra/versions.hpp"
#include "common/scheme/sweeps/momentum.hpp"

namespace diptych::scheme {

using algebra::InstructionSet;

/// @tparam Work  has run<isa, Real>(sweep, begin, end, chunk)
template <int Dim, DissipationKind kind, class Work>
struct PairSweep {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const MomentumSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t chunk) {
    const algebra::FlushToZero flush(sweep.body.is_single());
    if constexpr (has_single_precision(kind)) {
      if (sweep.body.is_single()) {
        Work::template run<isa, float>(sweep, begin, end, chunk);
        return;
      }
    }
    Work::template run<isa, double>(sweep, begin, end, chunk);
  }
};

template <int Dim, DissipationKind kind, class Work>
using PairSweepVersions = algebra::Versions<PairSweep<Dim, kind, Work>,
                                            const MomentumSweep<Dim>&,
                                            std::int64_t,
                                            std::int64_t,
                                            std::int64_t>;

}  // namespace diptych::scheme
