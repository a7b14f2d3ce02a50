#pragma once
/// A case in motion from t = 0 to its end, or to what ends it before: steps from one output time to
/// the next, and observers that are told of each. Test: tests/common/run/simulation_test.cpp

#include "common/base/error.hpp"
#include "common/run/observers/observer.hpp"

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
  std::int64_t rejected = 0;  ///< attempts at steps that were made again with half the size
  double seconds = 0;         ///< of the clock in the solver's steps, without the observers
};

/// "done", "interrupted", "step limit", "breakdown": RunSummary::status
const char* status_of(Ending ending);

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

  /// Steps between what guards judge: an energy that grows is found within a hundred, and the
  /// energies of a body, which cost 2/3 of a step of leapfrog at most, 1.5 % (diptych cost).
  static constexpr std::int64_t check_period = 50;

  const StepTotals& totals() const { return totals_; }
  const std::optional<base::BreakdownError>& breakdown() const { return breakdown_; }
  /// Fields of the last output, or of the last good state where a step has broken down.
  Snapshot take_state() { return std::move(state_); }

 private:
  Ending advance();
  void advance_to(double limit);
  void output();
  void check();
  void keep_last_state();
  bool is_interrupted() const { return interrupted_ && interrupted_(); }
  bool is_at_step_limit() const;

  const cases::Case& setup_;
  Solver& solver_;
  std::vector<Observer*> observers_;
  std::function<bool()> interrupted_;
  StepTotals totals_;
  StepReport last_;
  std::int64_t judged_ = 0;  // step
  std::int64_t n_outputs_ = 0;
  Snapshot state_;
  std::optional<base::BreakdownError> breakdown_;
};

}  // namespace diptych::run
