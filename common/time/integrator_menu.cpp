#include "common/time/schemes/leapfrog.hpp"
#include "common/time/schemes/ssp_rk2.hpp"
#include "common/time/schemes/ssp_rk3.hpp"
#include "common/time/schemes/ssp_rk43.hpp"

namespace diptych::time {

const base::Registry<Integrator>& integrator_menu() {
  static const auto menu = base::Registry<Integrator>("integrator")
                               .add("leapfrog", leapfrog())
                               .add("ssp-rk2", ssp_rk2())
                               .add("ssp-rk3", ssp_rk3())
                               .add("ssp-rk43", ssp_rk43());
  return menu;
}

}  // namespace diptych::time
