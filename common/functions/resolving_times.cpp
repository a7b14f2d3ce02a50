#include "common/functions/resolving_times.hpp"

#include "common/functions/placed_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace diptych::functions {

namespace {

/// Expressions, and of those that depend on the place, too, what enters them of time alone.
class OfTime {
 public:
  OfTime(const std::vector<Expression>& expressions, const std::optional<Vec3>& place)
      : program_(program_of(expressions, place, results_)),
        placed_(program_, results_, X_),
        space_(placed_.workspace()),
        scale_(results_.size()) {}
  bool is_empty() const { return results_.empty(); }
  using Values = std::vector<double>;
  Values at(double t) const {
    const PlacedProgram::Instant instant = placed_.at(t);
    Values values;
    for (int k = 0; k < static_cast<int>(results_.size()); ++k)
      values.push_back(placed_.result(k, 0, instant, space_)[0][0]);
    return values;
  }
  void add_to_scale(const Values& values) {
    for (size_t k = 0; k < values.size(); ++k)
      if (std::isfinite(values[k])) scale_[k] = std::max(scale_[k], std::abs(values[k]));
  }
  /// How far five values at equal distances are off a straight line, over the largest value: the
  /// mean of the inner ones, of the worst expression.
  double bend(const std::array<const Values*, 5>& values) const {
    double worst = 0;
    for (size_t k = 0; k < scale_.size(); ++k) {
      double off = 0;
      for (const int i : {1, 2, 3})
        off += off_line(k, *values[0], *values[4], 0.25 * i, *values[static_cast<size_t>(i)]) / 4;
      if (scale_[k] > 0 && std::isfinite(off)) worst = std::max(worst, off / scale_[k]);
    }
    return worst;
  }
  /// The same of one value in between: swings may be straight wherever a step is halved.
  double bend(const Values& first, const Values& last, double part, const Values& between) const {
    double worst = 0;
    for (size_t k = 0; k < scale_.size(); ++k) {
      const double off = off_line(k, first, last, part, between);
      if (scale_[k] > 0 && std::isfinite(off)) worst = std::max(worst, 0.5 * off / scale_[k]);
    }
    return worst;
  }

 private:
  static double off_line(
      size_t k, const Values& first, const Values& last, double part, const Values& between) {
    return std::abs(between[k] - ((1 - part) * first[k] + part * last[k]));
  }
  static std::shared_ptr<const Program> program_of(const std::vector<Expression>& expressions,
                                                   const std::optional<Vec3>& place,
                                                   std::vector<int>& results) {
    const auto program = std::make_shared<Program>();
    std::vector<int> roots;
    for (const Expression& expression : expressions) {
      if (!expression.depends_on_time()) continue;
      roots.push_back(place ? program->append(expression, *place) : program->append(expression));
    }
    const auto add = [&](int k) {
      if (k >= 0 && (*program)[k].is_of_time()) results.push_back(k);
    };
    for (const int root : roots)
      add(root);
    for (int k = 0; k < program->size(); ++k) {
      const Operation& operation = (*program)[k];
      if (!operation.is_mixed()) continue;
      const int n = operation.n_arguments();
      if (n > 0) add(operation.first);
      if (n > 1) add(operation.second);
      if (n > 2) add(operation.third);
    }
    std::sort(results.begin(), results.end());
    results.erase(std::unique(results.begin(), results.end()), results.end());
    return program;
  }

