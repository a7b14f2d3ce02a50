#include "postprocess/report/grid_convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::report {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-12;         // relative; sums of 1e6 terms in double precision
constexpr double factor_of_safety = 1.25;  // Roache: three grids

/// Root p of p = |ln(e32/e21) + q(p)|/ln r21 with q = ln((r21^p - 1)/(r32^p - 1)), found by
/// bisection of e32/e21 = (h3^p - h2^p)/(h2^p - h1^p), whose right side grows with p.
double observed_order_of(const double (&h)[3], double e21, double e32) {
  const auto ratio = [&](double p) {
    if (std::abs(p) < 1e-9) return std::log(h[2] / h[1]) / std::log(h[1] / h[0]);
    return (std::pow(h[2] / h[1], p) - 1) / (1 - std::pow(h[0] / h[1], p));
  };
  double low = -20, high = 20;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (ratio(middle) < e32 / e21 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

GridConvergence grid_convergence(const double (&h)[3], const double (&f)[3], double formal_order) {
  GridConvergence result;
  const double e21 = f[1] - f[0], e32 = f[2] - f[1];
  const double size = std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
  const double range = std::max({f[0], f[1], f[2]}) - std::min({f[0], f[1], f[2]});
  const auto relative = [&](double bar) { return f[0] != 0 ? bar / std::abs(f[0]) : nothing; };
  if (range <= rounding * size) {
    result = {Convergence::same, nothing, f[0], range, relative(range), range};
    return result;
  }
  result.range = range;
  const double order = e21 * e32 > 0 ? observed_order_of(h, e21, e32) : nothing;
  if (!(order > 0)) {  // NaN too; order <= 0: they part as the grid gets finer
    result.kind = e21 * e32 < 0 ? Convergence::oscillating : Convergence::diverging;
    if (e21 == 0) result.kind = Convergence::oscillating;
    result.order = result.extrapolated = nothing;
    result.error_bar = 3 * range;
    result.index = relative(result.error_bar);
    return result;
  }
  const double r = h[1] / h[0];
  result.order = order;
  result.extrapolated = f[0] - e21 / (std::pow(r, order) - 1);
  result.error_bar =
      factor_of_safety * std::abs(e21) / (std::pow(r, std::min(order, formal_order)) - 1);
  result.index = relative(result.error_bar);
  return result;
}

std::optional<GridConvergence> finest_convergence(const std::vector<double>& spacings,
                                                  const std::vector<double>& values) {
  const size_t n = values.size();
  if (n < 3) return std::nullopt;
  const double h[3] = {spacings[n - 1], spacings[n - 2], spacings[n - 3]};
  const double f[3] = {values[n - 1], values[n - 2], values[n - 3]};
  if (!std::isfinite(f[0] + f[1] + f[2]) || !(h[0] < h[1] && h[1] < h[2])) return std::nullopt;
  return grid_convergence(h, f);
}

double two_grid_error_bar(const double (&h)[2], const double (&f)[2], double formal_order) {
  return 3 * std::abs(f[1] - f[0]) / (std::pow(h[1] / h[0], formal_order) - 1);
}

std::string convergence_name(Convergence kind) {
  switch (kind) {
    case Convergence::monotone:
      return "monotone";
    case Convergence::same:
      return "same on all";
    case Convergence::oscillating:
      return "oscillates";
    default:
      return "diverges";
  }
}

}  // namespace diptych::report
