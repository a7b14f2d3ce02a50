/// The command line. Verbs and exit codes are contracts; see README.md.

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/verbs/command_line.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <unistd.h>

namespace {

using namespace diptych;

/// A standard stream that is closed gives its number to the next file opened, which would then
/// take what is printed: such numbers are taken here, by what can be neither read nor written.
void hold_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

/// On a shared machine a thread that spins at a barrier takes the processor from the one it waits
/// for: loops became thirty times slower. OpenMP's runtime reads its settings when it is loaded, so
/// the program starts itself once more with a short spin; settings of the user's own are kept.
void limit_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("GOMP_SPINCOUNT", "10000", 1);
  execv("/proc/self/exe", argv);  // where this fails the run goes on as it is
}

/// What was printed has arrived. @throws base::EnvironmentError where it has not
void check_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const char* reason = errno != 0 ? std::strerror(errno) : "a write failed";
  throw base::EnvironmentError(
      fmt::format("standard output: not all could be written: {}", reason));
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  limit_spinning(argv);
  harness::catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const int code = verbs::run_program(verbs::verb_table(), argc, argv);
    check_output();
    return code;
  } catch (const base::Error& error) {
    std::fputs(fmt::format("diptych: {}\n", error.what()).c_str(), stderr);
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    std::fputs("diptych: out of memory; use a smaller --level\n", stderr);
    return static_cast<int>(base::ExitCode::environment);
  } catch (const std::exception& error) {
    // of a library: what it met outside, for what the user wrote has been checked
    std::fputs(fmt::format("diptych: {}\n", error.what()).c_str(), stderr);
    return static_cast<int>(base::ExitCode::environment);
  }
}
