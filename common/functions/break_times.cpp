#include "common/functions/break_times.hpp"

#include "common/functions/placed_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace diptych::functions {

namespace {

/// What an operation of time alone changes at: where its arguments are equal, its argument is zero,
/// or, of rint, where its result is another one.
struct Switch {
  int result = -1;              ///< place in the program of what jumps; -1: a kink
  int first = -1, second = -1;  ///< what is compared; second -1: with zero
};

std::vector<Switch> switches_of(const Program& program) {
  std::vector<Switch> switches;
  for (int k = 0; k < program.size(); ++k) {
    const Operation& operation = program[k];
    if (!operation.is_of_time()) continue;
    switch (operation.op) {
      case Operator::less:
      case Operator::less_equal:
      case Operator::equal:
      case Operator::differs:
        switches.push_back({k, operation.first, operation.second});
        break;
      case Operator::sign:
        switches.push_back({k, operation.first});
        break;
      case Operator::rint:
        switches.push_back({k});
        break;
      case Operator::abs:
        switches.push_back({-1, operation.first});
        break;
      case Operator::least:
      case Operator::greatest:
        switches.push_back({-1, operation.first, operation.second});
        break;
      default:
        break;
    }
  }
  return switches;
}

/// Places of angles of time (atan2), which jump at some of the zeros of their arguments.
std::vector<int> angles_of(const Program& program) {
  std::vector<int> angles;
  for (int k = 0; k < program.size(); ++k)
    if (program[k].is_of_time() && program[k].op == Operator::atan2) angles.push_back(k);
  return angles;
}

/// A function of time that is looked at for its changes: the sign of a difference, or a result.
class Changing {
 public:
  Changing(std::shared_ptr<const Program> program, std::vector<int> results)
      : is_difference_(results.size() == 2),
        placed_(std::move(program), results, X_),
        space_(placed_.workspace()) {}
  double at(double t) const {
    const PlacedProgram::Instant instant = placed_.at(t);
    const auto value = [&](int k) { return placed_.result(k, 0, instant, space_)[0][0]; };
    if (!is_difference_) return std::isnan(value(0)) ? none : value(0);
    const double difference = value(0) - value(1);
    return std::isnan(difference) ? none : difference > 0 ? 1 : difference < 0 ? -1 : 0;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::max();
  std::vector<Vec3> X_{Vec3::Zero()};
  bool is_difference_;
  PlacedProgram placed_;
  PlacedProgram::Workspace space_;  // of which results that depend on time alone need nothing
};

/// Adds the first double after each change that values at the instants of a grid show.
void add_changes(const Changing& changing,
                 const std::vector<double>& grid,
                 std::vector<double>& changes) {
  double before = grid.front(), value = changing.at(before);
  for (const double after : grid) {
    const double next = changing.at(after);
    double low = before, high = after;
    while (next != value) {
      const double middle = low + (high - low) / 2;
      if (!(middle > low && middle < high)) {
        changes.push_back(high);
        break;
      }
      (changing.at(middle) == value ? low : high) = middle;
    }
    before = after;
    value = next;
  }
}

/// Takes out the instants at which a function does not jump by more than 1.
void keep_jumps_of(const Changing& angle, std::vector<double>& times) {
  std::erase_if(
      times, [&](double t) { return std::abs(angle.at(t) - angle.at(std::nextafter(t, 0))) <= 1; });
}

/// With the doubles on both sides of each.
void refine(std::vector<double>& grid, const std::vector<double>& changes) {
  const double begin = grid.front(), end = grid.back();
  for (const double t : changes) {
    for (const double beside : {std::nextafter(t, begin), t, std::nextafter(t, end)})
      grid.push_back(beside);
  }
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
}

}  // namespace

BreakTimes break_times(const std::vector<Expression>& expressions,
                       double begin,
                       double end,
                       int n_samples,
                       const std::optional<Vec3>& place) {
  const auto program = std::make_shared<Program>();
  for (const Expression& expression : expressions) {
    if (!expression.depends_on_time()) continue;
    place ? program->append(expression, *place) : program->append(expression);
  }
  const std::vector<Switch> switches = switches_of(*program);
  const std::vector<int> angles = angles_of(*program);
  if ((switches.empty() && angles.empty()) || !(begin < end)) return {};
  std::vector<double> grid;
  for (int i = 0; i <= n_samples; ++i)
    grid.push_back(i == n_samples ? end : begin + (end - begin) * i / n_samples);
  const int zero = program->add_constant(0);
  BreakTimes breaks;
  constexpr int n_rounds = 2;  // kinks of kinks
  for (int round = 0; round < n_rounds; ++round) {
    std::vector<double>& kinks = breaks.kinks;
    kinks.clear();
    for (const Switch& of : switches) {
      const bool compares = of.first >= 0;
      add_changes(compares ? Changing(program, {of.first, of.second >= 0 ? of.second : zero})
                           : Changing(program, {of.result}),
                  grid, kinks);
    }
    refine(grid, kinks);
  }
  for (const Switch& of : switches)
    if (of.result >= 0) add_changes(Changing(program, {of.result}), grid, breaks.jumps);
  for (const int angle : angles) {
    std::vector<double> zeros;
    for (const int argument : {(*program)[angle].first, (*program)[angle].second})
      add_changes(Changing(program, {argument, zero}), grid, zeros);
    keep_jumps_of(Changing(program, {angle}), zeros);
    breaks.jumps.insert(breaks.jumps.end(), zeros.begin(), zeros.end());
  }
  for (std::vector<double>* times : {&breaks.jumps, &breaks.kinks}) {
    std::sort(times->begin(), times->end());
    times->erase(std::unique(times->begin(), times->end()), times->end());
  }
  return breaks;
}

std::vector<double> instants_around(const BreakTimes& breaks,
                                    double begin,
                                    double part,
                                    size_t most) {
  std::vector<double> times(breaks.jumps);
  times.insert(times.end(), breaks.kinks.begin(), breaks.kinks.end());
  std::sort(times.begin(), times.end());
  const size_t n = std::min(times.size(), most);
  std::vector<double> instants;
  for (size_t k = 0; k < n; ++k) {
    const size_t at = k * times.size() / n;
    const double before = at == 0 ? begin : times[at - 1];
    instants.push_back(before + part * (times[at] - before));
    instants.push_back(times[at]);
  }
  return instants;
}

}  // namespace diptych::functions
