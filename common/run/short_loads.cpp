#include "common/run/short_loads.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych::run {

namespace {

using functions::Expression;
using Places = std::span<const algebra::Vec3>;

constexpr double steps_of_long_load = 50;
/// Runge-Kutta steps of the largest stable size take energy from the shortest waves that a short
/// load has made, with the fourth power of their size, until numerical dissipation has it.
constexpr double steps_of_waves = 100, least_share_of_waves = 0.25;

Places places_of(const Expression& action, Places places) {
  static const algebra::Vec3 origin = algebra::Vec3::Zero();
  return action.depends_on_position() ? places : Places(&origin, 1);
}

/// NaN where it has no value, of which a run that gets there tells.
double value_of(const Expression& action, const algebra::Vec3& X, double t) {
  try {
    return action(X, t);
  } catch (const base::Error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// How much an action changes between two instants, and the most that it is at them: at the place
/// where that is most.
struct Change {
  double jump = 0, size = 0;
};

Change change_of(const Expression& action, Places places, double before, double after) {
  Change most;
  for (const algebra::Vec3& X : places_of(action, places)) {
    const double a = value_of(action, X, before), b = value_of(action, X, after);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    most.jump = std::max(most.jump, std::abs(b - a));
    most.size = std::max({most.size, std::abs(a), std::abs(b)});
  }
  return most;
}

constexpr double worth_following = 1e-3;  // of the largest value

/// Where an action sets in, stops or changes at once.
struct Jump {
  double before = 0, after = 0;  ///< s
  double change = 0;             ///< 0: none that is worth following
};

/// The first is t = 0, the last the end of the run.
std::vector<Jump> jumps_of(const Expression& action,
                           Places places,
                           const std::vector<StepEnd>& ends,
                           double end) {
  std::vector<Jump> all{{0, 0, change_of(action, places, 0, 0).size}};
  double largest = all.front().change;
  for (const StepEnd& at : ends) {
    const Change change = change_of(action, places, at.before, at.after);
    largest = std::max(largest, change.size);
    if (at.is_jump) all.push_back({at.before, at.after, change.jump});
  }
  std::vector<Jump> jumps;
  for (Jump jump : all) {
    if (jump.change <= worth_following * largest) jump.change = 0;
    if (jump.change > 0 || jump.after == 0) jumps.push_back(jump);
  }
  jumps.push_back({end, end, 0});
  return jumps;
}

/// Steps between two instants are no longer than this  [s].
struct ShortSteps {
  double begin = 0, end = 0, step = 0;
};

/// What an action does beside a jump.
class Beside {
 public:
  /// @param along  away from the jump, and as far as is looked  [s], of either sign
  Beside(const Expression& action, Places places, double jump, double along)
      : jump_(jump), along_(along) {
    constexpr int n_octaves = 20, n_parts = 8;  // towards the jump, of each
    const double length = std::abs(along);
    for (int octave = n_octaves; octave >= 0; --octave) {
      const double last = std::ldexp(length, -octave), first = octave == n_octaves ? 0 : last / 2;
      const double width = (last - first) / n_parts;
      for (int i = 0; i < n_parts; ++i) {
        const double t = jump + std::copysign(first + (i + 0.5) * width, along);
        double square = 0;
        for (const algebra::Vec3& X : places_of(action, places)) {
          const double value = value_of(action, X, t);
          if (!std::isfinite(value)) continue;
          largest_ = std::max(largest_, std::abs(value));
          square += value * value;
        }
        largest_square_ = std::max(largest_square_, square);
        parts_.push_back({width, width * square});
        done_ += width * square;
      }
    }
  }
  double largest() const { return largest_; }
  /// No step is longer while it acts  [s]
  double longest_step(double dt) const {
    constexpr double steps_of_change = 8, constant = 0.9;
    if (!(largest_square_ > 0)) return 0;
    const double duration = done_ / largest_square_;
    const double step = std::sqrt(duration * dt / steps_of_long_load);
    return duration > constant * reach() ? step : std::min(step, duration / steps_of_change);
  }
  /// At the end of what is looked at it is next to as large as ever.
  bool goes_on() const {
    constexpr double faded = 0.1;
    const Part &one = parts_[parts_.size() - 2], &last = parts_.back();
    return one.done + last.done > faded * largest_square_ * (one.width + last.width);
  }
  /// From the jump to where all but next to nothing is done.
  ShortSteps short_steps(double step) const {
    const bool is_all = reach() >= std::abs(along_) * (1 - 1e-9);
    const double other = jump_ + (is_all ? along_ : std::copysign(reach(), along_));
    return {std::min(jump_, other), std::max(jump_, other), step};
  }

 private:
  struct Part {
    double width = 0, done = 0;
  };
  double jump_, along_;
  double largest_ = 0, largest_square_ = 0, done_ = 0;
  std::vector<Part> parts_;  ///< from the jump on

  double reach() const {
    constexpr double next_to_nothing = 1e-3;
    double left = next_to_nothing * done_, reach = std::abs(along_);
    for (size_t k = parts_.size(); k-- > 0 && left >= parts_[k].done;) {
      left -= parts_[k].done;
      reach -= parts_[k].width;
    }
    return reach;
  }
};

class Following {
 public:
  Following(double dt, double end, bool is_leapfrog)
      : dt_(dt), end_(end), is_leapfrog_(is_leapfrog) {}

  void add(const Expression& action, Places places, const std::vector<StepEnd>& ends) {
    if (!action.depends_on_time() || action.joins_place_and_time()) return;
    const std::vector<Jump> jumps = jumps_of(action, places, ends, end_);
    for (size_t j = 1; j < jumps.size(); ++j) {
      // what acts for longer has no short steps
      const double length =
          std::min(jumps[j].before - jumps[j - 1].after, 4 * steps_of_long_load * dt_);
      if (!(length > 0)) continue;
      add_beside(action, places, jumps[j - 1].after, length, jumps[j - 1].change);
      add_beside(action, places, jumps[j].before, -length, jumps[j].change);
    }
  }
  const std::vector<ShortSteps>& all() const { return all_; }

 private:
  double dt_, end_;
  bool is_leapfrog_;
  std::vector<ShortSteps> all_;

  void add_beside(
      const Expression& action, Places places, double jump, double along, double change) {
    if (change == 0) return;
    const Beside beside(action, places, jump, along);
    // what never stops does not act for few steps
    if (jump + along >= end_ * (1 - 1e-12) && beside.goes_on()) return;
    const double step = beside.longest_step(dt_);
    if (change <= worth_following * beside.largest() || !(step > 0 && step < dt_)) return;
    const ShortSteps acts = beside.short_steps(step);
    all_.push_back(acts);
    if (is_leapfrog_) return;
    all_.push_back({acts.begin, std::min(end_, acts.end + steps_of_waves * dt_),
                    std::max(step, least_share_of_waves * dt_)});
  }
};

/// Adds what short steps ask for between two ends of steps, the last of which is there.
void add_between(double begin,
                 double end,
                 double dt,
                 const std::vector<ShortSteps>& all,
                 std::vector<StepEnd>& ends) {
  const auto step_at = [&](double from, double to) {
    double step = std::numeric_limits<double>::infinity();
    for (const ShortSteps& some : all)
      if (some.begin < to && some.end > from) step = std::min(step, some.step);
    return step;
  };
  std::vector<double> edges{begin, end};
  for (const ShortSteps& some : all) {
    for (const double edge : {some.begin, some.end})
      if (edge > begin + some.step / 2 && edge < end - some.step / 2) edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  for (size_t k = 1; k < edges.size(); ++k) {
    const double from = edges[k - 1], part = edges[k] - from, middle = from + part / 2;
    const double n = std::max(1.0, std::ceil(part / step_at(middle, middle) * (1 - 1e-9)));
    for (double i = 1; i <= n; ++i) {
      const double t = i < n ? from + part * i / n : edges[k];
      if (!(t > from && t < end)) continue;
      // a step is judged as those of a start, where steps may be long again
      const bool is_last = i == n && step_at(middle, middle) < dt;
      ends.push_back({t, is_last ? std::nextafter(t, end) : t});
    }
  }
}

}  // namespace

void add_ends_of_short_loads(std::vector<StepEnd>& ends,
                             double dt,
                             double end,
                             const std::vector<Expression>& actions,
                             Places places,
                             bool is_leapfrog) {
  Following following(dt, end, is_leapfrog);
  for (const Expression& action : actions)
    following.add(action, places, ends);
  const std::vector<ShortSteps>& short_steps = following.all();
  if (short_steps.empty()) return;
  std::vector<StepEnd> all;
  double begin = 0;
  for (const StepEnd& at : ends) {
    add_between(begin, at.before, dt, short_steps, all);
    all.push_back(at);
    begin = at.after;
  }
  add_between(begin, end, dt, short_steps, all);
  ends = std::move(all);
}

}  // namespace diptych::run
