#include "sph/kernels/kernel.hpp"

namespace diptych::sph {

base::Registry<Kernel> kernels() {
  base::Registry<Kernel> menu("kernel");
  menu.add("cubic-spline", cubic_spline())
      .add("quintic-spline", quintic_spline())
      .add("wendland-c2", wendland_c2());
  return menu;
}

}  // namespace diptych::sph
