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
  }
  for (Observer* observer : observers_)
    observer->end(ending);
  return ending;
}

Ending Simulation::advance() {
  for (Observer* observer : observers_)
    observer->begin();
  StepReport last;
  output(last);
  totals_.dt_min = totals_.least_J = 1e300;
  const int n = setup_.output.frames;
  const double end = setup_.time.end;
  for (int frame = 1; frame <= n; ++frame) {
    last = advance_to(frame == n ? end : end * frame / n, last);
    output(last);
    if (is_at_step_limit() && solver_.time() < end) return Ending::step_limit;
    if (is_interrupted()) return Ending::interrupted;
  }
  return Ending::done;
}

StepReport Simulation::advance_to(double limit, StepReport last) {
  using Clock = std::chrono::steady_clock;
  while (solver_.time() < limit && !is_interrupted()) {
    const auto start = Clock::now();
    totals_.begun = totals_.steps + 1;
    last = solver_.step(limit);
    totals_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    totals_.steps = last.step;
    totals_.dt_min = std::min(totals_.dt_min, last.dt);
    totals_.dt_max = std::max(totals_.dt_max, last.dt);
    totals_.least_J = std::min(totals_.least_J, last.least_J);
    for (Observer* observer : observers_)
      observer->after_step(last);
    if (is_at_step_limit()) break;
  }
  return last;
}

void Simulation::output(const StepReport& step) {
  const scheme::Balance balance = solver_.balance();
  state_ = solver_.snapshot();  // also where an observer ends the run with this output
  const Output output{n_outputs_++, step, balance, solver_.audit(), state_};
  for (Observer* observer : observers_)
    observer->at_output(output);
}

bool Simulation::is_at_step_limit() const {
  return setup_.time.max_steps > 0 && totals_.steps >= setup_.time.max_steps;
}

}  // namespace diptych::run
