#pragma once
/// Ctrl-C and SIGTERM: the run ends its step, what there is is written, the user is told how to go
/// on, the exit code is 130. Test: tests/command_line/interrupt_test.cpp

#include <string>

namespace diptych::harness {

/// From now on the first of the two ends the step (see interrupt_requested), the second the
/// program.
void catch_interrupts();

/// Set by the signal handler: the run ends its step, writes what there is, status "interrupted".
void request_interrupt();
bool interrupt_requested();

/// 0, or that of an interrupt with a line on the standard error stream.
/// @param to_go_on  what the user finds and does then
int exit_code_of_study(const std::string& to_go_on);

/// Of a single run, which left what it had in this folder.
std::string begin_again(const std::string& directory);

/// Of a study that takes finished runs over.
std::string go_on_from(const std::string& directory);

}  // namespace diptych::harness
