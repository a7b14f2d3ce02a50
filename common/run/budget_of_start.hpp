#pragma once
/// The energy budget of the first steps (notes 5.6). A Runge-Kutta step of the largest stable size
/// errs most where a body sets off: from velocities without strain, or at a wall. What its budget
/// has lost there it never gets back. Test: tests/common/run/budget_of_start_test.cpp

#include "common/run/energy_units.hpp"
#include "common/scheme/budget/audit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

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
    EnergyUnits energies;
  };

  /// @param first  steps made before
  BudgetOfStart(const scheme::Balance& initial, const Bounds& bounds, std::int64_t first = 0)
      : units_(bounds.energies),
        first_(first),
        is_at_rest_(!(held(initial) > units_.rounding(units_.frame.carried(initial)))),
        share_(is_at_rest_ ? 0 : bounds.opening / static_cast<double>(n_steps)) {}

  /// What it knows beside the units, to make another one of.
  std::vector<double> numbers() const {
    return {static_cast<double>(first_), is_at_rest_ ? 1.0 : 0.0, share_};
  }
  BudgetOfStart(const EnergyUnits& units, const std::vector<double>& numbers)
      : units_(units),
        first_(static_cast<std::int64_t>(numbers.at(0))),
        is_at_rest_(numbers.at(1) != 0),
        share_(numbers.at(2)) {}

  /// What a body has of energies but for what its frame gives it  [J]
  double held(const scheme::Balance& balance) const {
    return balance.kinetic - units_.frame.carried(balance) + std::abs(balance.strain);
  }
  bool is_at_rest() const { return is_at_rest_; }

  /// @param step  steps made before
  bool judges(std::int64_t step) const { return share_ > 0 && step - first_ < n_steps; }

  /// The step between has opened the budget by more than its share of the energy that is there.
  bool opens(const EnergyBudget& before, const EnergyBudget& after) const {
    const double opened = std::abs(after.unaccounted() - before.unaccounted());
    return opened > share_ * std::max(held(before.balance), held(after.balance));
  }

 private:
  EnergyUnits units_;
  std::int64_t first_;
  bool is_at_rest_;
  double share_;
};

}  // namespace diptych::run
