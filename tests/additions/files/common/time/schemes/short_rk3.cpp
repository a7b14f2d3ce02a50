/// SSP-RK3 with shorter steps by default.

#include "common/time/integrator.hpp"

namespace diptych::time {

Integrator short_rk3() {
  Integrator scheme = ssp_rk3();
  scheme.default_dt_omega *= 0.5;
  return scheme;
}

}  // namespace diptych::time
