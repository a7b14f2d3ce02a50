#include "common/run/observers/energy_guard.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

void EnergyGuard::at_output(const Output& output) {
  const io::EnergySummary& energy = history_.rows().back().energy;
  const double residual = energy.relative_residual;
  const double held =
      std::max(energy.kinetic + std::abs(energy.strain), std::abs(energy.external_work));
  if (std::isfinite(residual)) {
    if (held <= least_energy_) judged_from_ = output.step.step + steps_of_start;
    if (output.step.step < judged_from_ || std::abs(residual) <= threshold_) return;
  }
  throw base::BreakdownError(fmt::format(
      "the energy budget does not close: residual {:.3g} of the largest energy so far, bound {:g}, "
      "step {}, time {:.6g} s, dt {:.4g} s\n"
      "  the step is too large, or the scheme is unstable here: try a smaller time.cfl or a finer "
      "mesh; guards.energy_residual raises the bound",
      residual, threshold_, output.step.step, output.state.time, output.step.dt));
}

}  // namespace diptych::run
