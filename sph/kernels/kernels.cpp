#include "sph/kernels/kernel.hpp"

namespace diptych::sph {

base::Registry<Kernel> kernels() {
  base::Registry<Kernel> menu("kernel");
#define DIPTYCH_KERNEL(name, function) menu.add(name, function());
#include "sph/kernels/kernels.def"
#undef DIPTYCH_KERNEL
  return menu;
}

}  // namespace diptych::sph
