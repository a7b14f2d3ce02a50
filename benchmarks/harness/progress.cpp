#include "benchmarks/harness/progress.hpp"

#include <algorithm>
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
  if (!(seconds >= 0)) return "unknown time";  // NaN too
  if (seconds >= 1e9) return "more than 30 years";
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 6000) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 360000) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} days {} h", whole / 86400, whole % 86400 / 3600);
}

Progress::Progress(std::string label, double end_time, bool quiet)
    : label_(std::move(label)),
      end_time_(end_time),
      quiet_(quiet),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_),
      pause_(on_terminal_ ? 0.25 : 2) {}

Progress::~Progress() {
  finish();
}

bool Progress::due() const {
  return !quiet_ && seconds_since(last_) > pause_;
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
  if (!on_terminal_) pause_ = std::min(2 * pause_, 1800.0);
}

void Progress::finish() {
  if (!line_open_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  line_open_ = false;
}

}  // namespace diptych::harness
