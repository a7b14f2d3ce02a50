#pragma once
/// Progress of a run on the standard error stream, with the time of the scene, the time left, and
/// that of the whole command where it makes several runs: one line that is rewritten on a terminal
/// and fits it; in a log a line after 2 s, 4 s more, 8 s more, ... and at least every half hour.
/// Test: tests/harness/progress_test.cpp, tests/command_line/interrupt_test.cpp

#include "benchmarks/terminal/schedule.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace diptych::harness {

/// What a line of progress tells.
struct ProgressState {
  std::string label;              ///< "sph level 2"
  size_t run = 1, n_runs = 1;     ///< number of the run in its command, from 1
  double time = 0, end_time = 1;  ///< s, of the scene
  std::int64_t step = 0;
  double dt = 0;               ///< s
  double energy_residual = 0;  ///< relative
  double seconds_left = 0;     ///< of the run
  std::optional<double> command_seconds_left;
  std::int64_t rejected = 0;  ///< steps, made again with half the size
};

/// "fvm level 2, run 2 of 6   45 %  step 900  dt 2e-05 s  t 0.13 of 0.3 s  12 s left, all runs 3
/// min 20 s  energy residual 1.0e-05", and "2 rejected" behind the step where there were such.
/// Where that is too long dt goes, then step, residual and number.
/// @param width  columns there are; 0: any number
std::string progress_line(const ProgressState& state, size_t width);

class Progress {
 public:
  /// @param label     "sph level 2"
  /// @param schedule  of the command that makes this run; null where it is the only one
  Progress(std::string label, double end_time, bool quiet, const Schedule* schedule = nullptr);
  ~Progress();
  /// Where the run has begun, or gone on from: what is left is told by the pace since  [s]
  void begin_at(double time) { begin_time_ = time; }
  /// Whether the next show() would print: the caller then works out the energy residual.
  bool due() const;
  void show(
      double time, std::int64_t step, double dt, double energy_residual, std::int64_t rejected);
  /// Ends the line on a terminal.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  double begin_time_ = 0, end_time_;
  bool quiet_, on_terminal_;
  const Schedule* schedule_;
  bool line_open_ = false;
  Clock::time_point start_, last_;
  double pause_;  ///< s, to the next line
};

/// "12 s", "3 min 20 s", "2 h 5 min", "8 days 3 h", "more than a year"
std::string duration_text(double seconds);

}  // namespace diptych::harness
