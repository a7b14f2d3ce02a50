#include "benchmarks/run/interruption.hpp"

#include "common/base/error.hpp"
#include "common/parallel/ranks.hpp"

#include <csignal>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace diptych::harness {

namespace {

/// Schedulers and timeout(1) signal the program and its group: what comes within a second is the
/// same request. (Both calls are safe in a handler.)
constexpr double same_request = 1;  // s

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

volatile double asked_at = 0;  // s, 0: not yet

void say(std::string_view text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
}

void end_after_this_step(int signal) {
  if (asked_at > 0) {
    if (seconds() - asked_at < same_request) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  asked_at = seconds();
  request_interrupt();
  constexpr std::string_view text =
      "\ndiptych: ending after this step; once more stops at once, unwritten\n";
  say(text);
  if (const char* phase = parallel::phase(); phase != nullptr) {
    say("diptych: rank 0 was in ");
    say(phase);
    say("\n");
  }
}

void keep_after_this_step(int) {
  base::request_checkpoint();
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, end_after_this_step);
  std::signal(SIGTERM, end_after_this_step);
  // nohup has it ignored, which is to stay so
  if (std::signal(SIGHUP, end_after_this_step) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGUSR1, keep_after_this_step);
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
