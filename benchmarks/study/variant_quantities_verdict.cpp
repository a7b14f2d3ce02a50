/// What a study of quantities says, in plain words for the top of its page.

#include "benchmarks/study/variant_quantities.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace diptych::harness {

namespace {

/// What a run costs and how exact it was says nothing of the body.
bool is_of_the_run(const std::string& quantity) {
  static const std::set<std::string> of_runs{"seconds", "steps", "nodes", "energy residual"};
  return of_runs.count(quantity) > 0;
}

/// How far SPH and finite volumes are apart in one quantity at the most, over the largest magnitude
/// that it has in either, and for which variant.
struct Distance {
  std::string quantity, variant;
  double relative = 0;
};

/// Values on the finest level that both methods have: variant, method, value.
using Values = std::map<std::string, std::map<std::string, double>>;

Values values_of(const VariantStudy& study, const std::string& quantity, int level) {
  Values values;
  for (const WorkCurve& curve : study.curves) {
    for (const WorkPoint& point : curve.points) {
      const double value = value_of(point, quantity);
      if (point.run.level == level && std::isfinite(value))
        values[curve.variant][curve.method] = value;
    }
  }
  return values;
}

Distance largest_distance(const std::string& quantity, const Values& values) {
  double scale = 0;
  for (const auto& [variant, methods] : values) {
    for (const auto& [method, value] : methods)
      scale = std::max(scale, std::abs(value));
  }
  Distance largest{quantity, "", 0};
  for (const auto& [variant, methods] : values) {
    if (methods.size() < 2 || scale == 0) continue;
    const double apart = std::abs(methods.at("sph") - methods.at("fvm")) / scale;
    if (apart >= largest.relative) largest = {quantity, variant, apart};
  }
  return largest;
}

/// The finest level that both methods have; -1: none.
int finest_common_level(const VariantStudy& study) {
  std::map<int, std::set<std::string>> methods;
  for (const WorkCurve& curve : study.curves) {
    for (const WorkPoint& point : curve.points)
      methods[point.run.level].insert(curve.method);
  }
  int finest = -1;
  for (const auto& [level, names] : methods) {
    if (names.size() == 2) finest = level;
  }
  return finest;
}

std::string in_words(const Distance& distance) {
  return report::escaped(distance.quantity) +
         (distance.variant.empty() ? "" : " (" + report::escaped(distance.variant) + ")");
}

}  // namespace

std::string quantities_verdict(const VariantStudy& study) {
  const int level = finest_common_level(study);
  if (level < 0) return "One method only: there is nothing to hold its quantities against.";
  std::vector<Distance> apart;
  for (const std::string& quantity : study.quantities) {
    if (!is_of_the_run(quantity))
      apart.push_back(largest_distance(quantity, values_of(study, quantity, level)));
  }
  if (apart.empty()) return "Only costs are shown: of the body nothing is compared.";
  const auto less = [](const Distance& a, const Distance& b) { return a.relative < b.relative; };
  const Distance worst = *std::max_element(apart.begin(), apart.end(), less);
  const auto n_close = std::count_if(apart.begin(), apart.end(),
                                     [](const Distance& d) { return d.relative <= 0.05; });
  const std::string close = fmt::format(
      "On level {} SPH and finite volume are within 5 % of the largest value in {} of {} "
      "quantities, whatever the variant.",
      level, n_close, apart.size());
  if (worst.relative > report::too_far_apart) {
    return fmt::format(
        "Too coarse to say of {}: the methods differ by more than half of it; add "
        "levels. {}",
        in_words(worst), close);
  }
  return fmt::format("{} They are furthest apart in {}: by {}.", close, in_words(worst),
                     report::percent_html(worst.relative));
}

}  // namespace diptych::harness
