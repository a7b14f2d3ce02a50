#include "common/run/observers/cell_guard.hpp"

#include "common/base/error.hpp"

namespace diptych::run {

void CellGuard::at_output(const Output& output) {
  const LeastCell& now = cells_.now();
  if (now.n_inverted == 0) return;
  throw base::BreakdownError(now.message(output.step.step, output.state.time()), now.node);
}

}  // namespace diptych::run
