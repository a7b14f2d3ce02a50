#include "postprocess/report/price.hpp"

#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::report {
namespace {

/// Runs that have both, by their numbers.
struct Points {
  std::vector<double> seconds, errors;
};

Points points_of(const std::vector<io::RunSummary>& runs, const std::string& field) {
  Points points;
  for (const io::RunSummary& run : runs) {
    const double error = error_of(run, field);
    const bool is_finite = std::isfinite(error) && error > 0 && run.loop_seconds > 0;
    if (!run.is_ended() || !is_finite) continue;
    points.seconds.push_back(run.loop_seconds);
    points.errors.push_back(error);
  }
  return points;
}

}  // namespace

double log_log_value(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  for (size_t i = 0; i + 1 < xs.size(); ++i) {
    const double a = std::log(xs[i]), b = std::log(xs[i + 1]), t = std::log(x);
    const double slack = 1e-9 * std::abs(b - a);  // ends of the range belong to it
    if (!(t >= std::min(a, b) - slack && t <= std::max(a, b) + slack) || a == b) continue;
    const double s = (t - a) / (b - a);
    return std::exp((1 - s) * std::log(ys[i]) + s * std::log(ys[i + 1]));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<Price> price_of_error(const std::vector<io::RunSummary>& first,
                                    const std::vector<io::RunSummary>& second,
                                    const std::string& field) {
  const auto a = points_of(first, field), b = points_of(second, field);
  if (a.errors.size() < 2 || b.errors.size() < 2) return std::nullopt;
  Price price;
  price.error = std::max(*std::min_element(a.errors.begin(), a.errors.end()),
                         *std::min_element(b.errors.begin(), b.errors.end()));
  price.first = log_log_value(a.errors, a.seconds, price.error);
  price.second = log_log_value(b.errors, b.seconds, price.error);
  if (!std::isfinite(price.first) || !std::isfinite(price.second)) return std::nullopt;
  return price;
}

}  // namespace diptych::report
