#include "common/run/step_ends.hpp"

#include "common/base/error.hpp"
#include "common/functions/resolving_times.hpp"
#include "common/run/short_loads.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

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

using Actions = std::vector<functions::Expression>;

constexpr double as_good_as_one = 1e-13;  // instants of a run, of its end

using Place = std::optional<algebra::Vec3>;

functions::BreakTimes breaks_of(const Actions& actions,
                                double end,
                                double dt,
                                const Place& place = std::nullopt) {
  const double most_samples = place ? 1 << 14 : 1 << 16;  // of one place among many
  const double n = std::min(most_samples, 4 * end / dt);
  return functions::break_times(actions, 0, end,
                                std::max(functions::samples_of_break, static_cast<int>(n)), place);
}

/// Instants at which steps end, jumps apart.
struct Instants {
  std::vector<double> jumps, others;
  bool are_too_many = false;
};

Instants seen_at(const Actions& actions, double end, double dt, const Place& place = std::nullopt) {
  functions::BreakTimes breaks = breaks_of(actions, end, dt, place);
  auto resolving = functions::resolving_times(actions, breaks, 0, end, dt, place);
  return {std::move(breaks.jumps), std::move(resolving.times), resolving.are_too_many};
}

/// Parts of what lies between two jumps that steps are to be no longer than, where the jumps come
/// at other times from node to node.
constexpr double parts_between_jumps = 6;

/// The shortest step that a place asks for  [s]
double shortest_step(const Instants& seen, double near) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::vector<double>& times, double parts) {
    for (size_t k = 1; k < times.size(); ++k) {
      const double part = times[k] - times[k - 1];
      if (part > near) shortest = std::min(shortest, part / parts);
    }
  };
  look(seen.others, 1);
  look(seen.jumps, parts_between_jumps);
  return shortest;
}

bool are_near(const std::vector<double>& a, const std::vector<double>& b, double near) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [near](double s, double t) { return std::abs(s - t) <= near; });
}

bool are_near(const Instants& a, const Instants& b, double near) {
  return are_near(a.jumps, b.jumps, near) && are_near(a.others, b.others, near);
}

/// What the places see that see something.
struct Seen {
  std::vector<Instants> kinds;          ///< that differ
  std::vector<double> jumps;            ///< of all of them
  std::vector<double> arrivals, steps;  ///< [places] s, of the first instant; see shortest_step
  bool is_too_fast = false;             ///< for most places: an action may act on few of them
};

Seen seen_at_each(std::span<const algebra::Vec3> places,
                  const Actions& actions,
                  double end,
                  double dt,
                  double near) {
  Seen result;
  size_t n_too_fast = 0;
  for (const algebra::Vec3& place : places) {
    Instants seen = seen_at(actions, end, dt, place);
    if (seen.are_too_many) ++n_too_fast;
    if (seen.jumps.empty() && seen.others.empty()) continue;
    double arrival = end;
    for (const std::vector<double>* times : {&seen.jumps, &seen.others})
      if (!times->empty()) arrival = std::min(arrival, times->front());
    result.arrivals.push_back(arrival);
    result.steps.push_back(shortest_step(seen, near));
    result.jumps.insert(result.jumps.end(), seen.jumps.begin(), seen.jumps.end());
    const auto is_known = [&](const Instants& kind) { return are_near(kind, seen, near); };
    if (std::none_of(result.kinds.begin(), result.kinds.end(), is_known))
      result.kinds.push_back(std::move(seen));
  }
  result.is_too_fast = 2 * n_too_fast > places.size();
  std::sort(result.arrivals.begin(), result.arrivals.end());
  std::sort(result.steps.begin(), result.steps.end());
  return result;
}

