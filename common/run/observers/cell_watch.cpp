#include "common/run/observers/cell_watch.hpp"

namespace diptych::run {

void CellWatch::after_step(const StepReport& step) {
  const bool is_due =
      step.step >= step_ + period || step.time >= next_ || nodal_J_ - step.least_J >= of_J * J_;
  if (!is_due) return;
  const LeastCell now = cells_.of(solver_.displacements());
  if (now.n_inverted > 0) {
    throw RefusedStep(now.message(step.step, step.time) +
                      "\n  the body is left as it was before that step");
  }
  note(step, now.J);
}

void CellWatch::at_output(const Output& output) {
  note(output.step, cells_.now().J);
}

void CellWatch::note(const StepReport& step, double J) {
  if (step.time > time_) {
    const double speed = (J_ - J) / (step.time - time_);  // towards zero
    next_ = speed > 0 ? step.time + of_time * J / speed : std::numeric_limits<double>::max();
  }
  step_ = step.step;
  time_ = step.time;
  J_ = J;
  nodal_J_ = step.least_J;
}

void CellWatch::archive(algebra::Archive& archive) {
  archive.integer("cell watch/step", step_);
  archive.real("cell watch/time", "s", time_);
  archive.real("cell watch/J", "-", J_);
  archive.real("cell watch/nodal J", "-", nodal_J_);
  archive.real("cell watch/next", "s", next_);
}

}  // namespace diptych::run
