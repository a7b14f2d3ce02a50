#pragma once
/// Stops a run whose energy budget does not close, or whose numerical dissipation gives energy in
/// place of taking it: an unstable run makes energy of nothing long before a J or a value shows it.
/// Test: tests/common/run/guards_test.cpp

#include "common/run/energy_record.hpp"
#include "common/run/observers/observer.hpp"

#include <cstdint>

namespace diptych::run {

class EnergyGuard : public Observer {
 public:
  /// @param initial       of the body at t = 0
  /// @param threshold     largest admissible |residual|, and dissipation below zero, as a share of
  ///                      the largest energy so far
  /// @param least_energy  J, what rounding makes of the energies: a body that holds no more is at
  ///                      rest, and as much of any residual is not judged
  EnergyGuard(const scheme::Balance& initial, double threshold, double least_energy)
      : energy_(initial), threshold_(threshold), least_energy_(least_energy) {}

  /// A residual that is not finite is refused at once. Others are not judged while the body is at
  /// rest, nor in the first steps after it: see steps_of_start.
  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }

  void archive(algebra::Archive& archive) override {
    energy_.archive("energy guard", archive);
    archive.integer("energy guard/judged from step", judged_from_);
  }

  /// A load on a body at rest brings, in its first steps, less energy than a step errs by: shipped
  /// cases have residuals of 0.1 to 2e3 after five steps, and below 0.03 after twenty.
  static constexpr std::int64_t steps_of_start = 20;

 private:
  EnergyRecord energy_;
  double threshold_, least_energy_;
  std::int64_t judged_from_ = 0;  // step
};

}  // namespace diptych::run
