#include "meshes/geo/child_program.hpp"

#include "common/base/error.hpp"
#include "meshes/geo/child_watch.hpp"
#include "meshes/geo/jail.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

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
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// Both ends are closed in a program that is started.
struct Pipe {
  explicit Pipe(const std::string& program) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(program, "no pipe for its output", errno);
    reading = Descriptor(ends[0]);
    writing = Descriptor(ends[1]);
  }
  Descriptor reading, writing;
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

/// What a child knows of the process that made it.
struct Parenthood {
  pid_t parent;
  const Jail* jail;
};

/// In the child: becomes the program, or tells through `report` why it could not. Nothing is
/// allocated here, as another thread may have held the allocator when the process was forked.
[[noreturn]] void become(char* const* words,
                         char* const* variables,
                         int output,
                         int report,
                         const Parenthood& born) noexcept {
  if (!join_parent(born.parent)) _exit(127);
  const int input = ::open("/dev/null", O_RDONLY);
  const bool has_streams = input >= 0 && dup2(input, STDIN_FILENO) >= 0 &&
                           dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0;
  int error = has_streams ? 0 : errno;
  if (error == 0 && born.jail != nullptr) error = born.jail->enter();
  if (error == 0) {
    execve(words[0], words, variables);
    error = errno;
  }
  [[maybe_unused]] const auto told = ::write(report, &error, sizeof error);
  _exit(127);
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

bool is_script(const std::string& program) {
  const Descriptor file(::open(program.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 2> begin{};
  return file.number() >= 0 && ::read(file.number(), begin.data(), 2) == 2 && begin[0] == '#' &&
         begin[1] == '!';
}

ChildResult run_child(const std::string& program,
                      const std::vector<std::string>& arguments,
                      const Surroundings& surroundings) {
  Pipe output(program), report(program);
  std::vector<std::string> words = arguments, variables = surroundings.environment;
  if (surroundings.inherits) variables = environment_with(variables);
  words.insert(words.begin(), program);
  const std::vector<char*> word_pointers = pointers_to(words);
  const std::vector<char*> variable_pointers = pointers_to(variables);
  const Parenthood born{getpid(), surroundings.jail};
  const pid_t child = fork();
  if (child < 0) fail(program, "cannot be started", errno);
  if (child == 0) {
    become(word_pointers.data(), variable_pointers.data(), output.writing.number(),
           report.writing.number(), born);
  }
  output.writing.close();
  report.writing.close();
  ChildResult result;
  result.output = output_of(child, output.reading.number(), program, most_output);
  result.exit_status = exit_status_of(child, program);
  int error = 0;
  if (::read(report.reading.number(), &error, sizeof error) == sizeof error)
    fail(program, "cannot be started", error);
  return result;
}

}  // namespace diptych::meshes
