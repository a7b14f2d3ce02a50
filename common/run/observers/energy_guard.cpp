#include "common/run/observers/energy_guard.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

namespace {

std::string instant_of(const StepReport& step) {
  return fmt::format("step {}, time {:.6g} s, dt {:.4g} s", step.step, step.time, step.dt);
}

}  // namespace

void EnergyGuard::refuse_gain(const Check& check, double gained) const {
  throw base::BreakdownError(fmt::format(
      "numerical dissipation has given the body {:.3g} of the largest energy so far, bound {:g}, "
      "{}\n"
      "  what is left of linear reconstructions has the wrong sign here: use "
      "scheme.reconstruction = \"symmetric\" or scheme.limiter = \"sign-preserving\"; "
      "guards.energy_residual raises the bound",
      gained / energy_.scale(), threshold_, instant_of(check.step)));
}

void EnergyGuard::refuse_loss(const Check& check) const {
  const double numerical = check.audit.numerical_dissipation, caught = check.audit.contact_loss;
  const double scale = scale_of_loss();
  const std::string who = caught <= 0.1 * numerical
                              ? "numerical dissipation has taken"
                              : fmt::format(
                                    "numerical dissipation ({:.3g}) and walls at the catch of "
                                    "nodes ({:.3g}) have taken",
                                    numerical / scale, caught / scale);
  throw base::BreakdownError(fmt::format(
      "{} {:.3g} of the largest energy so far, bound {:g}, {}\n"
      "  the mesh does not resolve the motion: use a finer one (--level); a limiter "
      "(scheme.limiter) says that shocks dissipate; guards.numerical_dissipation sets the bound",
      who, (numerical + caught) / scale, loss_.largest, instant_of(check.step)));
}

void EnergyGuard::refuse_residual(const Check& check, double residual, double bound) const {
  throw base::BreakdownError(fmt::format(
      "the energy budget does not close: residual {:.3g} of the largest energy so far, bound {:g}, "
      "{}\n"
      "  {}; guards.energy_residual raises the bound",
      residual, bound, instant_of(check.step),
      residual < 0
          ? "the step takes energy from short waves and fronts, or sets off with a jolt: try a "
            "smaller "
            "time.cfl, a finer mesh, or, with SSP-RK, time.integrator = \"leapfrog\""
          : "the step is too large, or the scheme is unstable here: try a smaller time.cfl "
            "or a finer mesh"));
}

void EnergyGuard::note_growth(double scale, std::int64_t step) {
  if (doubled_ <= 0) doubled_ = scale;
  for (; doubled_ > 0 && scale >= 2 * doubled_; doubled_ *= 2) {
    doubled_at_.push_back(step);
    if (doubled_at_.size() > n_doublings) doubled_at_.erase(doubled_at_.begin());
  }
}

double EnergyGuard::bound_at(std::int64_t step) const {
  double bound = threshold_;
  const std::int64_t n = step - at_rest_until_;
  if (n < steps_of_start) bound = std::max(bound, bound_of_start(n));
  if (doubled_at_.size() < n_doublings) return bound;
  const std::int64_t n_grown = step - doubled_at_.front();
  if (n_grown < steps_of_start)
    bound = std::max(bound, std::min(most_of_growth, bound_of_start(n_grown)));
  return bound;
}

/// Where strain energy is what rounding leaves of it, what motion has of energy still has its
/// digits; a body that is strained to begin with has more, which may turn into motion between two
/// looks.
double EnergyGuard::scale_of_loss() const {
  return energy_.scale() > energy_.rounding() ? energy_.scale()
                                              : std::max(energy_.motion(), energy_.initial());
}

void EnergyGuard::judge_loss(const Check& check) {
  const double scale = scale_of_loss();
  is_still_ = scale <= noise * energy_.rounding();
  if (is_still_) still_until_ = check.step.step;
  const bool sets_off = check.step.time < loss_.from && check.step.step < loss_.from_step;
  if (sets_off || check.step.step - still_until_ < steps_of_any_loss) return;
  const double lost = check.audit.numerical_dissipation + check.audit.contact_loss;
  if (lost > loss_.largest * scale) refuse_loss(check);
}

void EnergyGuard::after_step(const StepReport& step) {
  constexpr double rounding = 1e-12;
  const bool has_moved = !(std::abs(step.least_J - 1) <= rounding);
  is_at_rest_ = is_at_rest_ && !has_moved;
  is_still_ = is_still_ && !has_moved;
  if (is_at_rest_) at_rest_until_ = step.step;
  if (is_still_) still_until_ = step.step;
}

void EnergyGuard::at_check(const Check& check) {
  const io::EnergySummary energy = energy_.at(check.balance, check.audit);
  const double residual = energy.relative_residual;
  const double held = std::max(energy_.held(), energy_.work()), rounding = energy_.rounding();
  const double dissipated = energy.numerical_dissipation, scale = energy_.scale();
  if (-dissipated > threshold_ * scale + rounding) refuse_gain(check, -dissipated);
  if (!std::isfinite(residual)) refuse_residual(check, residual, threshold_);
  // what moves no J may have begun at any step since the last check, and a first step of SSP-RK2
  // has its energy without work
  const bool has_sheared =
      is_at_rest_ && held > rounding && check.step.step - checked_at_ > steps_of_start;
  checked_at_ = check.step.step;
  is_at_rest_ = held <= rounding;
  if (is_at_rest_) at_rest_until_ = check.step.step;
  note_growth(scale, check.step.step);
  const double bound_here = bound_at(check.step.step);
  const double bound =
      has_sheared ? std::max(threshold_, std::min(most_of_growth, bound_here)) : bound_here;
  // first what an unstable step does, which dissipates, too
  const double most = most_of_swing * threshold_ * scale;
  const double swing = residual > 0 ? std::clamp(check.balance.swing, 0.0, most)
                                    : std::clamp(check.balance.swing, -most, 0.0);
  if (std::abs(residual) * scale - std::abs(swing) > bound * scale + rounding)
    refuse_residual(check, residual - swing / scale, bound);
  judge_loss(check);
}

}  // namespace diptych::run
