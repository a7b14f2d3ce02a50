#include "common/run/observers/energy_guard.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

void EnergyGuard::refuse_gain(const Check& check, double gained) const {
  throw base::BreakdownError(fmt::format(
      "numerical dissipation has given the body {:.3g} of the largest energy so far, bound {:g}, "
      "step {}, time {:.6g} s, dt {:.4g} s\n"
      "  what is left of linear reconstructions has the wrong sign here: use scheme.limiter = "
      "\"sign-preserving\" or scheme.reconstruction = \"none\"; guards.energy_residual raises the "
      "bound",
      gained / energy_.scale(), threshold_, check.step.step, check.step.time, check.step.dt));
}

void EnergyGuard::refuse_loss(const Check& check, double lost) const {
  throw base::BreakdownError(fmt::format(
      "numerical dissipation has taken {:.3g} of the largest energy so far, bound {:g}, step {}, "
      "time {:.6g} s, dt {:.4g} s\n"
      "  the mesh does not resolve the motion: use a finer one (--level); where shocks dissipate, "
      "a "
      "limiter says so (scheme.limiter); guards.numerical_dissipation sets the bound",
      lost / energy_.scale(), largest_loss_, check.step.step, check.step.time, check.step.dt));
}

void EnergyGuard::at_check(const Check& check) {
  const io::EnergySummary energy = energy_.at(check.balance, check.audit);
  const double residual = energy.relative_residual;
  const double held =
      std::max(energy.kinetic + std::abs(energy.strain), std::abs(energy.external_work));
  const StepReport& step = check.step;
  const double lost = energy.numerical_dissipation;
  if (-lost > threshold_ * energy_.scale() + least_energy_) refuse_gain(check, -lost);
  if (std::isfinite(residual)) {
    if (held <= least_energy_) judged_from_ = step.step + steps_of_start;
    if (step.step < judged_from_) return;
    if (lost > largest_loss_ * energy_.scale() + least_energy_) refuse_loss(check, lost);
    if (std::abs(residual) * energy_.scale() <= threshold_ * energy_.scale() + least_energy_)
      return;
  }
  throw base::BreakdownError(fmt::format(
      "the energy budget does not close: residual {:.3g} of the largest energy so far, bound {:g}, "
      "step {}, time {:.6g} s, dt {:.4g} s\n"
      "  the step is too large, or the scheme is unstable here: try a smaller time.cfl or a finer "
      "mesh; guards.energy_residual raises the bound",
      residual, threshold_, step.step, step.time, step.dt));
}

}  // namespace diptych::run
