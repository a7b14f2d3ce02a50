#pragma once
/// The step of a case that gives no time.cfl, as a factor on the graph bound (notes 2.1).
/// The bound overstates what limits a step by 1.0 to 2.5, by the weights of the pairs; so the
/// largest frequency omega and the largest rate d of the dissipation are estimated once, on the
/// undeformed body (largest_rates.hpp), and dt is the smaller of
///   default_dt_omega of the integrator / omega   and   0.8 of the step at which d ends stability,
///   dt d = 2 with leapfrog and SSP-RK2, 2.51 with SSP-RK3, 5.15 with SSPRK(4,3).
/// omega is that of the elastic operator of the body itself, all components together, with the
/// volumes of cells where these carry the pressure. The regions in which SSP-RK3 and SSPRK(4,3) are
/// stable hold the whole rectangle of the two bounds. With a slope limiter, which is for shocks, d
/// is that of a body so compressed along one axis that all areas of pairs have turned to it, the
/// largest of the axes; what 0.8 leaves is for what a step compresses. With leapfrog the largest
/// eigenvalue of dt^2/4 K + dt/2 D stays below 0.85, which counts where the fastest and the most
/// damped modes are the same (free corners of operators that sum by parts). During the run it
/// follows the wave speeds as the graph bound does. A slope limiter counts by its greatest
/// strength. Measured limits and errors: benchmarks/README.md. Test:
/// tests/common/run/default_cfl_test.cpp

#include "common/cases/case.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/time/integrator.hpp"

namespace diptych::run {

/// @param body            of the case, at rest; its velocities, records and forces are lost
/// @param geometric_rate  of its graph (scheme/time_step.hpp)
template <int Dim>
double default_cfl(const cases::Case& setup,
                   const scheme::MaterialModel& material,
                   scheme::Body<Dim>& body,
                   double geometric_rate,
                   const time::Integrator& integrator);

/// The same by the rates of a part that has all classes of rows of a large lattice
/// (sample_part.hpp), which takes no body of the whole.
/// @return 0 where there is no such part, with the face correction and where volumes carry the
/// pressure
template <int Dim>
double sampled_cfl(const cases::Case& setup,
                   const scheme::PairGraph& graph,
                   double geometric_rate,
                   const time::Integrator& integrator);

/// One or the other, where there is no body yet.
double default_cfl(const cases::Case& setup,
                   const scheme::PairGraph& graph,
                   const time::Integrator& integrator);

/// |z| of the first z < 0 beyond which the integrator amplifies u' = z u.
double real_extent(const time::Integrator& integrator);

}  // namespace diptych::run
