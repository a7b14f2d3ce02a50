#pragma once
/// Stops a run whose angular momentum is no longer that of its start and of the moments of loads
/// and supports: numerical dissipation of too coarse a mesh brakes the rotation of the body.
/// Test: tests/common/run/momentum_guard_test.cpp

#include "common/run/momentum_record.hpp"
#include "common/run/observers/observer.hpp"

#include <cstdint>

namespace diptych::run {

class MomentumGuard : public Observer {
 public:
  /// @param initial       of the body at t = 0
  /// @param held_inertia  inertia_if_held(), 0 of bodies without supports. One that is loaded
  ///                      slowly between them has hardly a momentum, but D_ab turns it with every
  ///                      strain. The drift counts as a share of what it would have if it turned
  ///                      with the work of loads and supports, and of the time integral of that
  ///                      work, too, where one of these is larger
  /// @param threshold     largest admissible drift, see MomentumRecord
  /// @param least_energy  J, what rounding makes of the energies: a body that moves with no more is
  ///                      at rest, and neither it nor its first steps afterwards are judged
  MomentumGuard(const scheme::Balance& initial,
                double held_inertia,
                double threshold,
                double least_energy)
      : momenta_(initial),
        held_inertia_(held_inertia),
        threshold_(threshold),
        least_energy_(least_energy) {}

  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }

  void archive(algebra::Archive& archive) override {
    momenta_.archive("momentum guard", archive);
    archive.integer("momentum guard/judged from step", judged_from_);
    archive.real("momentum guard/moment of loads", "N m s", moment_of_loads_);
    archive.real("momentum guard/largest work", "J", largest_work_);
    archive.real("momentum guard/time", "s", time_);
  }

  static constexpr std::int64_t steps_of_start = 20;

 private:
  /// Drift over its bound.
  double judged(const Check& check);

  MomentumRecord momenta_;
  double held_inertia_, threshold_, least_energy_;
  double moment_of_loads_ = 0;    // N m s, integral of their work
  double largest_work_ = 0;       // J, of loads and supports so far
  double of_loads_ = 0;           // N m s, what the drift is a share of where it is the larger
  double time_ = 0;               // s, of the last check
  std::int64_t judged_from_ = 0;  // step
};

}  // namespace diptych::run
