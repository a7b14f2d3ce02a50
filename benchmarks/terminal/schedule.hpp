#pragma once
/// The runs of a command, in the order in which they are made, and how long those that are left
/// will take: a run costs nodes times steps, h^-(d+1) from one level to another, of runs that cost
/// alike on one level; how methods compare is what finished runs say. Nothing is guessed of a kind
/// of run of which none is known. Pure: seconds are given, no clock is read. Test:
/// tests/harness/schedule_test.cpp

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

struct PlannedRun {
  std::string kind;    ///< runs of one kind differ in their level alone: "fvm kappa=1.2"
  std::string family;  ///< what a kind is judged by of which no run is known: "fvm"
  int level = 0;
  int dimension = 3;
};

class Schedule {
 public:
  explicit Schedule(std::vector<PlannedRun> runs) : runs_(std::move(runs)) {}

  size_t n_runs() const { return runs_.size(); }
  /// Of the run under way, from 0; n_runs() where all are done.
  size_t current() const { return seconds_.size(); }
  /// The run under way is over and the next begins.
  /// @param seconds  that it took, or had taken where it was taken over; nothing where that says
  ///                 nothing of its like, as after a breakdown
  void finish(std::optional<double> seconds) { seconds_.push_back(seconds); }

  /// To the end of the last run; nothing before every kind is known.
  /// @param own_left, own_total  seconds of the run under way, as its progress has them
  std::optional<double> seconds_left(double own_left, double own_total) const;

  /// The same between two runs.
  std::optional<double> seconds_left() const;

 private:
  std::optional<double> expected(const PlannedRun& run,
                                 const std::vector<std::optional<double>>& known) const;
  std::optional<double> left_after(size_t first,
                                   const std::vector<std::optional<double>>& known) const;

  std::vector<PlannedRun> runs_;
  std::vector<std::optional<double>> seconds_;  ///< s, of the runs that are over
};

}  // namespace diptych::harness
