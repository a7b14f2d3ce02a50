#include "common/run/simulation.hpp"

#include "common/scheme/boundary/boundary_condition.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace diptych::run {

const char* status_of(Ending ending) {
  switch (ending) {
    case Ending::interrupted:
      return "interrupted";
    case Ending::step_limit:
      return "step limit";
    case Ending::breakdown:
      return "breakdown";
    case Ending::done:
      break;
  }
  return "done";
}

Simulation::Simulation(const cases::Case& setup,
                       Solver& solver,
                       std::vector<Observer*> observers,
                       std::function<bool()> interrupted)
    : setup_(setup),
      solver_(solver),
      observers_(std::move(observers)),
      interrupted_(std::move(interrupted)),
      step_ends_(step_ends(setup, solver.undeformed_step(), solver.telling_places())) {}

Ending Simulation::run() {
  Ending ending = Ending::breakdown;
  try {
    ending = advance();
  } catch (const RefusedStep& error) {
    breakdown_ = error;
    take_back();
    keep_last_state();
  } catch (const base::BreakdownError& error) {
    breakdown_ = error;
    keep_last_state();
  }
  for (Observer* observer : observers_)
    observer->end(ending);
  return ending;
}

void Simulation::begin() {
  if (goes_on_) {
    for (Observer* observer : observers_)
      observer->resume();
    return;
  }
  for (Observer* observer : observers_)
    observer->begin();
  output();
  totals_.dt_min = totals_.least_J = 1e300;
}

/// Of output.
double Simulation::instant(int frame) const {
  const int n = setup_.output.frames;
  return frame == n ? setup_.time.end : setup_.time.end * frame / n;
}

std::vector<double> Simulation::instants_of_steps() const {
  std::vector<double> instants;
  const bool is_between = ahead_ > solver_.time();
  for (int frame = 0; frame <= setup_.output.frames; ++frame) {
    const bool is_past = instant(frame) <= solver_.time();
    if (is_past || is_between) instants.push_back(instant(frame));
    if (!is_past) break;
  }
  return instants;
}

Ending Simulation::advance() {
  begin();
  for (int frame = 1; frame <= setup_.output.frames; ++frame) {
    if (goes_on_ && instant(frame) <= solver_.time()) continue;  // of before the checkpoint
    advance_to(instant(frame));
    const bool ends_early = solver_.time() < instant(frame);
    // a run that goes on from here has no output here
    if (ends_early) checkpoint_at_the_end();
    if (solver_.time() != output_time_) output();
    const bool is_limited = is_at_step_limit() && solver_.time() < setup_.time.end;
    if (is_limited || is_interrupted()) {
      if (!ends_early) checkpoint_at_the_end();
      return is_limited ? Ending::step_limit : Ending::interrupted;
    }
    checkpoint_where_due();
  }
  checkpoint_at_the_end();
  return Ending::done;
}

void Simulation::checkpoint_where_due() {
  if (!checkpoints_.write) return;
  const std::int64_t every = checkpoints_.every;
  const bool is_due =
      (every > 0 && totals_.steps % every == 0) ||
      (checkpoints_.seconds > 0 &&
       std::chrono::duration<double>(Clock::now() - kept_at_).count() >= checkpoints_.seconds) ||
      (checkpoints_.interval > 0 && std::floor(solver_.time() / checkpoints_.interval) >
                                        std::floor(kept_time_ / checkpoints_.interval)) ||
      (checkpoints_.asked && checkpoints_.asked());
  if (is_due) checkpoint();
}

void Simulation::checkpoint_at_the_end() {
  if (checkpoints_.write && (checkpoints_.is_regular() || is_interrupted())) checkpoint();
}

void Simulation::checkpoint() {
  if (kept_ == totals_.steps) return;  // as it stands
  checkpoints_.write();
  kept_ = totals_.steps;
  kept_time_ = solver_.time();
  kept_at_ = Clock::now();
}

