#pragma once
/// A child process that does not outlive what it was started for: it ends with this program,
/// whatever ends that, and where the user asks this program to end. Test:
/// tests/command_line/interrupt_test.cpp

#include <string>
#include <sys/types.h>

namespace diptych::meshes {

/// In the child, before the program is started: a process group of its own, so that it is ended
/// with whatever it starts, and is no second receiver of Ctrl-C; the kernel ends it with its
/// parent; signals that this program ignores or blocks have their usual meaning again. Allocates
/// nothing. @return false where the parent has ended already
bool join_parent(pid_t parent) noexcept;

/// In the parent: what the child writes, until it closes its output.
/// @param most    of the output that is kept, bytes; the last of them
/// @throws base::Interruption where the user has asked to end: the child and all of its group are
///         ended and reaped; base::EnvironmentError where the output cannot be read
std::string output_of(pid_t child, int descriptor, const std::string& program, size_t most);

/// Waits for the end of the child. @return its exit status, 128 + number after a signal
int exit_status_of(pid_t child, const std::string& program);

}  // namespace diptych::meshes
