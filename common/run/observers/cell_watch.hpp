#pragma once
/// Looks at the cells between the outputs, the more often the sooner one of them would come to
/// nothing, and has the step that turns one inside out taken back: the run ends with a body that is
/// whole. Test: tests/common/run/cell_watch_test.cpp

#include "common/run/observers/cells.hpp"

#include <functional>
#include <limits>

namespace diptych::run {

/// The least cell, and in how many steps one would have no volume left at the speed of the next.
struct CellOutlook {
  LeastCell now;
  double steps_left = 0;  ///< infinite where no cell gets smaller
};

class CellWatch : public Observer {
 public:
  /// Of the body as it stands, with steps of this size  [s].
  using Look = std::function<CellOutlook(double dt)>;
  /// Those that take down steps are told of them after this one.
  explicit CellWatch(Look look) : look_(std::move(look)) {}

  /// @throws RefusedStep
  void after_step(const StepReport& step) override;
  void archive(algebra::Archive& archive) override;
  /// At the end of this step; null where it did not look then.
  const LeastCell* seen(std::int64_t step) const { return step == seen_step_ ? &seen_ : nullptr; }

  /// Steps between looks at most: one costs 0.6 of the cheapest step.
  static constexpr std::int64_t period = 48;
  /// The next look is due when this part of the time has passed that the first cell has left, for
  /// it may become faster; at an output; or when the least J of nodes, which is known of every
  /// step, has fallen by this part of that of the least cell.
  static constexpr double of_time = 0.25, of_J = 0.1;

 private:
  Look look_;
  std::int64_t next_step_ = 1;
  double next_time_ = std::numeric_limits<double>::max();  // s
  std::int64_t seen_step_ = -1;
  LeastCell seen_;
  // of the last look
  double J_ = 1, nodal_J_ = 1;
};

}  // namespace diptych::run
