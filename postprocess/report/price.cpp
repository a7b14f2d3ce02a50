#include "postprocess/report/price.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::report {
namespace {

struct Point {
  double seconds, error;
};

std::vector<Point> points_of(const std::vector<io::RunSummary>& runs, const std::string& field) {
  std::vector<Point> points;
  for (const io::RunSummary& run : runs) {
    const auto found = run.errors.find(field);
    if (run.status != "done" || found == run.errors.end()) continue;
    const double error = found->second.l2;
    if (std::isfinite(error) && error > 0 && run.loop_seconds > 0)
      points.push_back({run.loop_seconds, error});
  }
  return points;
}

/// NaN where the points do not span the error.
double seconds_at(const std::vector<Point>& points, double error) {
  constexpr double rounding = 1e-12;  // the error is one of the points of one of the methods
  for (size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    const bool spans = std::max(a.error, b.error) >= error * (1 - rounding) &&
                       std::min(a.error, b.error) <= error * (1 + rounding);
    if (!spans || a.error == b.error) continue;
    const double part = std::log(error / a.error) / std::log(b.error / a.error);
    return a.seconds * std::pow(b.seconds / a.seconds, part);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double least_error(const std::vector<Point>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& point : points)
    least = std::min(least, point.error);
  return least;
}

}  // namespace

std::optional<Price> price_of_error(const std::vector<io::RunSummary>& first,
                                    const std::vector<io::RunSummary>& second,
                                    const std::string& field) {
  const auto a = points_of(first, field), b = points_of(second, field);
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  Price price;
  price.error = std::max(least_error(a), least_error(b));
  price.first = seconds_at(a, price.error);
  price.second = seconds_at(b, price.error);
  if (!std::isfinite(price.first) || !std::isfinite(price.second)) return std::nullopt;
  return price;
}

}  // namespace diptych::report
