#pragma once
/// The fields of a body at an output time, taken from the solver when something first asks for
/// them: a row of the history needs none of them.
/// Test: tests/common/run/simulation_test.cpp

#include "common/run/solver.hpp"

#include <span>

namespace diptych::run {

class OutputState {
 public:
  /// @param solver  kept by reference; it stays at the output time as long as this is asked
  /// @param fields  kept by reference; where they go
  OutputState(const Solver& solver, Snapshot& fields)
      : solver_(solver), fields_(fields), time_(solver.time()) {}

  double time() const { return time_; }  ///< s

  /// Of these nodes, in this order.
  Snapshot fields_of(std::span<const std::int32_t> nodes) {
    return has_fields_ ? fields_.of(nodes) : solver_.snapshot(nodes);
  }

  const Snapshot& fields() {
    if (!has_fields_) solver_.take_snapshot(fields_);
    has_fields_ = true;
    return fields_;
  }

 private:
  const Solver& solver_;
  Snapshot& fields_;
  double time_;
  bool has_fields_ = false;
};

}  // namespace diptych::run
