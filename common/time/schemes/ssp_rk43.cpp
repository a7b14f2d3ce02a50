/// SSPRK(4,3), four stages of order three (Kraaijevanger 1991; Spiteri and Ruuth 2002):
///   U1 = U + dt/2 L(U); U2 = U1 + dt/2 L(U1); U3 = 2/3 U + 1/3 (U2 + dt/2 L(U2)) at t + dt/2;
///   U^{n+1} = U3 + dt/2 L(U3).
/// Its amplification is 1 + z + z^2/2 + z^3/6 + z^4/48: stable to dt omega = 2.15 (0.54 a stage,
/// SSP-RK3 0.58) and to dt d = 5.15 of the dissipation (1.29 a stage, SSP-RK3 0.84). So it pays
/// where the dissipation sets the step: slope limiters, strong dissipation (benchmarks/README.md).
/// 1.73 is the share of the limit that SSP-RK3 has with 1.39.

#include "common/time/integrator.hpp"

namespace diptych::time {

Integrator ssp_rk43() {
  return {.order = 3,
          .default_dt_omega = 1.73,
          .stages = {{0, 1, 0.5, 0.5},
                     {0, 1, 1, 0.5},
                     {1 - 1.0 / 3, 1.0 / 3, 0.5, 0.5},
                     {0, 1, 1, 0.5}},
          .gauss_relaxation = true};
}

}  // namespace diptych::time
