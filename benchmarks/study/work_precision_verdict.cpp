/// What the curves of a work-precision study say, in plain words for the top of its page.

#include "benchmarks/study/work_precision.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

using report::number_html;
using report::percent_html;

double least_seconds(const WorkCurve& curve, const std::string& field, double error) {
  return cost_at_error(curve, field, error).least;
}

/// SPH against finite volume of one variant.
std::string pair_sentence(const WorkCurve& sph, const WorkCurve& fvm, const std::string& field) {
  const std::string of = sph.variant.empty() ? "" : " with " + report::escaped(sph.variant);
  const auto errors = common_values({sph, fvm}, field, false, 2);
  if (errors.empty()) return "The two methods" + of + " reach no error in common: add levels.";
  const double fine = least_seconds(sph, field, errors[0]) / least_seconds(fvm, field, errors[0]);
  const double coarse = least_seconds(sph, field, errors[1]) / least_seconds(fvm, field, errors[1]);
  if (const auto meet = crossover(sph, fvm, field)) {
    return fmt::format("Below an error of {} ({} s) {}{} costs less, above it {}.",
                       percent_html(meet->error), number_html(meet->seconds),
                       fine < 1 ? "SPH" : "finite volume", of, fine < 1 ? "finite volume" : "SPH");
  }
  const bool sph_is_dear = fine >= 1;
  const std::string dear = sph_is_dear ? "SPH" : "finite volume";
  const std::string cheap = sph_is_dear ? "finite volume" : "SPH";
  const double at_fine = sph_is_dear ? fine : 1 / fine,
               at_coarse = sph_is_dear ? coarse : 1 / coarse;
  const std::string start = fmt::format("For the same error {}{} takes {} times the seconds of {}",
                                        dear, of, number_html(at_fine), cheap);
  if (std::abs(at_coarse - at_fine) < 0.05 * at_fine) {
    return start +
           fmt::format(", from {} down to {}.", percent_html(errors[1]), percent_html(errors[0]));
  }
  return start + fmt::format(" at {}, {} times at {}.", percent_html(errors[0]),
                             number_html(at_coarse), percent_html(errors[1]));
}

/// The cheapest and the dearest of several variants, at the smallest error that all reach.
std::string best_sentence(const std::vector<WorkCurve>& curves, const std::string& field) {
  const auto errors = common_values(curves, field, false, 2);
  if (errors.empty()) return "";
  const auto cheaper = [&](const WorkCurve& a, const WorkCurve& b) {
    return least_seconds(a, field, errors[0]) < least_seconds(b, field, errors[0]);
  };
  const auto [best, worst] = std::minmax_element(curves.begin(), curves.end(), cheaper);
  return fmt::format("At an error of {} {} is the cheapest ({} s) and {} the dearest ({} s).",
                     percent_html(errors[0]), report::escaped(best->name()),
                     number_html(least_seconds(*best, field, errors[0])),
                     report::escaped(worst->name()),
                     number_html(least_seconds(*worst, field, errors[0])));
}

bool every_error_is_large(const std::vector<WorkCurve>& curves, const std::string& field) {
  for (const WorkCurve& curve : curves) {
    for (const WorkPoint& point : curve.points) {
      if (point.error(field) <= report::too_far_apart) return false;
    }
  }
  return true;
}

}  // namespace

std::string work_precision_verdict(const std::vector<WorkCurve>& curves, const std::string& field) {
  if (every_error_is_large(curves, field)) {
    return fmt::format("Too coarse to say: every run misses more than half of the {}; add levels.",
                       report::field_title(field));
  }
  std::string text = curves.size() > 2 ? best_sentence(curves, field) : "";
  for (const WorkCurve& a : curves) {
    for (const WorkCurve& b : curves) {
      if (a.variant != b.variant || a.method != "sph" || b.method != "fvm") continue;
      if (!text.empty()) text += ' ';
      text += report::at_the_start(pair_sentence(a, b, field));
    }
  }
  return text;
}

}  // namespace diptych::harness
