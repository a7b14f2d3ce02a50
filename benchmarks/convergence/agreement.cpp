/// Whether two methods agree within what refinement says of each.

#include "benchmarks/convergence/convergence.hpp"
#include "postprocess/report/orders.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

double error_bar(const MethodConvergence& study, const Quantity& quantity) {
  if (const auto g = estimate(study, quantity, quantity.values.size() - 1)) return g->error_bar;
  const bool two = quantity.values.size() == 2 &&
                   std::isfinite(quantity.values[0] + quantity.values[1]) &&
                   study.levels[1].spacing < study.levels[0].spacing;
  if (!two) return std::numeric_limits<double>::quiet_NaN();
  return report::two_grid_error_bar({study.levels[1].spacing, study.levels[0].spacing},
                                    {quantity.values[1], quantity.values[0]});
}

std::string agreement_table(const std::vector<MethodConvergence>& studies) {
  if (studies.size() != 2 || studies[0].levels.back().level != studies[1].levels.back().level)
    return "";
  std::string lines;
  for (const Quantity& one : studies[0].scalars) {
    for (const Quantity& other : studies[1].scalars) {
      if (other.name != one.name) continue;
      const double difference = std::abs(one.values.back() - other.values.back());
      const double bars = error_bar(studies[0], one) + error_bar(studies[1], other);
      if (!std::isfinite(difference + bars)) continue;
      lines += fmt::format("{:<48} {:>10.2e} {:>10.2e}  {}\n", one.name + " [" + one.unit + "]",
                           difference, bars, difference <= bars ? "agree" : "DIFFER");
    }
  }
  if (lines.empty()) return "";
  std::string text =
      fmt::format("{}, {} and {} on level {}: apart, and the sum of their error bars\n",
                  studies[0].case_name, report::method_title(studies[0].method),
                  report::method_title(studies[1].method), studies[0].levels.back().level);
  text += std::string(80, '-') + "\n";
  return text + lines;
}

}  // namespace diptych::harness
