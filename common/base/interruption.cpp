#include "common/base/interruption.hpp"

#include <csignal>

namespace diptych::base {

namespace {
volatile std::sig_atomic_t interrupt_flag = 0;
}

void request_interrupt() {
  interrupt_flag = 1;
}

bool interrupt_requested() {
  return interrupt_flag != 0;
}

}  // namespace diptych::base
