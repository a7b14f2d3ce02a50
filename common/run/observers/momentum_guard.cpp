#include "common/run/observers/momentum_guard.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

double MomentumGuard::judged(const Check& check) {
  momenta_.at(check.balance, check.audit);
  const double work = std::abs(check.audit.external_work);
  moment_of_loads_ += work * (check.step.time - time_);
  largest_work_ = std::max(largest_work_, work);
  time_ = check.step.time;
  const double drift = momenta_.angular_drift(), scale = momenta_.angular_scale();
  if (held_inertia_ == 0) return drift;
  of_loads_ = std::max(moment_of_loads_, std::sqrt(2 * held_inertia_ * largest_work_));
  return of_loads_ > scale ? drift * scale / of_loads_ : drift;
}

void MomentumGuard::at_check(const Check& check) {
  const double drift = judged(check);
  if (check.balance.kinetic <= least_energy_) judged_from_ = check.step.step + steps_of_start;
  if (check.step.step < judged_from_ || drift <= threshold_) return;
  throw base::BreakdownError(fmt::format(
      "angular momentum has drifted by {:.3g} of {}, bound {:g}, "
      "step {}, time {:.6g} s, dt {:.4g} s\n"
      "  numerical dissipation brakes the rotation: use a finer mesh (--level) or, of a free body, "
      "scheme.angular_momentum_projection = true; guards.angular_drift raises the bound",
      drift,
      of_loads_ > momenta_.angular_scale() ? "the moments of the loads so far"
                                           : "the largest sum of |x||p| so far",
      threshold_, check.step.step, check.step.time, check.step.dt));
}

}  // namespace diptych::run
