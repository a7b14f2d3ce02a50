#pragma once
/// Progress of a run on the standard error stream, with the time left: one line that is rewritten
/// on a terminal; in a log a line after 2 s, 4 s more, 8 s more, ... and at least every half hour.
/// Test: tests/command_line/interrupt_test.cpp

#include <chrono>
#include <cstdint>
#include <string>

namespace diptych::harness {

class Progress {
 public:
  /// @param label  "sph level 2"
  Progress(std::string label, double end_time, bool quiet);
  ~Progress();
  /// Whether the next show() would print: the caller then works out the energy residual.
  bool due() const;
  void show(double time, std::int64_t step, double dt, double energy_residual);
  /// Ends the line on a terminal.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  double end_time_;
  bool quiet_, on_terminal_;
  bool line_open_ = false;
  Clock::time_point start_, last_;
  double pause_;  ///< s, to the next line
};

/// "12 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

}  // namespace diptych::harness
