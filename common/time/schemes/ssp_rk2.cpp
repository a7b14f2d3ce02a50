/// SSP-RK2 (Heun, Shu and Osher 1988): U1 = U + dt L(U); U^{n+1} = 1/2 U + 1/2 (U1 + dt L(U1)).
/// No undamped frequency is stable: it grows by (dt omega)^4/8 a step. With D_ab waves along a line
/// of nodes are to c dt/h = 0.76 (face correction) or 0.80, free coarse bodies are not: the default
/// step is short. Weakly unstable where D_ab does not damp (notes 2.1): an elastic cube of
/// 2^3 cells that spins freely has many times its energy after some thousand steps, of 6^3 cells it
/// has not.

#include "common/time/integrator.hpp"

namespace diptych::time {

Integrator ssp_rk2() {
  return {.order = 2,
          .default_dt_omega = 0.5,
          .stages = {{0, 1, 1}, {0.5, 0.5, 1}},
          .gauss_relaxation = false};
}

}  // namespace diptych::time
