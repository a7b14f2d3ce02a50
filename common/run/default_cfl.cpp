#include "common/run/default_cfl.hpp"

#include "common/run/largest_rates.hpp"
#include "common/run/model_menu.hpp"
#include "common/run/sample_part.hpp"
#include "common/run/solver.hpp"
#include "common/scheme/dissipation/limiters/limiter_menu.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/time_step.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::run {

namespace {

/// With the branches at once (notes 1.4).
/// @param volumetric  modulus that volumes of cells carry  [Pa]
/// @param cell_shear  and that their gradients do
/// @param hourglass   that of scheme/hourglass
ElasticRatios ratios_of(const cases::MaterialCase& m,
                        double volumetric,
                        double cell_shear,
                        double hourglass) {
  const double half = 0.5 * m.shear_modulus;
  const double zeta = m.zeta_ratio * half, xi = half - zeta;
  double shear = m.shear_modulus, pressure = m.lame + 2 * m.shear_modulus;
  for (const cases::BranchCase& b : m.branches) {
    shear += 2 * (b.beta_C * xi + b.beta_G * zeta);
    pressure += 4 * b.beta_C * xi + 8 * b.beta_G * zeta;
  }
  return {std::sqrt(shear / pressure), volumetric / pressure, cell_shear / pressure,
          hourglass / pressure};
}

/// What leapfrog takes of its limit at most, where the fastest and the most damped modes meet.
constexpr double leapfrog_share = 0.85;

/// Of the step at which the dissipation alone turns unstable.
constexpr double dissipation_share = 0.8;

/// The step at a wave speed of one, by the rates of the body or of a part of it.  [m]
template <int Dim>
double step_of(const cases::Case& setup,
               const ElasticRatios& ratios,
               LargestRates<Dim> largest,
               const time::Integrator& integrator) {
  const double limiter = scheme::strength_of(scheme::limiter_menu().at(setup.scheme.limiter));
  const double strength = setup.scheme.dissipation * limiter;
  const double omega = largest.frequency(ratios);
  // a limiter of shocks, which compress
  const double d = strength * (limiter > 1 ? largest.dissipation_turned(ratios.shear)
                                           : largest.dissipation(ratios.shear));
  double dt = std::min(integrator.default_dt_omega / omega,
                       dissipation_share * real_extent(integrator) / d);
  if (integrator.is_leapfrog()) {
    // convex in dt and zero at zero: at this part of dt it is no larger than the share
    const double limit = largest.leapfrog_limit(dt, ratios, strength);
    dt *= std::min(1.0, leapfrog_share / limit);
  }
  return dt;
}

double factor_of(const cases::Case& setup, double geometric_rate) {
  return geometric_rate * scheme::frequency_factor(setup.scheme.face_correction);
}

}  // namespace

double real_extent(const time::Integrator& integrator) {
  if (integrator.is_leapfrog()) return 2;
  const auto amplification = [&](double z) {
    double u = 1;
    for (const time::SspStage& stage : integrator.stages)
      u = stage.alpha + stage.beta * (1 + stage.part * z) * u;
    return std::abs(u);
  };
  double extent = 0;
  while (amplification(-(extent + 1e-3)) <= 1 + 1e-12)
    extent += 1e-3;
  return extent;
}

template <int Dim>
double sampled_cfl(const cases::Case& setup,
                   const scheme::PairGraph& graph,
                   double geometric_rate,
                   const time::Integrator& integrator) {
  // the rates of a node depend on the nodes of its row alone
  if (setup.scheme.face_correction != 0 || volumes_of(setup, graph) != scheme::Volumes::nodes ||
      is_symmetric(setup))
    return 0;
  const std::optional<SamplePart> part = sample_part(graph);
  if (!part) return 0;
  scheme::Body<Dim> body(part->graph, scheme::BodyOptions{});
  return factor_of(setup, geometric_rate) * step_of<Dim>(setup, ratios_of(setup.material, 0, 0, 0),
                                                         {body, 0, part->moves}, integrator);
}

template <int Dim>
double default_cfl(const cases::Case& setup,
                   const scheme::MaterialModel& material,
                   scheme::Body<Dim>& body,
                   double geometric_rate,
                   const time::Integrator& integrator) {
  const ElasticRatios ratios =
      ratios_of(setup.material, body.bulk ? material.volumetric_modulus() : 0,
                body.options.cell_shear, body.options.hourglass);
  return factor_of(setup, geometric_rate) *
         step_of<Dim>(setup, ratios, {body, setup.scheme.face_correction}, integrator);
}

#define DIPTYCH_INSTANTIATE(Dim)                                                         \
  template double default_cfl(const cases::Case&, const scheme::MaterialModel&,          \
                              scheme::Body<Dim>&, double, const time::Integrator&);      \
  template double sampled_cfl<Dim>(const cases::Case&, const scheme::PairGraph&, double, \
                                   const time::Integrator&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

double default_cfl(const cases::Case& setup,
                   const scheme::PairGraph& graph,
                   const time::Integrator& integrator) {
  scheme::BodyOptions options;
  options.face_correction = setup.scheme.face_correction != 0;
  options.volumes = volumes_of(setup, graph);
  options.cell_shear = cell_shear_of(setup, options.volumes);
  options.has_moments = is_symmetric(setup);
  options.hourglass = hourglass_of(setup, graph);
  const auto material = model_menu().at(setup.material.model).model(setup.material);
  const double rate = scheme::geometric_rate(graph);
  const double sampled = graph.dimension == 2 ? sampled_cfl<2>(setup, graph, rate, integrator)
                                              : sampled_cfl<3>(setup, graph, rate, integrator);
  if (sampled > 0) return sampled;
  if (graph.dimension == 2) {
    scheme::Body<2> body(graph, options);
    return default_cfl(setup, *material, body, rate, integrator);
  }
  scheme::Body<3> body(graph, options);
  return default_cfl(setup, *material, body, rate, integrator);
}

}  // namespace diptych::run
