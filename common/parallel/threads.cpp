#include "common/parallel/for_chunks.hpp"

#include <omp.h>

namespace diptych::parallel {

void set_threads(int n) {
  omp_set_dynamic(0);
  omp_set_num_threads(n > 0 ? n : omp_get_num_procs());
}

int n_threads() {
  return omp_get_max_threads();
}

}  // namespace diptych::parallel
