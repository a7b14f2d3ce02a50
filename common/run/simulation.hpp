#pragma once
/// A case in motion from t = 0, or from a checkpoint, to its end, or to what ends it before: steps
/// from one output time to the next, and observers that are told of each. Test:
/// tests/common/run/simulation_test.cpp

#include "common/base/error.hpp"
#include "common/run/observers/observer.hpp"
#include "common/run/step_ends.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace diptych::run {

/// What the steps came to.
struct StepTotals {
  std::int64_t steps = 0;
  std::int64_t begun = 0;  ///< one more than `steps` where the last one broke down
  double dt_min = 0,
         dt_max = 0;          ///< s; dt_min is 1e300 between the first output and the first step
  double least_J = 1;         ///< at the nodes; the same
  std::int64_t rejected = 0;  ///< attempts at steps that were made again, smaller
  double seconds = 0;         ///< of the clock in the solver's steps, without the observers
};

/// "done", "interrupted", "step limit", "breakdown": RunSummary::status
const char* status_of(Ending ending);

/// When a simulation is kept, so that it can go on after its program has ended.
struct Checkpointing {
  std::int64_t every = 0;       ///< steps; 0: not by steps
  double seconds = 0;           ///< of the clock; 0: not by the clock
  double interval = 0;          ///< s, of the scene; 0: not by its time
  std::function<bool()> asked;  ///< whether one is asked for now; may be empty
  std::function<void()> write;  ///< keeps the simulation as it stands; empty: never
  bool is_regular() const { return every > 0 || seconds > 0 || interval > 0; }
};

class Simulation {
 public:
  /// @param setup, solver  kept by reference; the solver is at t = 0
  /// @param observers      not owned, told in this order
  /// @param interrupted    asked before each step whether to end there; may be empty
  Simulation(const cases::Case& setup,
             Solver& solver,
             std::vector<Observer*> observers,
             std::function<bool()> interrupted = {});

  /// To the end. A breakdown is an ending, see breakdown(); other errors of the solver and of
  /// observers are thrown on, and what follows here tells of the steps until then.
  Ending run();

  /// From now on it is kept: when that is due, after a step or, at an instant of output, after that
  /// output; where it is interrupted; and where it ends, if it was to be kept now and then.
  void keep(Checkpointing checkpoints) { checkpoints_ = std::move(checkpoints); }
  /// Keeps all that the simulation needs to go on in the archive, with solver and observers, or
  /// takes it from there: run() then goes on from that step, as if it had never ended. The end and
  /// the number of instants of output may be others than they were.
  /// @throws base::InputError where it is loading what does not fit
  void archive(algebra::Archive& archive);

  /// Steps between what guards judge: an energy that grows is found within a hundred, and the
  /// energies of a body cost 0.3 of a step of leapfrog at most, 0.6 % (diptych cost).
  static constexpr std::int64_t check_period = 50;

  /// Of the setting: instants of output until now, and the next one where the state stands between
  /// two: what steps until now were cut for, unless they were of another setting.  [s]
  std::vector<double> instants_of_steps() const;
  /// The instant that the last step was cut for.  [s]
  double instant_ahead() const { return ahead_; }

  const StepTotals& totals() const { return totals_; }
  const std::optional<base::BreakdownError>& breakdown() const { return breakdown_; }
  /// Fields of the last output, or of the last good state where a step has broken down; none where
  /// the body is no longer sound and is not put back to it (time.max_retries = 0).
  Snapshot take_state();

 private:
  Ending advance();
  void begin();
  double instant(int frame) const;
  void checkpoint_where_due();
  void checkpoint_at_the_end();
  void checkpoint();
  void advance_to(double limit);
  double end_of_step(double limit);
  void output();
  void check();
  void take_back();
  void keep_last_state();
  bool is_interrupted() const { return interrupted_ && interrupted_(); }
  bool is_at_step_limit() const;

  using Clock = std::chrono::steady_clock;

  const cases::Case& setup_;
  Solver& solver_;
  std::vector<Observer*> observers_;
  std::function<bool()> interrupted_;
  StepTotals totals_;
  StepReport last_;
  StepTotals totals_before_;  ///< the last step; its report, too
  StepReport before_;
  std::vector<StepEnd> step_ends_;
  size_t next_end_ = 0;      // of step_ends_: those before it have been passed
  std::int64_t judged_ = 0;  // step
  double ahead_ = 0;         // s, instant that steps are cut for
  std::int64_t n_outputs_ = 0;
  double output_time_ = 0;  // s, of the last output
  Snapshot state_;  ///< of the last output, as far as taken; gone once the body has moved on
  std::optional<base::BreakdownError> breakdown_;
  Checkpointing checkpoints_;
  std::int64_t kept_ = -1;  // step
  double kept_time_ = 0;    // s
  Clock::time_point kept_at_ = Clock::now();
  bool goes_on_ = false;  // from a checkpoint
};

}  // namespace diptych::run
