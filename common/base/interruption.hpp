#pragma once
/// Whether the user has asked the program to end (Ctrl-C, SIGTERM, SIGHUP): set by the signal
/// handler of the program, looked at by loops that may take long and while another program runs.
/// Also whether the state is to be kept now.
/// Test: tests/command_line/interrupt_test.cpp

#include "common/base/error.hpp"

#include <string>

namespace diptych::base {

/// Safe in a signal handler.
void request_interrupt();
bool interrupt_requested();

/// The same of a checkpoint (SIGUSR1). Safe in a signal handler.
void request_checkpoint();
/// Whether one has been asked for since the last call.
bool take_checkpoint_request();

/// What was under way is given up; nothing of it is left.
class Interruption : public Error {
 public:
  explicit Interruption(const std::string& message) : Error(ExitCode::interrupted, message) {}
};

}  // namespace diptych::base
