#include "common/run/simulation.hpp"

#include <algorithm>
#include <chrono>
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
      interrupted_(std::move(interrupted)) {}

Ending Simulation::run() {
  Ending ending = Ending::breakdown;
  try {
    ending = advance();
  } catch (const base::BreakdownError& error) {
    breakdown_ = error;
    keep_last_state();
  }
  for (Observer* observer : observers_)
    observer->end(ending);
  return ending;
}

Ending Simulation::advance() {
  for (Observer* observer : observers_)
    observer->begin();
  output();
  totals_.dt_min = totals_.least_J = 1e300;
  const int n = setup_.output.frames;
  const double end = setup_.time.end;
  for (int frame = 1; frame <= n; ++frame) {
    advance_to(frame == n ? end : end * frame / n);
    output();
    if (is_at_step_limit() && solver_.time() < end) return Ending::step_limit;
    if (is_interrupted()) return Ending::interrupted;
  }
  return Ending::done;
}

void Simulation::advance_to(double limit) {
  using Clock = std::chrono::steady_clock;
  while (solver_.time() < limit && !is_interrupted()) {
    const auto start = Clock::now();
    totals_.begun = totals_.steps + 1;
    last_ = solver_.step(limit);
    totals_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    totals_.steps = last_.step;
    totals_.dt_min = std::min(totals_.dt_min, last_.dt);
    totals_.dt_max = std::max(totals_.dt_max, last_.dt);
    totals_.least_J = std::min(totals_.least_J, last_.least_J);
    totals_.rejected += last_.rejected;
    for (Observer* observer : observers_)
      observer->after_step(last_);
    if (is_at_step_limit()) break;
    if (last_.step >= judged_ + check_period && solver_.time() < limit) check();
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
  state_ = solver_.snapshot();  // also where an observer ends the run with this output
  const Output output{n_outputs_++, last_, balance, solver_.audit(), state_};
  for (Observer* observer : observers_)
    observer->at_output(output);
}

void Simulation::keep_last_state() {
  if (!solver_.is_sound() || solver_.time() == state_.time) return;  // the last output has it
  const scheme::Balance balance = solver_.balance();
  state_ = solver_.snapshot();
  const Output output{n_outputs_++, last_, balance, solver_.audit(), state_};
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
