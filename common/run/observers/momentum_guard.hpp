#pragma once
/// Stops a run whose angular momentum is no longer that of its start and of the moments of loads
/// and supports: numerical dissipation of too coarse a mesh brakes the rotation of the body.
/// Test: tests/common/run/guards_test.cpp

#include "common/run/momentum_record.hpp"
#include "common/run/observers/observer.hpp"

#include <cstdint>

namespace diptych::run {

class MomentumGuard : public Observer {
 public:
  /// @param initial       of the body at t = 0
  /// @param threshold     largest admissible drift, see MomentumRecord
  /// @param least_energy  J, what rounding makes of the energies: a body that moves with no more is
  ///                      at rest, and neither it nor its first steps afterwards are judged
  MomentumGuard(const scheme::Balance& initial, double threshold, double least_energy)
      : momenta_(initial), threshold_(threshold), least_energy_(least_energy) {}

  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }

  void archive(algebra::Archive& archive) override {
    momenta_.archive("momentum guard", archive);
    archive.integer("momentum guard/judged from step", judged_from_);
  }

  static constexpr std::int64_t steps_of_start = 20;

 private:
  MomentumRecord momenta_;
  double threshold_, least_energy_;
  std::int64_t judged_from_ = 0;  // step
};

}  // namespace diptych::run
