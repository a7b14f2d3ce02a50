#include "common/run/oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace diptych::run {

namespace {

using Samples = std::span<const double>;

/// An upward crossing of a level, between samples i and i + 1.
struct Crossing {
  size_t i = 0;
  double time = 0;  ///< s
};

/// The signal must have been below level - band before and come above level + band: a band of a
/// tenth of what it swung over since the crossing before, of its whole range at first, and never of
/// less than a hundredth of that.
std::vector<Crossing> upward_crossings(Samples times, Samples values, double level, double range) {
  std::vector<Crossing> crossings;
  bool was_below = false;
  Crossing last;
  double band = 0.1 * range, least = level, greatest = level;  // since the crossing before
  for (size_t i = 0; i + 1 < values.size(); ++i) {
    least = std::min(least, values[i]);
    greatest = std::max(greatest, values[i]);
    if (values[i] < level - band) was_below = true;
    if (values[i] < level && values[i + 1] >= level) {
      const double share = (level - values[i]) / (values[i + 1] - values[i]);
      last = {i, times[i] + share * (times[i + 1] - times[i])};
    }
    if (was_below && values[i + 1] > level + band) {
      if (!crossings.empty()) band = std::clamp(0.1 * (greatest - least), 0.01 * range, band);
      crossings.push_back(last);
      was_below = false;
      least = greatest = level;
    }
  }
  return crossings;
}

/// Mean of the piecewise linear signal from one crossing to another, which are at `level`.
double mean_between(
    Samples times, Samples values, const Crossing& a, const Crossing& b, double level) {
  double integral = 0, t = a.time, value = level;
  for (size_t i = a.i + 1; i <= b.i; ++i) {
    integral += 0.5 * (value + values[i]) * (times[i] - t);
    t = times[i];
    value = values[i];
  }
  integral += 0.5 * (value + level) * (b.time - t);
  return integral / (b.time - a.time);
}

/// Extreme of sign * value over samples first ... last, by a parabola through the largest three.
double extreme(Samples times, Samples values, size_t first, size_t last, double sign) {
  size_t i = first;
  for (size_t k = first; k <= last; ++k) {
    if (sign * values[k] > sign * values[i]) i = k;
  }
  if (i == 0 || i + 1 == values.size()) return values[i];
  const double s = times[i] - times[i - 1], r = times[i + 1] - times[i];
  const double slope_s = (values[i] - values[i - 1]) / s, slope_r = (values[i + 1] - values[i]) / r;
  const double curvature = (slope_r - slope_s) / (s + r);
  if (sign * curvature >= 0) return values[i];
  const double slope = (slope_s * r + slope_r * s) / (s + r);
  return values[i] - 0.25 * slope * slope / curvature;
}

/// What the signal does in each of the whole periods.
struct Periods {
  int n = 0;
  double period = 0;     ///< s
  double amplitude = 0;  ///< of the first
  std::optional<double> decrement;
};

Periods periods_of(Samples times, Samples values, const std::vector<Crossing>& crossings) {
  Periods periods;
  periods.n = static_cast<int>(crossings.size()) - 1;
  periods.period = (crossings.back().time - crossings.front().time) / periods.n;
  std::vector<double> amplitudes;
  for (size_t k = 0; k + 1 < crossings.size(); ++k) {
    const size_t first = crossings[k].i, last = crossings[k + 1].i;
    amplitudes.push_back(
        0.5 * (extreme(times, values, first, last, 1) - extreme(times, values, first, last, -1)));
  }
  periods.amplitude = amplitudes.front();
  if (amplitudes.size() > 1 && amplitudes.front() > 0 && amplitudes.back() > 0) {
    periods.decrement = std::log(amplitudes.front() / amplitudes.back()) /
                        static_cast<double>(amplitudes.size() - 1);
  }
  return periods;
}

/// What B exp(-a t) sin(w t), of which the periods are, has for a mean over them: with damping the
/// first halves outweigh the second ones.
double mean_of_damped(const Periods& periods) {
  if (!periods.decrement) return 0;
  const double delta = *periods.decrement, a = delta / periods.period,
               w = 2 * std::numbers::pi / periods.period, square = a * a + w * w;
  const double crest = std::exp(-a / w * std::atan2(w, a)) * w / std::sqrt(square);
  const double B = 2 * periods.amplitude / (crest * (1 + std::exp(-0.5 * delta)));
  return -B * w * std::expm1(-delta * periods.n) / (square * periods.n * periods.period);
}

/// Where a damped sine comes to rest: its successive extremes are from there by a constant ratio.
/// Of the greatest and the least value, and the next extreme like the first of them.
std::optional<double> rest_of_extremes(Samples values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const bool falls_first = greatest < least;
  const auto first = falls_first ? greatest : least, second = falls_first ? least : greatest;
  const auto third =
      falls_first ? std::max_element(second, values.end()) : std::min_element(second, values.end());
  if (third == second || third + 1 == values.end()) return std::nullopt;
  const double rest = (*first * *third - *second * *second) / (*first + *third - 2 * *second);
  return rest > *least && rest < *greatest ? std::optional(rest) : std::nullopt;
}

}  // namespace

std::optional<Oscillation> oscillation_of(Samples times, Samples values) {
  if (values.size() < 3) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const std::optional<double> rest = rest_of_extremes(values);
  double level = rest.value_or(0.5 * (*least + *greatest));
  std::vector<Crossing> crossings;
  Periods periods;
  for (int pass = 0; pass < 5; ++pass) {
    auto found = upward_crossings(times, values, level, *greatest - *least);
    if (found.size() < 2) break;
    crossings = std::move(found);
    periods = periods_of(times, values, crossings);
    if (!periods.decrement && rest) break;  // the mean of one period is no place of rest
    level = mean_between(times, values, crossings.front(), crossings.back(), level) -
            mean_of_damped(periods);
  }
  if (crossings.size() < 2) return std::nullopt;
  return Oscillation{periods.n, periods.period, level, periods.amplitude, periods.decrement};
}

}  // namespace diptych::run
