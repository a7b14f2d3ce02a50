/// The command line. Verbs and exit codes are contracts; see benchmarks/USING.md.

#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/rank_programs.hpp"
#include "benchmarks/run/ranked_runs.hpp"
#include "benchmarks/verbs/command_line.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"
#include "common/parallel/ranks.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <optional>
#include <poll.h>
#include <sys/resource.h>
#include <thread>
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

/// With what was changed in the environment or the limits. Where it fails the run goes on as it is.
void start_once_more(char** argv) {
  execv("/proc/self/exe", argv);
}

constexpr rlim_t least_stack = 256 << 10;

/// Bytes that OMP_STACKSIZE gives the stack of a thread; nothing where it is not set.
std::optional<double> stack_of_threads() {
  const char* text = std::getenv("OMP_STACKSIZE");
  if (text == nullptr) return std::nullopt;
  char* unit = nullptr;
  const double size = std::strtod(text, &unit);
  if (unit == text) return std::nullopt;  // OpenMP tells of it
  switch (unit[std::strspn(unit, " ")]) {
    case 'b':
    case 'B':
      return size;
    case 'm':
    case 'M':
      return size * (1 << 20);
    case 'g':
    case 'G':
      return size * (1 << 30);
    default:
      return size * (1 << 10);
  }
}

/// A stack that is too small ends the program without a word: as much as a usual one is taken where
/// it may be, for its threads too. @throws base::EnvironmentError
void require_stack(char** argv) {
  constexpr rlim_t usual = 8 << 20;
  if (const auto size = stack_of_threads(); size && *size < least_stack) {
    throw base::EnvironmentError(
        fmt::format("OMP_STACKSIZE={} is too small for threads: unset it, or give {}K at least",
                    std::getenv("OMP_STACKSIZE"), least_stack >> 10));
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= usual) return;
  const rlim_t had = limit.rlim_cur;
  limit.rlim_cur = std::min(limit.rlim_max, usual);
  if (limit.rlim_cur > had && setrlimit(RLIMIT_STACK, &limit) == 0) start_once_more(argv);
  if (limit.rlim_cur >= least_stack) return;
  throw base::EnvironmentError(
      fmt::format("the stack of a process is limited to {} KiB, {} KiB are needed: ulimit -s 8192",
                  limit.rlim_cur >> 10, least_stack >> 10));
}

/// On a shared machine a thread that spins at a barrier takes the processor from the one it waits
/// for: loops became thirty times slower. Settings of the user's own are kept.
/// @return whether there were none
bool limit_spinning() {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
    return false;
  setenv("GOMP_SPINCOUNT", "10000", 1);
  return true;
}

#ifdef DIPTYCH_OPENMP_INSIDE
/// OpenMP's runtime is in the program and reads its settings when its constructors run, later.
[[gnu::constructor(101)]] void limit_spinning_first() {
  limit_spinning();
}
#endif

/// Who reads standard output has gone, with what it wanted: `diptych list | head`.
bool is_left_by_reader() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

/// What was printed has arrived, as far as somebody reads it. @throws base::EnvironmentError where
/// it has not
void check_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (is_left_by_reader()) return;
  const char* reason = errno != 0 ? std::strerror(errno) : "a write failed";
  throw base::EnvironmentError(
      fmt::format("standard output: not all could be written: {}", reason));
}

/// Another rank than 0: what interrupts rank 0 ends the run, and so this one.
int follow() {
  harness::pass_signals_on();
  return harness::follow_runs();
}

/// Of several ranks that could not join one says so: rank 0, whose end is that of the others too.
/// What another rank alone has met it says a while later, if it is still there.
void complain(const std::string& message) {
  using std::chrono::milliseconds;
  const int rank = parallel::launched_ranks() > 1 ? parallel::launched_rank() : 0;
  std::string who;
  if (rank > 0) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
      std::signal(signal, SIG_DFL);
    std::this_thread::sleep_for(milliseconds(1000 + 100 * std::min(rank, 40)));
    who = fmt::format("rank {} of {}: ", rank, parallel::launched_ranks());
  }
  std::fputs(fmt::format("diptych: {}{}\n", who, message).c_str(), stderr);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    require_stack(argv);
#ifndef DIPTYCH_OPENMP_INSIDE
    if (limit_spinning()) start_once_more(argv);  // OpenMP's runtime reads it when it is loaded
#endif
    std::signal(SIGUSR1, SIG_IGN);  // until there is what can be kept
    const parallel::Ranks ranks({harness::take_signal, harness::obey_signal});
    harness::require_one_program();
    harness::catch_interrupts();
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
