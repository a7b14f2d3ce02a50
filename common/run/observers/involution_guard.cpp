#include "common/run/observers/involution_guard.hpp"

#include "common/base/error.hpp"
#include "common/physics/deformation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

namespace {

/// The node whose H or J is farthest from its F.
std::int64_t worst_node(const Snapshot& s) {
  std::int64_t worst = 0;
  double most = -1;
  for (size_t a = 0; a < s.F.size(); ++a) {
    const auto exact = physics::deformation_of(algebra::to_tensor(s.F[a]));
    const double drift = std::max((s.H[a] - algebra::to_eigen(exact.H)).cwiseAbs().maxCoeff(),
                                  std::abs(s.J[a] - exact.J));
    if (drift <= most) continue;  // of what is no number the first
    worst = static_cast<std::int64_t>(a);
    if (std::isnan(drift)) break;
    most = drift;
  }
  return worst;
}

}  // namespace

void InvolutionGuard::at_check(const Check& check) {
  const double H = check.balance.involution_H, J = check.balance.involution_J;
  if (H <= threshold_ && J <= threshold_) return;
  const std::int64_t node = worst_node(solver_.snapshot());
  const std::string message = fmt::format(
      "H and J have left F at node {}: |H - cof F| up to {:.3g}, |J - det F| up to {:.3g}, bound "
      "{:g}, step {}, time {:.6g} s, dt {:.4g} s\n"
      "  the time step errs too much in strain: try a smaller time.cfl, with SSP-RK "
      "time.integrator = \"leapfrog\", whose H and J are exact, or scheme.unknowns = \"F\"; "
      "guards.involution raises "
      "the bound",
      node, H, J, threshold_, check.step.step, check.step.time, check.step.dt);
  throw base::BreakdownError(message, node);
}

}  // namespace diptych::run
