#include "benchmarks/study/work_precision.hpp"

#include "postprocess/report/orders.hpp"
#include "postprocess/report/price.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct Columns {
  std::vector<double> error, least, most;
};

/// Points of a curve that have an error and a time.
Columns columns_of(const WorkCurve& curve, const std::string& field) {
  Columns c;
  for (const WorkPoint& point : curve.points) {
    const double error = point.error(field);
    if (!(error > 0) || !(point.least > 0)) continue;
    c.error.push_back(error);
    c.least.push_back(point.least);
    c.most.push_back(point.most);
  }
  return c;
}

}  // namespace

double WorkPoint::error(const std::string& field) const {
  return report::error_of(run, field);
}

std::string WorkCurve::name() const {
  const std::string short_title = method == "sph" ? "SPH" : method == "fvm" ? "FVM" : method;
  return short_title + (variant.empty() ? "" : " " + variant);
}

Range cost_at_error(const WorkCurve& curve, const std::string& field, double error) {
  const Columns c = columns_of(curve, field);
  return {report::log_log_value(c.error, c.least, error),
          report::log_log_value(c.error, c.most, error)};
}

Range error_at_cost(const WorkCurve& curve, const std::string& field, double seconds) {
  const Columns c = columns_of(curve, field);
  // had it taken its longest times, the same seconds would have bought a coarser level
  const double fast = report::log_log_value(c.least, c.error, seconds);
  const double slow = report::log_log_value(c.most, c.error, seconds);
  return {std::min(fast, slow), std::max(fast, slow)};
}

std::optional<Crossover> crossover(const WorkCurve& a,
                                   const WorkCurve& b,
                                   const std::string& field) {
  const Columns ca = columns_of(a, field), cb = columns_of(b, field);
  std::vector<double> errors = ca.error;  // between these the log of the ratio of costs is straight
  errors.insert(errors.end(), cb.error.begin(), cb.error.end());
  std::sort(errors.begin(), errors.end(), std::greater<>());
  double last_error = nothing, last_ratio = nothing;
  for (const double error : errors) {
    const double cost_a = report::log_log_value(ca.error, ca.least, error);
    const double cost_b = report::log_log_value(cb.error, cb.least, error);
    const double ratio = std::log(cost_a / cost_b);
    if (!std::isfinite(ratio)) continue;
    if (std::isfinite(last_ratio) && ratio * last_ratio < 0) {
      const double s = last_ratio / (last_ratio - ratio);
      const double at = std::exp((1 - s) * std::log(last_error) + s * std::log(error));
      return Crossover{at, report::log_log_value(ca.error, ca.least, at)};
    }
    last_error = error;
    last_ratio = ratio;
  }
  return std::nullopt;
}

std::vector<double> common_values(const std::vector<WorkCurve>& curves,
                                  const std::string& field,
                                  bool cost,
                                  int n) {
  double low = 0, high = std::numeric_limits<double>::infinity();
  for (const WorkCurve& curve : curves) {
    const Columns c = columns_of(curve, field);
    const std::vector<double>& values = cost ? c.least : c.error;
    if (values.size() < 2) return {};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    low = std::max(low, *least);
    high = std::min(high, *most);
  }
  std::vector<double> common;
  if (!(low < high) || !std::isfinite(high)) return common;
  for (int i = 0; i < n; ++i)
    common.push_back(low * std::pow(high / low, static_cast<double>(i) / (n - 1)));
  return common;
}

}  // namespace diptych::harness
