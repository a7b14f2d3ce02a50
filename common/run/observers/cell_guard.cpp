#include "common/run/observers/cell_guard.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>

namespace diptych::run {

void CellGuard::at_output(const Output& output) {
  const LeastCell& now = cells_.now();
  if (now.n_inverted == 0) return;
  const algebra::Vec3& X = now.centre;
  throw base::BreakdownError(fmt::format(
      "{} of {} cells are inside out, step {}, time {:.6g} s\n"
      "  the worst (deformed over undeformed volume {:.3g}) had its centre at X = ({:.6g}, {:.6g}, "
      "{:.6g}) m\n"
      "  the body has passed through itself between nodes: refine, load more slowly, or use the "
      "sign-preserving limiter; guards.inverted_cells = \"warn\" lets the run go on",
      now.n_inverted, now.n_cells, output.step.step, output.state.time, now.J, X[0], X[1], X[2]));
}

}  // namespace diptych::run
