#include "common/scheme/sweeps/face_correction.hpp"

#include "common/algebra/versions.hpp"
#include "common/scheme/sweeps/strain_sum.hpp"

#include <cmath>

namespace diptych::scheme {

namespace {

/// Uncorrected rates of blocks [begin, end), to where neighbours gather them.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void plain_gradients(Body<Dim>& body, std::int64_t begin, std::int64_t end) {
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    Lanes L[Dim * Dim];
    strain_rates_of_block<isa>(body, b, L);
    body.gradients.template put_each<Dim * Dim>(b, 0,
                                                [&](int k) DIPTYCH_INLINE_LAMBDA { return L[k]; });
  }
}

template <int Dim>
struct GradientKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(Body<Dim>& body, std::int64_t begin, std::int64_t end) {
    plain_gradients<isa>(body, begin, end);
  }
};
template <int Dim>
struct StressKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(Body<Dim>& body,
                                 double kappa_f,
                                 std::int64_t begin,
                                 std::int64_t end) {
    correct_stresses<isa>(body, kappa_f, begin, end);
  }
};

}  // namespace

double frequency_factor(double kappa_f) {
  if (kappa_f == 0) return 1;
  // derivative zero: c + 2 k (c - 2 c^2 + 1) = 0 with c = cos(theta) < 0
  const double k2 = 2 * kappa_f, p = 1 + k2;
  const double c = (p - std::sqrt(p * p + 8 * k2 * k2)) / (4 * k2);
  return std::sqrt(1 - c * c) * (1 + k2 * (1 - c));
}

template <int Dim>
FaceCorrectionSweeps<Dim> face_correction_sweeps() {
  using algebra::version_here;
  using algebra::Versions;
  using Index = std::int64_t;
  return {version_here<Versions<GradientKernel<Dim>, Body<Dim>&, Index, Index>>(),
          version_here<Versions<StressKernel<Dim>, Body<Dim>&, double, Index, Index>>()};
}

template FaceCorrectionSweeps<2> face_correction_sweeps<2>();
template FaceCorrectionSweeps<3> face_correction_sweeps<3>();

}  // namespace diptych::scheme
