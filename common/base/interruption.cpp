#include "common/base/interruption.hpp"

#include <atomic>

namespace diptych::base {

namespace {
// of handlers of signals, and of the thread that passes on those of other ranks
std::atomic<bool> interrupt_flag = false, checkpoint_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace

void request_interrupt() {
  interrupt_flag = true;
}

bool interrupt_requested() {
  return interrupt_flag;
}

void request_checkpoint() {
  checkpoint_flag = true;
}

bool take_checkpoint_request() {
  return checkpoint_flag.exchange(false);
}

}  // namespace diptych::base
