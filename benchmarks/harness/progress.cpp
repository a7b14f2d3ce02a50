#include "benchmarks/harness/progress.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace diptych::harness {

namespace {
double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 6000) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::string label, double end_time, bool quiet)
    : label_(std::move(label)),
      end_time_(end_time),
      quiet_(quiet),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  finish();
}

bool Progress::due(double time) const {
  if (quiet_) return false;
  if (on_terminal_) return seconds_since(last_) > 0.25;
  return seconds_since(start_) > 2 && time / end_time_ >= next_fraction_;
}

void Progress::show(double time, std::int64_t step, double dt, double energy_residual) {
  const double fraction = time / end_time_, elapsed = seconds_since(start_);
  const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
  const std::string line =
      fmt::format("{}  {:3.0f} %  step {}  dt {:.3g} s  {} left  energy residual {:.1e}", label_,
                  100 * fraction, step, dt, duration_text(left), energy_residual);
  std::fputs((on_terminal_ ? "\r\033[K" + line : line + "\n").c_str(), stderr);
  std::fflush(stderr);
  line_open_ = on_terminal_;
  last_ = Clock::now();
  while (next_fraction_ <= fraction)
    next_fraction_ += 0.1;
}

void Progress::finish() {
  if (!line_open_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  line_open_ = false;
}

}  // namespace diptych::harness
