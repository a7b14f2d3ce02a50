#pragma once
/// Looks at the cells between the outputs, more often as the least of them nears zero, and has the
/// step that turns one inside out taken back: the run ends with a body that is whole.
/// Test: tests/common/run/guards_test.cpp

#include "common/run/observers/cells.hpp"

#include <limits>

namespace diptych::run {

class CellWatch : public Observer {
 public:
  /// @param solver, cells  kept by reference. `cells` is told of an output before this one; those
  ///                       that take down steps are told of them after this one.
  CellWatch(const Solver& solver, const Cells& cells) : solver_(solver), cells_(cells) {}

  /// @throws RefusedStep
  void after_step(const StepReport& step) override;
  void at_output(const Output& output) override;
  void archive(algebra::Archive& archive) override;

  /// Steps between looks while no cell nears zero: a look costs half of the cheapest step
  /// (diptych cost).
  static constexpr std::int64_t period = 16;
  /// The next look is due when this part of the time has passed in which the least cell would come
  /// to zero as fast as it has come since the last look, since it may become faster; or when the
  /// least J of nodes, which is known of every step, has fallen by this part of that of the cell.
  static constexpr double of_time = 0.25, of_J = 0.1;

 private:
  void note(const StepReport& step, double J);

  const Solver& solver_;
  const Cells& cells_;
  // of the last look
  std::int64_t step_ = 0;
  double time_ = 0;  // s
  double J_ = 1, nodal_J_ = 1;
  double next_ = std::numeric_limits<double>::max();  // s, when to look again at the latest
};

}  // namespace diptych::run
