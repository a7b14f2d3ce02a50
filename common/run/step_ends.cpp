#include "common/run/step_ends.hpp"

#include "common/base/error.hpp"
#include "common/functions/resolving_times.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

namespace {

/// Whatever acts on the body.
std::vector<functions::Expression> actions_of(const cases::Case& setup) {
  std::vector<functions::Expression> actions(setup.body_force.component.begin(),
                                             setup.body_force.component.end());
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    actions.insert(actions.end(), boundary.value.component.begin(), boundary.value.component.end());
    actions.push_back(boundary.pressure);
  }
  return actions;
}

functions::BreakTimes breaks_of(const std::vector<functions::Expression>& actions,
                                double end,
                                double dt) {
  constexpr double most_samples = 1 << 16;
  const double n = std::min(most_samples, 4 * end / dt);
  return functions::break_times(actions, 0, end,
                                std::max(functions::samples_of_break, static_cast<int>(n)));
}

[[noreturn]] void refuse_fastest(const std::vector<functions::Expression>& actions,
                                 double end,
                                 double dt) {
  const auto is_too_fast = [&](const functions::Expression& action) {
    const std::vector one{action};
    return action.depends_on_time() &&
           functions::resolving_times(one, breaks_of(one, end, dt), 0, end, dt).are_too_many;
  };
  const auto fastest = std::find_if(actions.begin(), actions.end(), is_too_fast);
  const bool is_one = fastest != actions.end();
  throw base::InputError(fmt::format(
      "{}{} so fast that following it would take more than {:g} times as many steps as the body "
      "needs ({:.2g} s each), or a million; give what changes more slowly, such as its mean",
      is_one ? functions::prefix(fastest->where()) : "",
      is_one ? fmt::format("\"{}\" changes", fastest->text()) : "loads together change",
      functions::most_per_step, dt));
}

}  // namespace

std::vector<StepEnd> step_ends(const cases::Case& setup, double dt) {
  const double end = setup.time.end, near = 1e-13 * end;
  const auto actions = actions_of(setup);
  const functions::BreakTimes breaks = breaks_of(actions, end, dt);
  const auto resolving = functions::resolving_times(actions, breaks, 0, end, dt);
  if (resolving.are_too_many) refuse_fastest(actions, end, dt);
  std::vector<StepEnd> of_all;
  for (const double after : breaks.jumps)
    of_all.push_back({std::nextafter(after, 0), after});
  for (const double t : resolving.times)
    of_all.push_back({t, t});
  std::sort(of_all.begin(), of_all.end(),
            [](const StepEnd& a, const StepEnd& b) { return a.before < b.before; });
  std::vector<StepEnd> ends;
  for (StepEnd next : of_all) {
    const int frame = static_cast<int>(std::lround(next.after / end * setup.output.frames));
    const double output = frame == setup.output.frames ? end : end * frame / setup.output.frames;
    if (std::abs(output - next.after) <= near) {
      next.before = std::min(next.before, output);
      next.after = std::max(next.after, output);
    }
    if (ends.empty() || next.before - ends.back().after > near) {
      ends.push_back(next);
    } else {
      ends.back().after = std::max(ends.back().after, next.after);
    }
  }
  return ends;
}

}  // namespace diptych::run
