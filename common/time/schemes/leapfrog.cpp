/// Leapfrog in its kick-drift-kick form (velocity Verlet): v^{n+1/2} = v^n + dt/2 a^n;
/// F, u by v^{n+1/2}; a^{n+1} = a(F^{n+1}, v^{n+1/2}); v^{n+1} = v^{n+1/2} + dt/2 a^{n+1}.
/// One evaluation per step, second order without D_ab. D_ab is taken at v^{n+1/2}: it lags by half
/// a step, an error of first order in dt times the numerical damping, on the shear wave at the
/// default step 2 % of the error in space and less, for every relaxation time.
/// Stable to dt omega = 2; 0.92 keeps the error in time small beside that in space
/// (benchmarks/README.md).

#include "common/time/integrator.hpp"

namespace diptych::time {

Integrator leapfrog() {
  return {.order = 2, .default_dt_omega = 0.92, .stages = {}, .gauss_relaxation = false};
}

}  // namespace diptych::time
