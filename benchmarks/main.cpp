/// The command line. Verbs and exit codes are contracts; see README.md.

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/ranked_runs.hpp"
#include "benchmarks/verbs/command_line.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"
#include "common/parallel/ranks.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <sys/resource.h>
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

/// A stack that is too small ends the program without a word: as much as a usual one is taken where
/// it may be, before the program starts itself once more. @throws base::EnvironmentError
void require_stack() {
  constexpr rlim_t least = 256 << 10, usual = 8 << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= usual) return;
  limit.rlim_cur = std::min(limit.rlim_max, usual);
  setrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur >= least) return;
  throw base::EnvironmentError(
      fmt::format("the stack of a process is limited to {} KiB, {} KiB are needed: ulimit -s 8192",
                  limit.rlim_cur >> 10, least >> 10));
}

/// On a shared machine a thread that spins at a barrier takes the processor from the one it waits
/// for: loops became thirty times slower. OpenMP's runtime reads its settings when it is loaded, so
/// the program starts itself once more with a short spin; settings of the user's own are kept. One
/// thread waits for nobody: such a run is not started twice.
void limit_spinning(int argc, char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  for (int k = 1; k < argc; ++k) {
    const bool is_one = std::strcmp(argv[k], "--threads=1") == 0 ||
                        (std::strcmp(argv[k], "--threads") == 0 && k + 1 < argc &&
                         std::strcmp(argv[k + 1], "1") == 0);
    if (is_one) return;
  }
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

/// Another rank than 0: what interrupts rank 0 ends the run, and so this one.
int follow() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
    std::signal(signal, SIG_IGN);
  return harness::follow_runs();
}

/// Of several ranks that could not join only one says so.
void complain(const std::string& message) {
  if (parallel::launched_rank() == 0)
    std::fputs(fmt::format("diptych: {}\n", message).c_str(), stderr);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    require_stack();
    limit_spinning(argc, argv);
    harness::catch_interrupts();
    const parallel::Ranks ranks;
    if (harness::is_following()) return follow();
    const harness::LedRuns led_runs;
    const int code = verbs::run_program(verbs::verb_table(), argc, argv);
    check_output();
    return code;
  } catch (const base::Error& error) {
    complain(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    complain("out of memory; use a smaller --level");
    return static_cast<int>(base::ExitCode::environment);
  } catch (const std::exception& error) {
    // of a library: what it met outside, for what the user wrote has been checked
    complain(error.what());
    return static_cast<int>(base::ExitCode::environment);
  }
}
