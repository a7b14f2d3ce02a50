#include "common/run/default_cfl.hpp"

#include "common/run/largest_rates.hpp"
#include "common/scheme/face_correction.hpp"
#include "common/scheme/limiters/limiter_menu.hpp"
#include "common/scheme/time_step.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::run {

namespace {

/// c_s/c_p of the undeformed material with its branches at once (physics note 1.4).
double shear_ratio_of(const MaterialCase& m) {
  const double half = 0.5 * m.shear_modulus;
  const double zeta = m.zeta_ratio * half, xi = half - zeta;
  double shear = m.shear_modulus, pressure = m.lame + 2 * m.shear_modulus;
  for (const BranchCase& b : m.branches) {
    shear += 2 * (b.beta_C * xi + b.beta_G * zeta);
    pressure += 4 * b.beta_C * xi + 8 * b.beta_G * zeta;
  }
  return std::sqrt(shear / pressure);
}

/// Of the step at which the dissipation alone turns unstable. For leapfrog, stable where
/// (dt omega)^2/4 + dt d/2 < 1, it leaves what dt omega = 0.92 takes, 0.21, even were the same mode
/// the fastest and the most damped.
constexpr double dissipation_share = 0.8;

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

double default_cfl(const Case& setup,
                   const scheme::PairGraph& graph,
                   const time::Integrator& integrator) {
  const double kappa_f = setup.scheme.face_correction;
  const double strength = setup.scheme.dissipation *
                          scheme::strength_of(scheme::limiter_menu().at(setup.scheme.limiter));
  const LargestRates largest(graph);
  const double omega = largest.frequency(kappa_f);
  const double d = strength * largest.dissipation(shear_ratio_of(setup.material));
  // dt at a wave speed of one
  const double dt = std::min(integrator.default_dt_omega / omega,
                             dissipation_share * real_extent(integrator) / d);
  return dt * scheme::geometric_rate(graph) * scheme::frequency_factor(kappa_f);
}

}  // namespace diptych::run
