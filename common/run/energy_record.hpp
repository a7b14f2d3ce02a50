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

/// What energies of a body are measured with.
struct EnergyUnits {
  /// J, energy_of_rounding(), and what rounding makes of `carried`: a body that has held no more
  /// has no residual.
  double rounding = 0;
  /// J, kinetic energy of the centre of mass that a body without supports begins with: as much as
  /// the frame in which it is described gives it, and so no measure of what it holds.
  double carried = 0;
};

/// Budget of a run relative to the largest energy that it has held.
class EnergyRecord {
 public:
  explicit EnergyRecord(const scheme::Balance& initial, const EnergyUnits& units = {})
      : initial_(initial.kinetic + initial.strain),
        scale_(initial_ - units.carried),
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
    e.relative_residual = scale_ > units_.rounding ? residual / scale_ : 0;
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
