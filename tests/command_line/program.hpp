#pragma once
/// Runs the program as a user would, in a folder of the test's own.

#include "tests/folders.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>

namespace diptych::tests {

struct Outcome {
  int exit_code = -1;
  std::string text;  ///< standard output and standard error
};

/// A new empty folder, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "diptych-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }
  bool is_empty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_;
};

/// A command of the shell, from inside the folder, with empty standard input; $diptych is the
/// program.
inline Outcome shell(const Folder& folder, const std::string& line) {
  const std::string command = "cd " + folder.path().string() + " && { diptych=" + build_folder() +
                              "/diptych\n" + line + "\n} 2>&1 </dev/null";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  char buffer[4096];
  while (const size_t n = fread(buffer, 1, sizeof buffer, pipe))
    outcome.text.append(buffer, n);
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// `PROGRAM ARGUMENTS`, from inside the folder. ARGUMENTS go through a shell.
inline Outcome run_program(const Folder& folder,
                           const std::string& program,
                           const std::string& arguments) {
  return shell(folder, program + " " + arguments);
}

/// `diptych ARGUMENTS`, the same.
inline Outcome diptych(const Folder& folder, const std::string& arguments) {
  return run_program(folder, build_folder() + "/diptych", arguments);
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace diptych::tests
