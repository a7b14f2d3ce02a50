#include "benchmarks/terminal/schedule.hpp"

#include <cmath>
#include <cstdlib>

namespace diptych::harness {

namespace {

/// Mean of the known runs on the level nearest to the one asked for, brought to that level.
template <class Alike>
std::optional<double> from_nearest_level(const std::vector<PlannedRun>& runs,
                                         const std::vector<std::optional<double>>& known,
                                         const PlannedRun& asked,
                                         Alike alike) {
  int nearest = -1;
  double sum = 0;
  int n = 0;
  for (size_t i = 0; i < known.size(); ++i) {
    if (!known[i] || !alike(runs[i])) continue;
    const int away = std::abs(runs[i].level - asked.level);
    if (nearest >= 0 && away > nearest) continue;
    if (away != nearest) sum = n = 0;
    nearest = away;
    sum += *known[i] * std::exp2((asked.dimension + 1) * (asked.level - runs[i].level));
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / n;
}

}  // namespace

std::optional<double> Schedule::expected(const PlannedRun& run,
                                         const std::vector<std::optional<double>>& known) const {
  const auto of_kind = from_nearest_level(
      runs_, known, run, [&](const PlannedRun& other) { return other.kind == run.kind; });
  if (of_kind) return of_kind;
  return from_nearest_level(runs_, known, run,
                            [&](const PlannedRun& other) { return other.family == run.family; });
}

std::optional<double> Schedule::left_after(size_t first,
                                           const std::vector<std::optional<double>>& known) const {
  double sum = 0;
  for (size_t i = first; i < runs_.size(); ++i) {
    const auto seconds = expected(runs_[i], known);
    if (!seconds) return std::nullopt;
    sum += *seconds;
  }
  return sum;
}

std::optional<double> Schedule::seconds_left(double own_left, double own_total) const {
  auto known = seconds_;
  known.emplace_back(own_total);
  const auto after = left_after(known.size(), known);
  if (!after) return std::nullopt;
  return own_left + *after;
}

std::optional<double> Schedule::seconds_left() const {
  return left_after(seconds_.size(), seconds_);
}

}  // namespace diptych::harness