void Simulation::archive(algebra::Archive& archive) {
  archive.integer("run/steps", totals_.steps);
  archive.integer("run/steps begun", totals_.begun);
  archive.real("run/least dt", "s", totals_.dt_min);
  archive.real("run/largest dt", "s", totals_.dt_max);
  archive.real("run/least J", "-", totals_.least_J);
  archive.integer("run/rejected", totals_.rejected);
  archive.real("run/seconds in steps", "s", totals_.seconds);
  archive.integer("last step/number", last_.step);
  archive.real("last step/time", "s", last_.time);
  archive.real("last step/dt", "s", last_.dt);
  archive.real("last step/least J", "-", last_.least_J);
  archive.integer("last step/rejected", last_.rejected);
  archive.integer("run/judged step", judged_);
  archive.real("run/instant ahead", "s", ahead_);
  archive.integer("run/outputs", n_outputs_);
  archive.real("run/time of last output", "s", output_time_);
  solver_.archive(archive);
  for (Observer* observer : observers_)
    observer->archive(archive);
  if (!archive.is_loading()) return;
  if (solver_.time() > setup_.time.end) {
    throw base::InputError(
        fmt::format("time.end = {:g} s is before the state to go on from, which "
                    "is of t = {:g} s; give a later end",
                    setup_.time.end, solver_.time()));
  }
  goes_on_ = true;
  kept_ = totals_.steps;
  kept_time_ = solver_.time();
}

/// Passes a jump that the body stands before.
/// @return the instant before the next end of a step, no later than the limit
double Simulation::end_of_step(double limit) {
  for (; next_end_ < step_ends_.size(); ++next_end_) {
    const StepEnd& next = step_ends_[next_end_];
    if (next.after <= solver_.time()) continue;
    if (solver_.time() < next.before) return std::min(limit, next.before);
    if (solver_.time() >= limit) return limit;
    solver_.pass(next.after);
  }
  return limit;
}

void Simulation::advance_to(double limit) {
  ahead_ = limit;
  while (solver_.time() < limit && !is_interrupted() && !is_at_step_limit()) {
    const auto start = Clock::now();
    totals_before_ = totals_;
    before_ = last_;
    const double end = end_of_step(limit);
    if (!(solver_.time() < end)) break;
    totals_.begun = totals_.steps + 1;
    last_ = solver_.step(end);
    totals_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    totals_.steps = last_.step;
    totals_.dt_min = std::min(totals_.dt_min, last_.dt);
    totals_.dt_max = std::max(totals_.dt_max, last_.dt);
    totals_.least_J = std::min(totals_.least_J, last_.least_J);
    totals_.rejected += last_.rejected;
    for (Observer* observer : observers_)
      observer->after_step(last_);
    (void)end_of_step(limit);  // before an output that stands behind a jump
    if (last_.step >= judged_ + check_period && solver_.time() < limit) check();
    if (is_at_step_limit()) break;  // whoever goes on from here finds the guards as they would be
    if (solver_.time() < limit) checkpoint_where_due();
  }
}

void Simulation::check() {
  judged_ = last_.step;
  const scheme::Balance balance = solver_.balance();
  for (Observer* observer : observers_)
    observer->at_check({last_, balance, solver_.audit()});
}

void Simulation::output() {
  judged_ = last_.step;
  const scheme::Balance balance = solver_.balance();
  output_time_ = solver_.time();
  OutputState state(solver_, state_);
  const Output output{n_outputs_++, last_, balance, solver_.audit(), state};
  for (Observer* observer : observers_)
    observer->at_output(output);
  if (output_time_ < setup_.time.end) state_ = {};  // as much memory as a quarter of the body's
}

Snapshot Simulation::take_state() {
  if (state_.u.empty() && solver_.is_sound()) solver_.take_snapshot(state_);
  return std::move(state_);
}

/// The last step, as if it had broken down.
void Simulation::take_back() {
  if (!solver_.take_back()) return;
  breakdown_ = base::BreakdownError(
      std::string(breakdown_->what()) + "\n  the body is left as it was before that step",
      breakdown_->node().value_or(0));
  const std::int64_t begun = totals_.begun;
  totals_ = totals_before_;
  totals_.begun = begun;
  last_ = before_;
}

void Simulation::keep_last_state() {
  if (!solver_.is_sound() || solver_.time() == output_time_) return;  // the last output has it
  const scheme::Balance balance = solver_.balance();
  output_time_ = solver_.time();
  state_ = {};
  OutputState state(solver_, state_);
  const Output output{n_outputs_++, last_, balance, solver_.audit(), state};
  try {
    for (Observer* observer : observers_)
      observer->at_breakdown(output);
  } catch (const base::BreakdownError&) {
    // a field that is not finite has no frame; the first breakdown is the one to tell
  }
}

bool Simulation::is_at_step_limit() const {
  return setup_.time.max_steps > 0 && totals_.steps >= setup_.time.max_steps;
}

}  // namespace diptych::run
