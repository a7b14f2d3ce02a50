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

/// Budget of a run relative to the largest energy that it has held, and that was brought in, in the
/// frame of its centre of mass where nothing that stands still holds it (CentreFrame).
class EnergyRecord {
 public:
  explicit EnergyRecord(const scheme::Balance& initial, const EnergyUnits& units = {})
      : initial_(initial.kinetic + initial.strain),
        units_(units),
        initially_carried_(units.frame.carried(initial)),
        rounding_(units.rounding(initially_carried_)),
        scale_(std::max(0.0, initial_ - initially_carried_)),
        motion_(std::max(0.0, initial.kinetic - initially_carried_)),
        least_strain_(initial.strain) {}

  io::EnergySummary at(const scheme::Balance& now, const scheme::Audit& audit) {
    io::EnergySummary e;
    e.kinetic = now.kinetic;
    e.strain = now.strain;
    e.external_work = audit.external_work;
    e.numerical_dissipation = audit.numerical_dissipation;
    e.viscous_dissipation = audit.viscous_dissipation;
    e.projection_work = audit.projection_work;
    const double carried = units_.frame.carried(now);
    held_ = now.kinetic - carried + std::abs(now.strain);
    work_ = std::abs(audit.external_work - (carried - initially_carried_));
    rounding_ = std::max(rounding_, units_.rounding(carried));
    scale_ = std::max({scale_, now.kinetic - carried + now.strain, work_});
    motion_ = std::max({motion_, now.kinetic - carried, work_});
    least_strain_ = std::min(least_strain_, now.strain);
    const double residual = now.kinetic + now.strain - initial_ - audit.gain();
    e.relative_residual = scale_ > rounding_ || !std::isfinite(residual) ? residual / scale_ : 0;
    return e;
  }

  /// The largest energy so far, to which residuals are relative  [J]
  double scale() const { return scale_; }
  /// What rounding has made of energies so far  [J]
  double rounding() const { return rounding_; }
  /// The largest energy so far without strain energy, of which rounding leaves less than of speeds
  /// [J]
  double motion() const { return motion_; }
  /// What the body held to begin with  [J]
  double initial() const { return std::max(0.0, initial_ - initially_carried_); }
  /// The largest energy so far without the strain energy that has been there all the time, as of a
  /// body that is stretched to begin with: what has moved  [J]
  double mobile() const {
    const double above = std::max(scale_ - std::max(0.0, least_strain_), motion_);
    return above > std::max(rounding_, 1e-9 * scale_) ? above : 0;
  }
  /// At the last instant: what the body holds, and what was brought in so far  [J]
  double held() const { return held_; }
  double work() const { return work_; }

  /// @param group  of the archive, without "/" at its end
  void archive(const std::string& group, algebra::Archive& archive) {
    archive.real(group + "/initial energy", "J", initial_);
    archive.real(group + "/initially carried energy", "J", initially_carried_);
    archive.real(group + "/rounding", "J", rounding_);
    archive.real(group + "/largest energy", "J", scale_);
    archive.real(group + "/largest energy of motion", "J", motion_);
    archive.real(group + "/least strain energy", "J", least_strain_);
  }

 private:
  double initial_;
  EnergyUnits units_;
  double initially_carried_, rounding_, scale_, motion_, least_strain_;
  double held_ = 0, work_ = 0;
};

}  // namespace diptych::run
