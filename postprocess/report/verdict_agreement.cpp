/// What refinement says of the quantities of two methods, in sentences.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::report {

double scale_of(const std::vector<GridSeries>& series) {
  double scale = 0;
  for (const GridSeries& one : series) {
    if (one.scale) {
      scale = std::max(scale, *one.scale);
      continue;
    }
    for (const GridPoint& point : one.points)
      scale = std::max(scale, std::abs(point.value));
  }
  return scale;
}

std::vector<GridSeries> series_of_methods(const std::vector<GridSeries>& series) {
  std::vector<GridSeries> methods;
  for (const GridSeries& one : series) {
    if (variant_of_column(one.column).empty()) methods.push_back(one);
  }
  return methods;
}

Verdict verdict_on(const GridSeries& a, const GridSeries& b) {
  const auto side = [](const GridSeries& one) {
    return ScalarOfMethod{column_in_sentence(one.column), one.points.back().value,
                          one.points.back().error_bar, one.estimate, one.formal_order};
  };
  return verdict_on(side(a), side(b), scale_of({a, b}));
}

namespace {

/// Quantities that are unresolved for one reason.
struct Unresolved {
  std::string why;  ///< HTML
  std::vector<std::string> names;
};

/// Quantities by what refinement says of them.
struct AgreementOfStudy {
  std::vector<std::string> within, beyond;  ///< names
  std::vector<std::string> near, far;       ///< names of those without an order
  std::vector<Unresolved> unresolved;       ///< in the order of their first quantities
  size_t n_unresolved = 0;
  std::vector<std::string> causes;   ///< of those beyond, with names, HTML
  size_t n_first = 0, n_second = 0;  ///< of those judged: where that method has the narrower bar
  size_t n_judged() const { return within.size() + beyond.size(); }
  void leave(const std::string& name, const std::string& why) {
    ++n_unresolved;
    const auto same = std::find_if(unresolved.begin(), unresolved.end(),
                                   [&](const Unresolved& one) { return one.why == why; });
    if (same != unresolved.end()) {
      same->names.push_back(name);
    } else {
      unresolved.push_back({why, {name}});
    }
  }
};

AgreementOfStudy agreement_of(const StudyReport& study, const Pair& pair) {
  AgreementOfStudy agreement;
  for (const auto& [quantity, all] : study.quantities) {
    const std::vector<GridSeries> series = series_of_methods(all);
    if (series.size() != 2) continue;
    const bool same_order = series[0].column == pair.a().method;
    const GridPoint& a = series[same_order ? 0 : 1].points.back();
    const GridPoint& b = series[same_order ? 1 : 0].points.back();
    if (a.level != b.level || a.level == 0) continue;
    const Verdict verdict = verdict_on(series[same_order ? 0 : 1], series[same_order ? 1 : 0]);
    if (!verdict.why.empty()) {
      agreement.leave(quantity.first, escaped(verdict.why));
      if (verdict.agreement == Agreement::near) agreement.near.push_back(quantity.first);
      if (verdict.agreement == Agreement::far) agreement.far.push_back(quantity.first);
      continue;
    }
    const bool is_within = verdict.agreement == Agreement::agree;
    (is_within ? agreement.within : agreement.beyond).push_back(quantity.first);
    if (!is_within) {
      const auto cause = study.causes.find(quantity.first);
      agreement.causes.push_back(
          escaped(quantity.first + ": " +
                  (cause == study.causes.end() ? "the case does not say why" : cause->second)));
    }
    if (a.error_bar < b.error_bar) ++agreement.n_first;
    if (b.error_bar < a.error_bar) ++agreement.n_second;
  }
  return agreement;
}

/// Without an exact solution the widths of the error bars are what there is to say of errors.
std::string nearer_sentence(const AgreementOfStudy& agreement, const Pair& pair) {
  const size_t n = agreement.n_judged();
  if (agreement.n_first == agreement.n_second) {
    return fmt::format(
        "Neither method is nearer to convergence: on level {} each has the narrower error bar on "
        "{} of {} quantities (there is no exact solution to measure errors by).",
        pair.a().level, agreement.n_first, n);
  }
  const bool first = agreement.n_first > agreement.n_second;
  return fmt::format(
      "{} is nearer to convergence: on level {} it has the narrower error bar on {} of {} "
      "quantities (there is "
      "no exact solution to measure errors by).",
      at_the_start(column_in_sentence(first ? pair.a().method : pair.b().method)), pair.a().level,
      std::max(agreement.n_first, agreement.n_second), n);
}

/// How many are unresolved, which, and why, a reason once.
std::string unresolved_sentence(const AgreementOfStudy& agreement) {
  const size_t n = agreement.n_judged() + agreement.n_unresolved;
  if (agreement.n_unresolved == n && n > 1 && agreement.unresolved.size() == 1)
    return fmt::format("All {} quantities are unresolved: {}.", n, agreement.unresolved[0].why);
  std::string list;
  for (const Unresolved& one : agreement.unresolved)
    list += fmt::format("{}{} ({})", list.empty() ? "" : "; ", names_html(one.names), one.why);
  return fmt::format("{} of {} quantities {} unresolved: {}.", agreement.n_unresolved, n,
                     agreement.n_unresolved == 1 ? "is" : "are", list);
}

}  // namespace

std::vector<std::string> agreement_sentences(const StudyReport& study,
                                             const Pair& pair,
                                             bool has_errors) {
  const AgreementOfStudy agreement = agreement_of(study, pair);
  std::vector<std::string> sentences;
  const size_t n = agreement.n_judged(), n_within = agreement.within.size();
  if (n > 0 && n == n_within) {
    sentences.push_back(
        n == 1
            ? fmt::format("On {} they agree within their error bars.", names_html(agreement.within))
            : fmt::format("They agree within their error bars on all {} quantities.", n));
  } else if (n > 0) {
    sentences.push_back(
        fmt::format("They agree within their error bars on {} of {} quantities, but not on {}.",
                    n_within, n, names_html(agreement.beyond)));
  }
  if (!agreement.causes.empty())
    sentences.push_back(fmt::format("They are apart on {}.", fmt::join(agreement.causes, "; ")));
  if (n > 0 && !has_errors) sentences.insert(sentences.begin(), nearer_sentence(agreement, pair));
  if (!agreement.unresolved.empty()) {
    std::string sentence = unresolved_sentence(agreement);
    if (!agreement.near.empty()) {
      sentence += fmt::format(
          " Of these the methods are no further apart than three times what their levels change "
          "by, which is little, on {}.",
          names_html(agreement.near));
    }
    if (!agreement.far.empty()) {
      sentence += fmt::format(
          " They are further apart than that, although the levels change by little, on {}.",
          names_html(agreement.far));
    }
    sentences.insert(n > 0 ? sentences.end() : sentences.begin(), sentence);
  }
  return sentences;
}

}  // namespace diptych::report
