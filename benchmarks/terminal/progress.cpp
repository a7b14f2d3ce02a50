#include "benchmarks/terminal/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace diptych::harness {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Columns of the terminal, asked every time since users resize it; 100 where it does not say.
size_t terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 100;
}

/// A part of the line, and how early it is left out: 0 is never.
struct Part {
  std::string text;
  int leave_out = 0;
};

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

std::string progress_line(const ProgressState& s, size_t width) {
  std::string left = fmt::format("  {} left", duration_text(s.seconds_left));
  if (s.command_seconds_left) left += ", all runs " + duration_text(*s.command_seconds_left);
  const std::string number = s.n_runs > 1 ? fmt::format(", run {} of {}", s.run, s.n_runs) : "";
  const Part parts[] = {{s.label, 0},
                        {number, 4},
                        {fmt::format("  {:3.0f} %", 100 * s.time / s.end_time), 0},
                        {fmt::format("  step {}", s.step), 2},
                        {s.rejected > 0 ? fmt::format(", {} rejected", s.rejected) : "", 2},
                        {fmt::format("  dt {:.3g} s", s.dt), 1},
                        {fmt::format("  t {:.4g} of {:.4g} s", s.time, s.end_time), 0},
                        {left, 0},
                        {fmt::format("  energy residual {:.1e}", s.energy_residual), 3}};
  std::string line;
  for (int left_out = 0; left_out <= 4; ++left_out) {
    line.clear();
    for (const Part& part : parts) {
      if (part.leave_out == 0 || part.leave_out > left_out) line += part.text;
    }
    if (width == 0 || line.size() <= width) return line;
  }
  return line.substr(0, width);
}

Progress::Progress(std::string label, double end_time, bool quiet, const Schedule* schedule)
    : label_(std::move(label)),
      end_time_(end_time),
      quiet_(quiet),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      schedule_(schedule),
      start_(Clock::now()),
      last_(start_),
      pause_(on_terminal_ ? 0.25 : 2) {}

Progress::~Progress() {
  finish();
}

bool Progress::due() const {
  return !quiet_ && seconds_since(last_) > pause_;
}

void Progress::show(
    double time, std::int64_t step, double dt, double energy_residual, std::int64_t rejected) {
  const double fraction = (time - begin_time_) / (end_time_ - begin_time_);
  const double elapsed = seconds_since(start_);
  const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
  ProgressState state{label_,       1,       1, time, end_time_, step, dt, energy_residual, left,
                      std::nullopt, rejected};
  if (schedule_ != nullptr && schedule_->n_runs() > 1) {
    state.run = schedule_->current() + 1;
    state.n_runs = schedule_->n_runs();
    if (state.run < state.n_runs)
      state.command_seconds_left = schedule_->seconds_left(left, elapsed + left);
  }
  // a terminal that is filled to its last column may begin a new line
  const std::string line = progress_line(state, on_terminal_ ? terminal_width() - 1 : 0);
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