  std::vector<Vec3> X_{Vec3::Zero()};
  std::vector<int> results_;
  std::shared_ptr<const Program> program_;
  PlacedProgram placed_;
  PlacedProgram::Workspace space_;  // of which results that depend on time alone need nothing
  std::vector<double> scale_;       // [results] largest value
};

struct Piece {
  double begin, end;
  std::int64_t n;  ///< steps
  double at(std::int64_t quarter) const {
    return quarter == 4 * n
               ? end
               : begin + (end - begin) * static_cast<double>(quarter) / static_cast<double>(4 * n);
  }
};

/// Between two breaks each.
std::vector<Piece> pieces_of(
    const BreakTimes& breaks, double begin, double end, double dt, double most) {
  std::vector<double> times = breaks.jumps;
  times.insert(times.end(), breaks.kinks.begin(), breaks.kinks.end());
  times.push_back(end);
  std::sort(times.begin(), times.end());
  const double step = std::max(dt, (end - begin) / most), least = 1e-13 * (end - begin);
  std::vector<Piece> pieces;
  for (const double t : times) {
    // the value at a jump is that of behind it
    const bool is_jump = std::binary_search(breaks.jumps.begin(), breaks.jumps.end(), t);
    const double last = is_jump ? std::nextafter(t, begin) : t;
    if (last - begin > least)
      pieces.push_back({begin, last, static_cast<std::int64_t>(std::ceil((last - begin) / step))});
    begin = std::max(begin, t);
  }
  return pieces;
}

class Resolving {
 public:
  Resolving(const OfTime& functions, double dt, double most, std::vector<double>& times)
      : functions_(functions), dt_(dt), most_(most), times_(times) {}
  using Five = std::array<const OfTime::Values*, 5>;
  /// Nowhere straight in a step, or too many parts of all.
  bool is_full() const { return static_cast<double>(n_parts_) > most_ || is_step_full(); }
  void begin_step() { n_before_ = n_parts_; }
  std::int64_t n_parts() const { return n_parts_; }
  /// The step that is worked is straight nowhere.
  bool is_step_full() const { return n_parts_ - n_before_ > most_of_step; }
  /// Adds the ends of the parts of [begin, end].
  void split(double begin, double end, const Five& values, int depth = 0) {
    constexpr int deepest = 12;
    const double middle = begin + (end - begin) / 2;
    const bool is_step = depth == 0;
    if (is_full()) return;
    double bend = functions_.bend(values);
    for (const double oblique : {0.6180339887, 0.2763932023}) {
      if (bend > least_bend) break;
      const OfTime::Values between = functions_.at(begin + oblique * (end - begin));
      bend = std::max(bend, functions_.bend(*values[0], *values[4], oblique, between));
    }
    const bool is_long = end - begin >= dt_ * (1 - 1e-9);
    if (bend <= (is_long ? least_bend : resolved_bend) || depth == deepest ||
        !(middle > begin && middle < end)) {
      if (!is_step && end - begin < dt_) {
        times_.push_back(begin);
        times_.push_back(end);
        ++n_parts_;
      }
      return;
    }
    const auto between = [&](int i) {
      return functions_.at(begin + (end - begin) * (2 * i + 1) / 8);
    };
    const OfTime::Values one = between(0), two = between(1), three = between(2), four = between(3);
    split(begin, middle, {values[0], &one, values[1], &two, values[2]}, depth + 1);
    split(middle, end, {values[2], &three, values[3], &four, values[4]}, depth + 1);
  }

 private:
  const OfTime& functions_;
  double dt_, most_;
  static constexpr std::int64_t most_of_step = 2048;
  std::int64_t n_parts_ = 0, n_before_ = 0;
  std::vector<double>& times_;
};

}  // namespace

ResolvingTimes resolving_times(const std::vector<Expression>& expressions,
                               const BreakTimes& breaks,
                               double begin,
                               double end,
                               double dt,
                               const std::optional<Vec3>& place) {
  ResolvingTimes result;
  OfTime functions(expressions, place);
  if (functions.is_empty() || !(begin < end)) return result;
  const std::vector<Piece> pieces =
      pieces_of(breaks, begin, end, dt, place ? most_steps / 10 : most_steps);
  for (const Piece& piece : pieces) {
    for (std::int64_t quarter = 0; quarter <= 4 * piece.n; ++quarter) {
      functions.add_to_scale(functions.at(piece.at(quarter)));
      // and where no swing of a quarter of a step is zero each time
      const double t =
          piece.at(quarter) +
          std::fmod(0.6180339887 * static_cast<double>(quarter), 1) * (piece.at(1) - piece.begin);
      if (t < piece.end) functions.add_to_scale(functions.at(t));
    }
  }
  const auto n_pieces = static_cast<double>(pieces.size());
  const double most = std::min(most_parts, most_per_step * ((end - begin) / dt + n_pieces));
  Resolving resolving(functions, dt, most, result.times);
  double looked_at = begin;
  for (const Piece& piece : pieces) {
    // a kink beside what is shorter than a step
    const bool is_short = piece.end - piece.begin < dt;
    OfTime::Values first = functions.at(piece.begin);
    for (std::int64_t step = 0; step < piece.n && !resolving.is_full(); ++step) {
      const auto at = [&](int i) { return functions.at(piece.at(4 * step + i)); };
      const OfTime::Values one = at(1), two = at(2), three = at(3), last = at(4);
      resolving.begin_step();
      resolving.split(piece.at(4 * step), piece.at(4 * step + 4),
                      {&first, &one, &two, &three, &last});
      first = last;
      looked_at = piece.at(4 * step + 4);
    }
    if (is_short) {
      result.times.push_back(piece.begin);
      result.times.push_back(piece.end);
    }
  }
  result.are_too_many = resolving.is_full();
  const double per_step = static_cast<double>(resolving.n_parts()) * dt / (looked_at - begin);
  if (result.are_too_many && !resolving.is_step_full() && per_step <= followed_anyway) return {};
  std::sort(result.times.begin(), result.times.end());
  result.times.erase(std::unique(result.times.begin(), result.times.end()), result.times.end());
  return result;
}

}  // namespace diptych::functions
