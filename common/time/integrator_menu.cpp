#include "common/time/integrator.hpp"

namespace diptych::time {

const base::Registry<Integrator>& integrator_menu() {
  static const auto menu = [] {
    base::Registry<Integrator> all("integrator");
#define DIPTYCH_INTEGRATOR(name, function) all.add(name, function());
#include "common/time/schemes/schemes.def"
#undef DIPTYCH_INTEGRATOR
    return all;
  }();
  return menu;
}

}  // namespace diptych::time
