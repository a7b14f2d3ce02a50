#pragma once
/// The step of a case that gives no time.cfl, as a factor on the graph bound (physics note 2.1).
/// The integrator has its own; it is lowered where the dissipation would not bear it. That happens
/// where the dissipation acts along one direction (cells far longer than wide), where shear waves
/// are nearly as fast as pressure waves, or where D_ab is above its plain strength, by
/// scheme.dissipation or a slope limiter at work: its largest rate
/// d then comes near 2 r, r the graph rate, or passes it, and leapfrog ends at dt d = 2, SSP-RK3 at
/// 2.51. Measured limits: benchmarks/README.md. Test: tests/common/run/default_cfl_test.cpp

#include "common/run/case.hpp"
#include "common/scheme/pair_graph.hpp"
#include "common/time/integrator.hpp"

namespace diptych::run {

double default_cfl(const Case& setup,
                   const scheme::PairGraph& graph,
                   const time::Integrator& integrator);

/// Largest rate of the dissipation of plain jumps over twice the graph rate. A pair resists by
/// |S_ab| (z_p n(x)n + z_s (I - n(x)n)) / 2: the largest eigenvalue of the Laplacian with the
/// weights |S_ab| / 2, times the largest share of a direction, max_a |sum_b |S_ab| Z_ab| over
/// z_p sum_b |S_ab|.
/// @param shear_ratio  c_s/c_p
double dissipation_share(const scheme::PairGraph& graph, double shear_ratio);

/// |z| of the first z < 0 beyond which the integrator amplifies u' = z u.
double real_extent(const time::Integrator& integrator);

}  // namespace diptych::run
