#include "meshes/child_program.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace diptych::meshes {

namespace {

constexpr size_t most_output = 65536;

[[noreturn]] void fail(const std::string& program, const char* what, int error) {
  throw base::EnvironmentError(fmt::format("{}: {}: {}", program, what, std::strerror(error)));
}

/// A file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// Where the child's standard streams go.
class StreamPlan {
 public:
  explicit StreamPlan(int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
  }
  StreamPlan(const StreamPlan&) = delete;
  StreamPlan& operator=(const StreamPlan&) = delete;
  ~StreamPlan() { posix_spawn_file_actions_destroy(&actions_); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts)
    pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The given variables, then those of this process that they do not replace.
std::vector<std::string> environment_with(const std::vector<std::string>& first) {
  std::vector<std::string> result = first;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    bool is_replaced = false;
    for (const std::string& given : first)
      is_replaced |= given.starts_with(name);
    if (!is_replaced) result.push_back(text);
  }
  return result;
}

std::string read_to_end(const std::string& program, int descriptor) {
  std::string output;
  std::array<char, 4096> block{};
  for (;;) {
    const ssize_t n = ::read(descriptor, block.data(), block.size());
    if (n == 0) return output;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(program, "its output cannot be read", errno);
    output.append(block.data(), static_cast<size_t>(n));
    if (output.size() > 2 * most_output) output.erase(0, output.size() - most_output);
  }
}

int wait_for(const std::string& program, pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(program, "waiting for it failed", errno);
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

std::string ChildResult::ending() const {
  return exit_status > 128 ? fmt::format("killed by signal {}", exit_status - 128)
                           : fmt::format("exit status {}", exit_status);
}

std::string program_in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  const std::string folders = path == nullptr ? "" : path;
  for (size_t start = 0; start <= folders.size();) {
    const size_t end = std::min(folders.find(':', start), folders.size());
    const std::string folder = folders.substr(start, end - start);
    start = end + 1;
    if (folder.empty()) continue;
    std::string program = fmt::format("{}/{}", folder, name);
    struct stat status {};
    if (stat(program.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
        access(program.c_str(), X_OK) == 0) {
      return program;
    }
  }
  return {};
}

ChildResult run_child(const std::string& program,
                      const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(program, "no pipe for its output", errno);
  Descriptor reading(ends[0]), writing(ends[1]);
  const StreamPlan streams(writing.number());
  std::vector<std::string> words = arguments, variables = environment_with(environment);
  words.insert(words.begin(), program);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), streams.get(), nullptr,
                                pointers_to(words).data(), pointers_to(variables).data());
  if (error != 0) fail(program, "cannot be started", error);
  writing.close();
  ChildResult result;
  result.output = read_to_end(program, reading.number());
  result.exit_status = wait_for(program, child);
  return result;
}

}  // namespace diptych::meshes
