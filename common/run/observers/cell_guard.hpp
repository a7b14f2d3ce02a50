#pragma once
/// Stops a run whose cells have turned inside out by an output, unseen by cell_watch.hpp or where
/// no step can be taken back: the body has passed through itself between its nodes, and what comes
/// after is no solution. Test: tests/common/run/guards_test.cpp

#include "common/run/observers/cells.hpp"

namespace diptych::run {

class CellGuard : public Observer {
 public:
  /// @param cells  kept by reference. It and those that write the output are told of it before
  ///               this one, so that the row and the frame that show such cells are kept.
  explicit CellGuard(const Cells& cells) : cells_(cells) {}

  /// @throws base::BreakdownError
  void at_output(const Output& output) override;

 private:
  const Cells& cells_;
};

}  // namespace diptych::run
