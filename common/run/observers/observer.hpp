#pragma once
/// What is taken down of a simulation while it goes on: each observer is one file beside this one
/// (or in benchmarks/run, where it needs the report or the terminal) and is told of every step and
/// of every output time. Test: tests/common/run/simulation_test.cpp

#include "common/algebra/archive.hpp"
#include "common/base/error.hpp"
#include "common/run/output_state.hpp"

#include <cstdint>

namespace diptych::run {

/// How a simulation ended.
enum class Ending { done, interrupted, step_limit, breakdown };

/// The body at an output time; what observers share of it is worked out once.
struct Output {
  std::int64_t number;     ///< from 0, that of t = 0
  const StepReport& step;  ///< the last one, number 0 at t = 0
  const scheme::Balance& balance;
  const scheme::Audit& audit;
  OutputState& state;
};

/// What guards judge between output times.
struct Check {
  const StepReport& step;
  const scheme::Balance& balance;
  const scheme::Audit& audit;
};

/// Thrown by after_step(): a breakdown, of which the last good state is that before the step. It is
/// put back to it, where it can be.
class RefusedStep : public base::BreakdownError {
 public:
  using BreakdownError::BreakdownError;
};

/// What an observer throws ends the simulation, a base::BreakdownError as a breakdown.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// The body is at t = 0; its output comes next.
  virtual void begin() {}
  /// In the place of begin(): the body is where a checkpoint has it, and archive() has been called.
  virtual void resume() {}
  virtual void after_step(const StepReport& step) { (void)step; }
  /// After every Simulation::check_period steps without an output.
  virtual void at_check(const Check& check) { (void)check; }
  /// At t = 0, at the instants of [output], and where the simulation ends before its time, but for
  /// a breakdown.
  virtual void at_output(const Output& output) { (void)output; }
  /// A step or a check has broken down since the last output: the last good state, that before the
  /// step or that of the check. Not judged any more.
  virtual void at_breakdown(const Output& output) { (void)output; }
  /// Nothing more will come. Not told where an error other than a breakdown ends the simulation.
  virtual void end(Ending ending) { (void)ending; }
  /// Keeps what it has taken down so far in the archive, or takes it from there, so that it goes on
  /// as if there had been no end.
  virtual void archive(algebra::Archive& archive) { (void)archive; }
};

}  // namespace diptych::run
