#pragma once
/// The energy budget of a run over time, relative to what it has held.

#include "common/algebra/archive.hpp"
#include "common/io/run_record.hpp"
#include "common/scheme/budget/audit.hpp"
#include "common/scheme/budget/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace diptych::run {

/// What rounding makes of the energies of a body, some eps of rho c_p^2 a volume, that of a strain
/// of 1e-8: a body that holds no more is at rest  [J]
/// @param density  kg/m^3  @param speed  of pressure waves of the undeformed body, m/s
/// @param Omega    m^3 (m^2)
inline double energy_of_rounding(double density, double speed, const std::vector<double>& Omega) {
  const double volume = std::accumulate(Omega.begin(), Omega.end(), 0.0);
  return std::numeric_limits<double>::epsilon() * density * speed * speed * volume;
}

/// Budget of a run relative to the largest energy that it has held.
class EnergyRecord {
 public:
  /// @param least_energy  J, energy_of_rounding(): a body that has held no more has no residual
  explicit EnergyRecord(const scheme::Balance& initial, double least_energy = 0)
      : initial_(initial.kinetic + initial.strain), scale_(initial_), least_energy_(least_energy) {}

  io::EnergySummary at(const scheme::Balance& now, const scheme::Audit& audit) {
    io::EnergySummary e;
    e.kinetic = now.kinetic;
    e.strain = now.strain;
    e.external_work = audit.external_work;
    e.numerical_dissipation = audit.numerical_dissipation;
    e.viscous_dissipation = audit.viscous_dissipation;
    e.projection_work = audit.projection_work;
    scale_ = std::max({scale_, now.kinetic + now.strain, std::abs(audit.external_work)});
    const double residual = now.kinetic + now.strain - initial_ - audit.gain();
    e.relative_residual = scale_ > least_energy_ ? residual / scale_ : 0;
    return e;
  }

  /// The largest energy so far, to which residuals are relative  [J]
  double scale() const { return scale_; }

  /// @param group  of the archive, without "/" at its end
  void archive(const std::string& group, algebra::Archive& archive) {
    archive.real(group + "/initial energy", "J", initial_);
    archive.real(group + "/largest energy", "J", scale_);
  }

 private:
  double initial_, scale_, least_energy_;
};

}  // namespace diptych::run
