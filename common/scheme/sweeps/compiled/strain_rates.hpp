#pragma once
/// The strain-rate sweep as it is compiled, for the files of both dimensions and for tests.

#include "common/algebra/versions.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/ranks/division.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"
#include "common/scheme/sweeps/strain_sum.hpp"

namespace diptych::scheme {

/// Asks for the velocities that the pairs of the next blocks will be the first to read.
template <int Dim>
DIPTYCH_INLINE void prefetch_velocities(const Body<Dim>& body, std::int64_t b) {
  for_layers(body.graph.row, body.graph.offset, b, [&](std::int64_t offset) DIPTYCH_INLINE_LAMBDA {
    if (body.is_single()) {
      prefetch_ahead<float, Dim>(body.v, b, offset);
    } else {
      prefetch_ahead<double, Dim>(body.v, b, offset);
    }
  });
}

template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void evaluate_blocks(const StrainRateSweep<Dim>& sweep,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    std::int64_t chunk) {
  Body<Dim>& body = sweep.body;
  const algebra::FlushToZero flush(body.is_single());
  const auto evaluate = block_physics<Dim>(sweep.material).evaluate;
  const bool ahead = body.in_runs() && body.graph.mutual.order.has_large_layers();
  BlockTotals totals;
  for (std::int64_t b = begin; b < end;) {
    Lanes L[2][Dim * Dim];
    int n = 1;
    if (sweep.face_correction == 0) {
      if (ahead) prefetch_velocities(body, b);
      n = strain_rates_of_next<isa>(body, b, end, L);
    } else {
      corrected_block<isa, Side::rates>(body.graph, body.gradients, sweep.face_correction, b, L[0]);
    }
    for (int k = 0; k < n; ++k) {
      if (body.options.has_slopes) {
        Lanes slopes[Dim * Dim];
        slopes_of_block<isa>(body, b + k, slopes);
        body.records.template put_each<Dim * Dim>(
            b + k, NodeRecord<Dim>::L, [&](int c) DIPTYCH_INLINE_LAMBDA { return slopes[c]; });
      }
      evaluate(sweep, b + k, L[k], totals);
    }
    b += n;
  }
  sweep.viscous_dissipation[chunk] = totals.viscous_dissipation;
  if (sweep.old_power != nullptr) sweep.old_power[chunk] = totals.old_power;
  double least = totals.least_J[0];
  for (int l = 1; l < n_lanes; ++l)
    least = algebra::smaller(least, totals.least_J[l]);
  sweep.least_J[chunk] = totals.is_sound ? least : __builtin_nan("");
}

template <int Dim>
struct StrainRateKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const StrainRateSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end,
                                 std::int64_t chunk) {
    evaluate_blocks<isa>(sweep, begin, end, chunk);
  }
};
template <int Dim>
using StrainRateVersions = algebra::Versions<StrainRateKernel<Dim>,
                                             const StrainRateSweep<Dim>&,
                                             std::int64_t,
                                             std::int64_t,
                                             std::int64_t>;

/// The pair sum alone.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void gradients_of_blocks(Body<Dim>& body,
                                        double kappa_f,
                                        std::int64_t begin,
                                        std::int64_t end) {
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    Lanes L[Dim * Dim];
    if (kappa_f == 0) {
      strain_rates_of_block<isa>(body, b, L);
    } else {
      corrected_block<isa, Side::rates>(body.graph, body.gradients, kappa_f, b, L);
    }
    put_velocity_gradient(body, b, L);
  }
}

template <int Dim>
struct PlainGradientKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(Body<Dim>& body,
                                 double kappa_f,
                                 std::int64_t begin,
                                 std::int64_t end) {
    gradients_of_blocks<isa>(body, kappa_f, begin, end);
  }
};

template <int Dim>
void velocity_gradients(Body<Dim>& body, double kappa_f) {
  const auto gradients =
      algebra::version_here<algebra::Versions<PlainGradientKernel<Dim>, Body<Dim>&, double,
                                              std::int64_t, std::int64_t>>();
  const auto for_blocks = [&](const auto& work) {
    parallel::for_chunks(body.part(), body.n_blocks,
                         [&](auto begin, auto end, auto) { work(begin, end); });
  };
  if (kappa_f != 0) {
    for_blocks([&](auto b, auto e) { face_correction_sweeps<Dim>().gradients(body, b, e); });
  }
  for_blocks([&](auto b, auto e) { gradients(body, kappa_f, b, e); });
}

template <int Dim>
StrainRateFunction<Dim> strain_rate_function() {
  return algebra::version_here<StrainRateVersions<Dim>>();
}

template <int Dim>
void evaluate_strain_rates(const StrainRateSweep<Dim>& sweep, Share share) {
  const auto evaluate = strain_rate_function<Dim>();
  for_chunks_of(sweep.body, share,
                [&](auto begin, auto end, auto chunk) { evaluate(sweep, begin, end, chunk); });
}

}  // namespace diptych::scheme
