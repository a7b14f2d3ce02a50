#pragma once
/// Ctrl-C, SIGTERM and SIGHUP: the run ends its step, what there is is written, the user is told
/// how to go on, the exit code is 130. A run under nohup goes on when its terminal closes. Test:
/// tests/command_line/interrupt_test.cpp, tests/ranks

#include "common/base/interruption.hpp"

#include <string>

namespace diptych::harness {

using base::interrupt_requested;
using base::request_interrupt;

/// From now on the first of the three ends the step (see interrupt_requested), the second the
/// program; SIGUSR1 asks for a checkpoint; a write beyond a limit of the size of files is an error
/// of that write.
void catch_interrupts();

/// Of another rank than 0: what asks for an end or a checkpoint is kept for take_signal().
void pass_signals_on();
/// What the rank was sent since the last call; 0: nothing.
int take_signal();
/// Of rank 0: does what another rank was asked for, unless it has been asked for the same.
void obey_signal(int rank, int signal);

/// 0, or that of an interrupt with a line on the standard error stream.
/// @param to_go_on  what the user finds and does then
int exit_code_of_study(const std::string& to_go_on);

/// Of a single run, which left what it had in this folder.
std::string begin_again(const std::string& directory);

/// Of a run that has left a checkpoint there.
std::string go_on_from_checkpoint(const std::string& directory);

/// Of a study that takes finished runs over.
std::string go_on_from(const std::string& directory);

}  // namespace diptych::harness
