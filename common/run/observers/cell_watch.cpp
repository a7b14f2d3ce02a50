#include "common/run/observers/cell_watch.hpp"

#include <algorithm>

namespace diptych::run {

void CellWatch::after_step(const StepReport& step) {
  const bool is_due =
      step.step >= next_ || step.is_at_limit || nodal_J_ - step.least_J >= of_J * J_;
  if (!is_due) return;
  const CellOutlook outlook = look_(solver_.motion(), step.dt);
  if (outlook.now.n_inverted > 0)
    throw RefusedStep(outlook.now.message(step.step, step.time), outlook.now.node);
  const double steps = std::clamp(of_steps * outlook.steps_left, 1.0, static_cast<double>(period));
  next_ = step.step + static_cast<std::int64_t>(steps);
  J_ = outlook.now.J;
  nodal_J_ = step.least_J;
}

void CellWatch::archive(algebra::Archive& archive) {
  archive.integer("cell watch/next step", next_);
  archive.real("cell watch/J", "-", J_);
  archive.real("cell watch/nodal J", "-", nodal_J_);
}

}  // namespace diptych::run
