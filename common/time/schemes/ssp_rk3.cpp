/// SSP-RK3 (Shu and Osher 1988): U1 = U + dt L(U); U2 = 3/4 U + 1/4 (U1 + dt L(U1)) at t + dt/2;
/// U^{n+1} = 1/3 U + 2/3 (U2 + dt L(U2)). Internal variables: GEXP at the end of the step.
/// Stable to dt omega = 1.73; 1.39 is 0.8 of that.

#include "common/time/integrator.hpp"

namespace diptych::time {

Integrator ssp_rk3() {
  return {.order = 3,
          .default_dt_omega = 1.39,
          .stages = {{0, 1, 1}, {0.75, 0.25, 0.5}, {1 - 2.0 / 3, 2.0 / 3, 1}},
          .gauss_relaxation = true};
}

}  // namespace diptych::time
