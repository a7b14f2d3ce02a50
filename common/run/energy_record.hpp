#pragma once
/// The energy budget of a run over time, relative to what it has held.

#include "common/algebra/archive.hpp"
#include "common/io/run_record.hpp"
#include "common/run/energy_units.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/budget/balance.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace diptych::run {

/// Budget of a run relative to the largest energy that it has held.
class EnergyRecord {
 public:
  explicit EnergyRecord(const scheme::Balance& initial, const EnergyUnits& units = {})
      : initial_(initial.kinetic + initial.strain),
        scale_(std::max(0.0, initial_ - units.carried)),
        units_(units) {}

  io::EnergySummary at(const scheme::Balance& now, const scheme::Audit& audit) {
    io::EnergySummary e;
    e.kinetic = now.kinetic;
    e.strain = now.strain;
    e.external_work = audit.external_work;
    e.numerical_dissipation = audit.numerical_dissipation;
    e.viscous_dissipation = audit.viscous_dissipation;
    e.projection_work = audit.projection_work;
    scale_ = std::max(
        {scale_, now.kinetic + now.strain - units_.carried, std::abs(audit.external_work)});
    const double residual = now.kinetic + now.strain - initial_ - audit.gain();
    e.relative_residual =
        scale_ > units_.rounding || !std::isfinite(residual) ? residual / scale_ : 0;
    return e;
  }

  /// The largest energy so far, to which residuals are relative  [J]
  double scale() const { return scale_; }
  const EnergyUnits& units() const { return units_; }

  /// @param group  of the archive, without "/" at its end
  void archive(const std::string& group, algebra::Archive& archive) {
    archive.real(group + "/initial energy", "J", initial_);
    archive.real(group + "/largest energy", "J", scale_);
  }

 private:
  double initial_, scale_;
  EnergyUnits units_;
};

}  // namespace diptych::run
