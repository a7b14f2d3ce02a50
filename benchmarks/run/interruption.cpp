#include "benchmarks/run/interruption.hpp"

#include "common/base/error.hpp"
#include "common/parallel/ranks.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace diptych::harness {

namespace {

/// Schedulers and timeout(1) signal the program and its group: what comes within a second is the
/// same request. (Both calls are safe in a handler.)
constexpr double same_request = 1;           // s
constexpr double same_request_of_ranks = 3;  // s; they look for signals once a second

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// lock-free: of handlers, and of the thread that watches other ranks
std::atomic<double> asked_at = 0, keeping_asked_at = 0;  // s, 0: not yet
std::atomic<int> signal_to_pass = 0;
std::atomic<bool> is_asked_by_rank = false;  // other than 0
/// Whether Open MPI's mpirun kills its ranks a second after it tells them to end.
bool is_killed_soon = false;

void say(std::string_view text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
}

void end_after_this_step(int signal) {
  if (asked_at > 0) {
    if (seconds() - asked_at < (is_asked_by_rank ? same_request_of_ranks : same_request)) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  asked_at = seconds();
  request_interrupt();
  say("\ndiptych: ending after this step");
  if (const char* phase = parallel::phase(); phase != nullptr) {
    say(" (rank 0 is in ");
    say(phase);
    say(")");
  }
  say("; once more stops at once, unwritten\n");
  if (signal == SIGTERM && is_killed_soon) {
    say("diptych: mpirun kills its ranks a second after Ctrl-C; with --mca "
        "odls_base_sigkill_timeout 60 it leaves them a minute\n");
  }
}

void keep_after_this_step(int) {
  keeping_asked_at = seconds();
  base::request_checkpoint();
}

/// What ends the run goes before what keeps it.
void pass_on(int signal) {
  int none = 0;
  if (signal == SIGUSR1) {
    signal_to_pass.compare_exchange_strong(none, signal);
  } else {
    signal_to_pass = signal;
  }
}

const char* name_of(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, end_after_this_step);
  std::signal(SIGTERM, end_after_this_step);
  // nohup has it ignored, which is to stay so
  if (std::signal(SIGHUP, end_after_this_step) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGUSR1, keep_after_this_step);
  is_killed_soon = parallel::launched_ranks() > 1 &&
                   std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr &&
                   std::getenv("OMPI_MCA_odls_base_sigkill_timeout") == nullptr;
}

void pass_signals_on() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
    std::signal(signal, pass_on);
  if (std::signal(SIGHUP, pass_on) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

int take_signal() {
  return signal_to_pass.exchange(0);
}

void obey_signal(int rank, int signal) {
  if (signal == SIGUSR1) {
    if (seconds() - keeping_asked_at > same_request_of_ranks) keep_after_this_step(signal);
    return;
  }
  if (asked_at > 0) return;
  is_asked_by_rank = true;
  asked_at = seconds();
  request_interrupt();
  say(fmt::format("\ndiptych: ending after this step, since rank {} was sent {}\n", rank,
                  name_of(signal)));
}

int exit_code_of_study(const std::string& to_go_on) {
  if (!interrupt_requested()) return 0;
  std::fputs(fmt::format("diptych: interrupted; {}\n", to_go_on).c_str(), stderr);
  return static_cast<int>(base::ExitCode::interrupted);
}

std::string begin_again(const std::string& directory) {
  return fmt::format(
      "what had been computed is in {} (status \"interrupted\")\n"
      "diptych: the same command begins the run again, at t = 0",
      directory);
}

std::string go_on_from_checkpoint(const std::string& directory) {
  return fmt::format(
      "what had been computed is in {} (status \"interrupted\")\n"
      "diptych: with --restart latest the same command goes on from there; without it, it begins "
      "again, at t = 0",
      directory);
}

std::string go_on_from(const std::string& directory) {
  return fmt::format("finished runs are kept in {}\ndiptych: the same command goes on from there",
                     directory);
}

}  // namespace diptych::harness
