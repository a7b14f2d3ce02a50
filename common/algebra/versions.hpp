#pragma once
/// A function compiled once per instruction set, and the one for this processor. Unlike with
/// DIPTYCH_CLONES the code is told which set it is compiled for, where its gathers differ in form:
///
///   struct Kernel {
///     template <InstructionSet isa>
///     DIPTYCH_INLINE static void run(ARGUMENTS);
///   };
///   auto* run = algebra::version_here<algebra::Versions<Kernel, ARGUMENTS>>();
///
/// Test: tests/common/scheme/sweeps_test.cpp (all versions agree)

#include "common/algebra/lanes.hpp"

namespace diptych::algebra {

template <class Kernel, class... Arguments>
struct Versions {
  using Function = void (*)(Arguments...);
#if defined(DIPTYCH_ONLY_AVX512)
  DIPTYCH_AVX512 static void here(Arguments... arguments) {
    Kernel::template run<InstructionSet::avx512>(arguments...);
  }
#elif defined(DIPTYCH_ONLY_AVX2)
  DIPTYCH_AVX2 static void here(Arguments... arguments) {
    Kernel::template run<InstructionSet::avx2>(arguments...);
  }
#endif
#if defined(DIPTYCH_ONLY_AVX512) || defined(DIPTYCH_ONLY_AVX2)
  static constexpr Function baseline = here, avx2 = here, avx512 = here;
#else
  static void baseline(Arguments... arguments) {
    Kernel::template run<InstructionSet::baseline>(arguments...);
  }
#if defined(DIPTYCH_MULTIVERSION)
  DIPTYCH_AVX2 static void avx2(Arguments... arguments) {
    Kernel::template run<InstructionSet::avx2>(arguments...);
  }
  DIPTYCH_AVX512 static void avx512(Arguments... arguments) {
    Kernel::template run<InstructionSet::avx512>(arguments...);
  }
#endif
#endif
};

/// The version that this processor runs.
template <class AllVersions>
typename AllVersions::Function version_here() {
#if defined(DIPTYCH_ONLY_AVX512) || defined(DIPTYCH_ONLY_AVX2)
  return AllVersions::here;
#else
#if defined(DIPTYCH_MULTIVERSION)
  if (instruction_set() == InstructionSet::avx512) return AllVersions::avx512;
  if (instruction_set() == InstructionSet::avx2) return AllVersions::avx2;
#endif
  return AllVersions::baseline;
#endif
}

}  // namespace diptych::algebra
