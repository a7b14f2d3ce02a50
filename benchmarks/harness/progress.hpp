#pragma once
/// Progress of a run on the standard error stream: one line that is rewritten on a terminal, a
/// plain line per tenth in a log; silent for runs of under two seconds in a log.

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
  bool due(double time) const;
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
  double next_fraction_ = 0.1;
};

/// "12 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

}  // namespace diptych::harness
