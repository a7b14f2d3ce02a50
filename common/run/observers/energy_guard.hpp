#pragma once
/// Stops a run whose energy budget does not close: an unstable run makes energy of nothing long
/// before a J or a value shows it. Test: tests/common/run/guards_test.cpp

#include "common/run/observers/history.hpp"

#include <cstdint>

namespace diptych::run {

class EnergyGuard : public Observer {
 public:
  /// @param history       has the residual; kept by reference, told of an output before this one
  /// @param threshold     largest admissible |residual| as a share of the largest energy so far
  /// @param least_energy  J; what holds no more is at rest, and its residual is rounding
  EnergyGuard(const History& history, double threshold, double least_energy)
      : history_(history), threshold_(threshold), least_energy_(least_energy) {}

  /// A residual that is not finite is refused at any output. Others are not judged while the body
  /// is at rest, nor in the first steps after it: see steps_of_start.
  /// @throws base::BreakdownError
  void at_output(const Output& output) override;

  /// A load on a body at rest brings, in its first steps, less energy than a step errs by: shipped
  /// cases have residuals of 0.1 to 2e3 after five steps, and below 0.03 after twenty.
  static constexpr std::int64_t steps_of_start = 20;

 private:
  const History& history_;
  double threshold_, least_energy_;
  std::int64_t judged_from_ = 0;  // step
};

}  // namespace diptych::run
