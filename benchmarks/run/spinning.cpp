#include "benchmarks/run/spinning.hpp"

#include <cstdlib>
#include <unistd.h>

namespace diptych::harness {

void limit_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("GOMP_SPINCOUNT", "10000", 1);
  execv("/proc/self/exe", argv);  // where this fails the run goes on as it is
}

}  // namespace diptych::harness
