#pragma once
/// Another program, started directly (no shell), its output captured.

#include <string>
#include <vector>

namespace diptych::meshes {

class Jail;

struct ChildResult {
  int exit_status = 0;  ///< 0: success; 128 + number after a signal
  std::string output;   ///< its standard output and error together, the last 64 KiB

  /// "exit status 1" or "killed by signal 9"
  std::string ending() const;
};

/// Full path of an executable file in the folders of PATH, or an empty string. Empty entries of
/// PATH, which a shell takes for the current folder, are passed over.
std::string program_in_path(const std::string& name);

/// Whether a program is a script, which another program reads.
bool is_script(const std::string& program);

/// What a program finds around it.
struct Surroundings {
  std::vector<std::string> environment;  ///< "NAME=value"
  bool inherits = true;                  ///< the rest of the environment of this process too
  const Jail* jail = nullptr;            ///< what it may do, or null for all
};

/// Runs a program to its end, with empty standard input.
/// @param program    full path
/// @param arguments  without the program's name
/// @throws base::EnvironmentError where it cannot be started; base::Interruption where the user
///         asked this program to end: the child has ended, too
ChildResult run_child(const std::string& program,
                      const std::vector<std::string>& arguments,
                      const Surroundings& surroundings);

}  // namespace diptych::meshes
