#pragma once
/// The energy budget of the first steps (notes 5.6). A Runge-Kutta step of the largest stable size
/// errs most where a body sets off: from velocities without strain, or at a wall. What its budget
/// has lost there it never gets back. Test: tests/common/run/budget_of_start_test.cpp

#include "common/run/energy_units.hpp"
#include "common/scheme/budget/audit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace diptych::run {

/// Energies of a body and what has gone in and out until then.
struct EnergyBudget {
  scheme::Balance balance;
  scheme::Audit audit;
  double unaccounted() const { return balance.kinetic + balance.strain - audit.gain(); }
};

class BudgetOfStart {
 public:
  static constexpr std::int64_t n_steps = 20;

  struct Bounds {
    double opening = 0;  ///< of the budget by the first steps together, as a share of the
                         ///< energy
    /// A body that holds no more than rounding makes at t = 0 is at rest. It is not judged: what a
    /// load brings in its first steps is less than any step errs by.
    EnergyBasis energies;
  };

  BudgetOfStart(const scheme::Balance& initial, const Bounds& bounds)
      : units_(bounds.energies.at(initial)),
        share_(held(initial) > units_.rounding ? bounds.opening / static_cast<double>(n_steps)
                                               : 0) {}

  /// @param step  steps made before
  bool judges(std::int64_t step) const { return share_ > 0 && step < n_steps; }

  /// The step between has opened the budget by more than its share of the energy that is there.
  bool opens(const EnergyBudget& before, const EnergyBudget& after) const {
    const double opened = std::abs(after.unaccounted() - before.unaccounted());
    return opened > share_ * std::max(held(before.balance), held(after.balance));
  }

 private:
  double held(const scheme::Balance& balance) const {
    return balance.kinetic - units_.carried + std::abs(balance.strain);
  }

  EnergyUnits units_;
  double share_;
};

}  // namespace diptych::run
