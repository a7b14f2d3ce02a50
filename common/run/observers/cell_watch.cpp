#include "common/run/observers/cell_watch.hpp"

namespace diptych::run {

void CellWatch::after_step(const StepReport& step) {
  const bool is_due = step.step >= next_step_ || step.time >= next_time_ || step.is_at_limit ||
                      nodal_J_ - step.least_J >= of_J * J_;
  if (!is_due) return;
  const CellOutlook outlook = look_(step.dt);
  if (outlook.now.n_inverted > 0)
    throw RefusedStep(outlook.now.message(step.step, step.time), outlook.now.node);
  seen_step_ = step.step;
  seen_ = outlook.now;
  next_step_ = step.step + period;
  next_time_ = step.time + of_time * outlook.steps_left * step.dt;  // steps may become larger
  J_ = outlook.now.J;
  nodal_J_ = step.least_J;
}

void CellWatch::archive(algebra::Archive& archive) {
  archive.integer("cell watch/next step", next_step_);
  archive.real("cell watch/next time", "s", next_time_);
  archive.real("cell watch/J", "-", J_);
  archive.real("cell watch/nodal J", "-", nodal_J_);
}

}  // namespace diptych::run
