#include "common/run/references.hpp"

#include "common/cases/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

namespace {

using Point = std::array<double, 2>;  // s, unit of the probe

template <class Row>
std::vector<Point> points_of(const std::vector<Row>& rows, size_t k) {
  std::vector<Point> points;
  for (const Row& row : rows)
    points.push_back({row.time, row.probes.at(k)});
  return points;
}

/// What a run recorded of a probe.
std::vector<Point> record_of(const std::vector<cases::ProbeCase>& probes,
                             size_t k,
                             const std::vector<io::HistoryRow>& history,
                             const std::vector<io::StepRow>& steps) {
  if (!probes[k].every_step || steps.empty()) return points_of(history, k);
  const auto n_stepped = std::count_if(probes.begin(), probes.begin() + static_cast<long>(k),
                                       [](const auto& probe) { return probe.every_step; });
  return points_of(steps, static_cast<size_t>(n_stepped));
}

/// Those in a span of time; its ends are within rounding of it.
std::vector<Point> within(const std::vector<Point>& points, double from, double to) {
  const double rounding = 1e-9 * std::max(std::abs(from), std::abs(to));
  std::vector<Point> inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside), [&](const Point& point) {
    return point[0] >= from - rounding && point[0] <= to + rounding;
  });
  return inside;
}

/// Along straight lines, at a time within rounding of those of the points.
double value_at(const std::vector<Point>& points, double time) {
  const auto after = std::lower_bound(points.begin(), points.end(), time,
                                      [](const Point& point, double t) { return point[0] < t; });
  if (after == points.begin()) return points.front()[1];
  if (after == points.end()) return points.back()[1];
  const Point &a = *(after - 1), &b = *after;
  return a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0]);
}

/// Fills in how far the record is from the points. @return false where they share no time
bool compare(const std::vector<Point>& record,
             const std::vector<Point>& points,
             io::ReferenceSummary& summary) {
  if (record.empty() || points.empty()) return false;
  const std::vector<Point> known = within(points, record.front()[0], record.back()[0]),
                           run = within(record, points.front()[0], points.back()[0]);
  const bool at_points = run.empty() || (!known.empty() && known.size() <= run.size());
  const std::vector<Point>& times = at_points ? known : run;
  double squares = 0;
  for (const Point& point : times) {
    const double off =
        at_points ? value_at(record, point[0]) - point[1] : point[1] - value_at(points, point[0]);
    // of no number the first one is told
    const bool is_none = !std::isfinite(off) && std::isfinite(summary.greatest);
    if (std::abs(off) > summary.greatest || is_none) {
      summary.greatest = std::abs(off);
      summary.greatest_at = point[0];
    }
    squares += off * off;
    summary.at_end = off;
  }
  summary.n_times = static_cast<std::int64_t>(times.size());
  if (times.empty()) return false;
  summary.until = times.back()[0];
  summary.rms = std::sqrt(squares / static_cast<double>(times.size()));
  return true;
}

}  // namespace

std::string changed_scene(const std::vector<std::string>& overrides) {
  for (const std::string& entry : overrides) {
    const std::string key = cases::key_of(entry);
    for (const char* part : {"material.", "parameters.", "functions.", "initial.", "boundary.",
                             "load.", "manufactured.", "mesh.lower", "mesh.upper", "mesh.file"}) {
      if (key.rfind(part, 0) == 0) return entry;
    }
  }
  return "";
}

std::vector<std::string> reference_names(const cases::Case& setup) {
  std::vector<std::string> names;
  std::map<std::string, int> n_seen;
  for (const cases::ReferenceCase& reference : setup.references) {
    const int n = ++n_seen[reference.probe];
    names.push_back(n == 1 ? reference.probe : fmt::format("{} ({})", reference.probe, n));
  }
  return names;
}

std::map<std::string, std::vector<double>> reference_times(const cases::Case& setup) {
  const std::vector<std::string> names = reference_names(setup);
  std::map<std::string, std::vector<double>> times;
  for (size_t i = 0; i < names.size(); ++i) {
    for (const auto& point : setup.references[i].points)
      times[names[i]].push_back(point[0]);
  }
  return times;
}

std::vector<io::ReferenceSummary> references_of(const cases::Case& setup,
                                                const std::vector<io::HistoryRow>& history,
                                                const std::vector<io::StepRow>& steps) {
  std::vector<io::ReferenceSummary> all;
  if (!changed_scene(setup.overrides).empty()) return all;
  const std::vector<std::string> names = reference_names(setup);
  for (size_t i = 0; i < setup.references.size(); ++i) {
    const cases::ReferenceCase& reference = setup.references[i];
    const auto probe = std::find_if(setup.probes.begin(), setup.probes.end(),
                                    [&](const auto& one) { return one.name == reference.probe; });
    const auto k = static_cast<size_t>(probe - setup.probes.begin());
    io::ReferenceSummary summary;
    summary.name = names[i];
    summary.probe = reference.probe;
    summary.source = reference.source;
    summary.uncertainty = reference.uncertainty;
    if (compare(record_of(setup.probes, k, history, steps), reference.points, summary))
      all.push_back(summary);
  }
  return all;
}

}  // namespace diptych::run
