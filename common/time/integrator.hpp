#pragma once
/// Time integrators as rows of coefficients. An SSP Runge-Kutta stage is
///   U^(i) = alpha U^n + beta (U^(i-1) + part dt L(U^(i-1))),  a state at time t + time dt.
/// Leapfrog (velocity Verlet) evaluates forces once a step: kick, drift, evaluate, kick.
/// Adding a scheme: a file in schemes/ and a line in schemes.def.

#include "common/base/registry.hpp"

#include <vector>

namespace diptych::time {

struct SspStage {
  double alpha = 0;
  double beta = 1;  ///< alpha + beta = 1 to the last bit: momentum drifts by the rest in every step
  double time = 1;  ///< of the result, in steps: 1/2 or 1
  double part = 1;  ///< of the step that the forward Euler step in it takes
};

struct Integrator {
  int order = 2;
  double default_dt_omega = 1;    ///< step without time.cfl times the largest frequency of the body
  std::vector<SspStage> stages;   ///< empty: leapfrog
  bool gauss_relaxation = false;  ///< GEXP at the end of the step instead of LIN

  bool is_leapfrog() const { return stages.empty(); }
  int evaluations_per_step() const { return is_leapfrog() ? 1 : static_cast<int>(stages.size()); }
};

#define DIPTYCH_INTEGRATOR(name, function) Integrator function();
#include "common/time/schemes/schemes.def"
#undef DIPTYCH_INTEGRATOR

/// All of schemes.def by name.
const base::Registry<Integrator>& integrator_menu();

}  // namespace diptych::time
