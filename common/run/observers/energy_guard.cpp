#include "common/run/observers/energy_guard.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

void EnergyGuard::at_check(const Check& check) {
  const io::EnergySummary energy = energy_.at(check.balance, check.audit);
  const double residual = energy.relative_residual;
  const double held =
      std::max(energy.kinetic + std::abs(energy.strain), std::abs(energy.external_work));
  const StepReport& step = check.step;
  const double gained = -energy.numerical_dissipation;
  if (gained > threshold_ * energy_.scale() + least_energy_) {
    throw base::BreakdownError(fmt::format(
        "numerical dissipation has given the body {:.3g} of the largest energy so far, bound {:g}, "
        "step {}, time {:.6g} s, dt {:.4g} s\n"
        "  what is left of linear reconstructions has the wrong sign here: use scheme.limiter = "
        "\"sign-preserving\" or scheme.reconstruction = \"none\"; guards.energy_residual raises "
        "the "
        "bound",
        gained / energy_.scale(), threshold_, step.step, step.time, step.dt));
  }
  if (std::isfinite(residual)) {
    if (held <= least_energy_) judged_from_ = step.step + steps_of_start;
    const double open = std::abs(residual) * energy_.scale();
    if (step.step < judged_from_ || open <= threshold_ * energy_.scale() + least_energy_) return;
  }
  throw base::BreakdownError(fmt::format(
      "the energy budget does not close: residual {:.3g} of the largest energy so far, bound {:g}, "
      "step {}, time {:.6g} s, dt {:.4g} s\n"
      "  the step is too large, or the scheme is unstable here: try a smaller time.cfl or a finer "
      "mesh; guards.energy_residual raises the bound",
      residual, threshold_, step.step, step.time, step.dt));
}

}  // namespace diptych::run
