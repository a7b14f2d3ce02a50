#include "common/base/interruption.hpp"

#include <csignal>

namespace diptych::base {

namespace {
volatile std::sig_atomic_t interrupt_flag = 0;
volatile std::sig_atomic_t checkpoint_flag = 0;
}  // namespace

void request_interrupt() {
  interrupt_flag = 1;
}

bool interrupt_requested() {
  return interrupt_flag != 0;
}

void request_checkpoint() {
  checkpoint_flag = 1;
}

bool take_checkpoint_request() {
  if (checkpoint_flag == 0) return false;
  checkpoint_flag = 0;
  return true;
}

}  // namespace diptych::base