/// What some places see of actions that join place and time. Where places see the same in regions,
/// that is all. Where most see something of their own, as of loads that travel, steps are as short
/// throughout as the middle one of these places asks for: other nodes see it in between, and two
/// jumps that have nothing to do with each other may come close somewhere.
Instants seen_at(std::span<const algebra::Vec3> places,
                 const Actions& actions,
                 double end,
                 double dt) {
  constexpr size_t least_of_region = 3;  // places, in the mean
  const double near = 1e-3 * dt;
  const Seen seen = seen_at_each(places, actions, end, dt, near);
  Instants instants;
  instants.are_too_many = seen.is_too_fast;
  instants.jumps = seen.jumps;
  double last = 0;
  for (const Instants& kind : seen.kinds) {
    instants.others.insert(instants.others.end(), kind.others.begin(), kind.others.end());
    for (const std::vector<double>* times : {&kind.jumps, &kind.others})
      if (!times->empty()) last = std::max(last, times->back());
  }
  std::vector<double>& others = instants.others;
  std::sort(others.begin(), others.end());
  const auto same = [near](double s, double t) { return t - s <= near; };
  others.erase(std::unique(others.begin(), others.end(), same), others.end());
  const bool travels = least_of_region * seen.kinds.size() > seen.arrivals.size();
  if (seen.kinds.size() <= 1 || !travels) return instants;
  others.clear();
  const double step = seen.steps[seen.steps.size() / 2];
  if (step >= dt) return instants;
  // from the place before the first one that sees it to the one behind the last
  double between = 0;
  for (size_t k = 1; k < seen.arrivals.size(); ++k)
    between = std::max(between, seen.arrivals[k] - seen.arrivals[k - 1]);
  const double begin = std::max(0.0, seen.arrivals.front() - between);
  last = std::min(end, last + between);
  const double n = std::ceil((last - begin) / step);
  instants.are_too_many |= n > functions::most_per_step * (end / dt + 1);
  for (double k = 0; k <= n && !instants.are_too_many; ++k)
    others.push_back(begin + (last - begin) * k / n);
  return instants;
}

[[noreturn]] void refuse_fastest(const Actions& actions,
                                 std::span<const algebra::Vec3> places,
                                 double end,
                                 double dt) {
  const auto is_too_fast = [&](const functions::Expression& action) {
    if (!action.depends_on_time()) return false;
    const Instants instants = seen_at({action}, end, dt);
    if (instants.are_too_many || !action.joins_place_and_time()) return instants.are_too_many;
    return seen_at(places, {action}, end, dt).are_too_many;
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

std::vector<StepEnd> step_ends(const cases::Case& setup,
                               double dt,
                               std::span<const algebra::Vec3> places) {
  const double end = setup.time.end;
  const Actions actions = actions_of(setup);
  Actions travelling;
  for (const functions::Expression& action : actions)
    if (action.joins_place_and_time()) travelling.push_back(action);
  Instants instants;
  double near = as_good_as_one * end;
  if (!travelling.empty()) {
    instants = seen_at(places, travelling, end, dt);
    near = std::max(near, 1e-5 * dt);  // one jump that places see one shortly after the other
  }
  const Instants everywhere = seen_at(actions, end, dt);
  if (instants.are_too_many || everywhere.are_too_many) refuse_fastest(actions, places, end, dt);
  std::vector<StepEnd> of_all;
  for (const Instants* seen : {&everywhere, &std::as_const(instants)}) {
    for (const double after : seen->jumps)
      of_all.push_back({std::nextafter(after, 0), after, true});
    for (const double t : seen->others)
      of_all.push_back({t, t});
  }
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
      ends.back().is_jump |= next.is_jump;
    }
  }
  add_ends_of_short_loads(ends, dt, end, actions, places, setup.time.integrator == "leapfrog");
  return ends;
}

double start_of(const cases::Case& setup) {
  const std::vector<double> jumps =
      functions::break_times(actions_of(setup), 0, as_good_as_one * setup.time.end).jumps;
  return jumps.empty() ? 0 : jumps.back();
}

}  // namespace diptych::run
