#include "postprocess/report/verdict.hpp"

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/price.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace diptych::report {
namespace {

using io::RunSummary;
using Sentences = std::vector<std::string>;

constexpr double alike = 0.95;  // smaller over larger: no difference that a reader should act on

/// Runs of one method that came to their end, coarse to fine.
std::vector<RunSummary> finished(const StudyReport& study, const std::string& method) {
  std::vector<RunSummary> runs = runs_of(study.runs, method);
  runs.erase(std::remove_if(runs.begin(), runs.end(),
                            [](const RunSummary& run) { return !run.is_ended(); }),
             runs.end());
  return runs;
}

std::optional<Pair> pair_of(const StudyReport& study) {
  const auto methods = methods_of(study.runs);
  if (methods.size() != 2) return std::nullopt;
  Pair pair{finished(study, methods[0]), finished(study, methods[1])};
  while (!pair.first.empty() && !pair.second.empty() && pair.a().level != pair.b().level)
    (pair.a().level > pair.b().level ? pair.first : pair.second).pop_back();
  if (pair.first.empty() || pair.second.empty()) return std::nullopt;
  return pair;
}

std::string seconds_html(double seconds) {
  return number_html(seconds) + " s";
}

std::string breakdown_sentence(const Breakdown& one) {
  std::string where = fmt::format("at t = {} s, in step {}", number_html(one.time), one.step);
  if (one.node >= 0) where += fmt::format(" at node {}", one.node);
  if (one.place) {
    const auto& X = *one.place;
    where += fmt::format(", ({:.5g}, {:.5g}, {:.5g}) m", X[0], X[1], X[2]);
  }
  return fmt::format("{} broke down on level {} {}: {}.",
                     at_the_start(column_in_sentence(one.column)), one.level, where,
                     escaped(one.message.substr(0, one.message.find('\n'))));
}

/// What the same error costs, or where only one level was run, what the runs cost.
std::string cost_sentence(const Pair& pair, const std::string& field) {
  const std::string a = column_in_sentence(pair.a().method),
                    b = column_in_sentence(pair.b().method);
  const auto price = price_of_error(pair.first, pair.second, field);
  double first = pair.a().loop_seconds, second = pair.b().loop_seconds;
  if (price) first = price->first, second = price->second;
  if (!(first > 0 && second > 0)) return "";
  const bool first_is_dear = first >= second;
  const std::string& dear = first_is_dear ? a : b;
  const std::string& cheap = first_is_dear ? b : a;
  const std::string seconds = fmt::format(" ({} against {})", seconds_html(std::max(first, second)),
                                          seconds_html(std::min(first, second)));
  const std::string when = price
                               ? fmt::format("for the same error, {}, ", percent_html(price->error))
                               : std::string("on the same nodes ");
  if (std::min(first, second) > alike * std::max(first, second))
    return at_the_start(when + "both take the same time" + seconds + ".");
  return at_the_start(fmt::format("{}{} takes {} times the seconds of {}{}.", when, dear,
                                  number_html(std::max(first, second) / std::min(first, second)),
                                  cheap, seconds));
}

bool are_alike(double a, double b) {
  return std::min(a, b) > alike * std::max(a, b);
}

/// "finite volume errs less, by up to 6.8 times (stress)": where that run errs less, of the field
/// in which it does most; empty where it nowhere does.
std::string lead_of(const RunSummary& less,
                    const RunSummary& more,
                    const std::vector<std::string>& fields) {
  const auto ratio = [&](const std::string& field) {
    const double times = error_of(more, field) / error_of(less, field);
    return std::isfinite(times) ? times : 1;  // neither errs
  };
  const auto most = std::max_element(
      fields.begin(), fields.end(),
      [&](const auto& one, const auto& other) { return ratio(one) < ratio(other); });
  if (!(ratio(*most) * alike > 1)) return "";
  return fmt::format("{} errs less, by up to {} times ({})", column_in_sentence(less.method),
                     number_html(ratio(*most)), escaped(field_title(*most)));
}

/// Of methods whose errors of the first field are alike; those of others need not be.
std::string alike_sentence(const Pair& pair, const std::vector<std::string>& fields) {
  const RunSummary &a = pair.a(), &b = pair.b();
  const std::string& first = fields.front();
  const std::string name = escaped(field_title(first)), of_a = percent_html(error_of(a, first)),
                    of_b = percent_html(error_of(b, first));
  std::vector<std::string> leads;
  for (const std::string& lead : {lead_of(a, b, fields), lead_of(b, a, fields)})
    if (!lead.empty()) leads.push_back(lead);
  if (leads.empty()) {
    return fmt::format("On level {} both err alike: their {} is off by {} and {}.", a.level, name,
                       of_a, of_b);
  }
  return fmt::format("On level {} the {} of both is off alike, by {} and {}; in other fields {}.",
                     a.level, name, of_a, of_b, fmt::join(leads, ", and "));
}

/// Which method errs less, measured against the exact solution.
std::string error_sentence(const Pair& pair, const std::vector<std::string>& fields) {
  const std::string& field = fields.front();
  const double a = error_of(pair.a(), field), b = error_of(pair.b(), field);
  const RunSummary& better = a <= b ? pair.a() : pair.b();
  const RunSummary& worse = a <= b ? pair.b() : pair.a();
  const std::string name = escaped(field_title(field));
  if (are_alike(a, b)) return alike_sentence(pair, fields);
  const auto n_less = std::count_if(fields.begin(), fields.end(), [&](const std::string& one) {
    return error_of(better, one) < error_of(worse, one);
  });
  std::string others;
  if (fields.size() > 1 && n_less == static_cast<std::ptrdiff_t>(fields.size()))
    others = ", and it errs less in every other field too";
  else if (fields.size() > 1)
    others = fmt::format("; of the {} fields it errs less in {}", fields.size(), n_less);
  return fmt::format("{} errs less: on level {} its {} is off by {}, that of {} by {}{}.",
                     at_the_start(column_in_sentence(better.method)), better.level, name,
                     percent_html(error_of(better, field)), column_in_sentence(worse.method),
                     percent_html(error_of(worse, field)), others);
}

/// The field in which the methods are furthest apart, of those of the motion where they are known.
std::pair<std::string, double> furthest_apart(const StudyReport& study) {
  std::pair<std::string, double> furthest{"", -1};
  for (const bool of_motion : {true, false}) {
    for (const auto& [field, apart] : study.differences) {
      const bool is_motion = field == "velocity" || field == "displacement";
      if (is_motion == of_motion && apart > furthest.second) furthest = {field, apart};
    }
    if (furthest.second >= 0) break;
  }
  return furthest;
}

Sentences pair_sentences(const StudyReport& study, const Pair& pair) {
  const std::vector<std::string> fields = pair.fields();
  const auto [field, apart] = furthest_apart(study);
  const std::string field_html = escaped(field_title(field));
  Sentences sentences;
  if (apart > too_far_apart) {
    sentences.push_back(fmt::format(
        "Too coarse to say: on level {} the two methods end {} of the largest {} apart, more than "
        "half. Refine before you trust either.",
        pair.a().level, percent_html(apart), field_html));
  }
  if (!fields.empty()) {
    const double least =
        std::min(error_of(pair.a(), fields.front()), error_of(pair.b(), fields.front()));
    if (least > too_far_apart && apart <= too_far_apart) {
      sentences.push_back(
          fmt::format("Too coarse to say: on level {} both miss more than half of the {}.",
                      pair.a().level, escaped(field_title(fields.front()))));
    }
    sentences.push_back(error_sentence(pair, fields));
  }
  Sentences agreement = agreement_sentences(study, pair, !fields.empty());
  const bool is_silent = fields.empty() && agreement.empty();  // nothing that tells them from truth
  if (fields.empty() && !agreement.empty()) {
    sentences.push_back(agreement.front());
    agreement.erase(agreement.begin());
  }
  std::string distance;
  if (apart >= 0 && apart <= too_far_apart) {
    distance = fmt::format("At the end the two methods are {} of the largest {} apart.",
                           percent_html(apart), field_html);
  }
  if (is_silent && !distance.empty()) sentences.push_back(distance);
  const std::string cost = cost_sentence(pair, fields.empty() ? "" : fields.front());
  if (!cost.empty()) sentences.push_back(cost);
  if (is_silent) {
    sentences.push_back(
        "One level without an exact solution does not say which of them errs less; "
        "<code>converge</code> gives both an error bar.");
  } else if (!distance.empty()) {
    sentences.push_back(distance);
  }
  sentences.insert(sentences.end(), agreement.begin(), agreement.end());
  return sentences;
}

Sentences single_sentences(const StudyReport& study, const std::vector<RunSummary>& runs) {
  const RunSummary& finest = runs.back();
  const std::string method = at_the_start(column_in_sentence(finest.method));
  Sentences sentences;
  const auto fields = fields_of({finest});
  if (!fields.empty() && std::isfinite(error_of(finest, fields.front()))) {
    const std::string& field = fields.front();
    const double error = error_of(finest, field);
    std::string order;
    if (runs.size() > 1) {
      const RunSummary& coarse = runs[runs.size() - 2];
      const double p =
          observed_order(error_of(coarse, field), error, coarse.spacing, finest.spacing);
      if (std::isfinite(p)) order = fmt::format(" and falls with order {:.1f}", p);
    }
    if (error > too_far_apart)
      sentences.push_back(fmt::format("Too coarse to say: {} misses more than half of the {}.",
                                      column_in_sentence(finest.method),
                                      escaped(field_title(field))));
    sentences.push_back(
        fmt::format("{} on level {}: the error of its {} is {}{}, for {} in the time loop.", method,
                    finest.level, escaped(field_title(field)), percent_html(error), order,
                    seconds_html(finest.loop_seconds)));
  } else {
    sentences.push_back(fmt::format("{} on level {} took {} in the time loop.", method,
                                    finest.level, seconds_html(finest.loop_seconds)));
  }
  std::vector<std::string> sure, unsure;
  for (const auto& [quantity, series] : study.quantities) {
    const auto one = std::find_if(series.begin(), series.end(), [&](const GridSeries& s) {
      return s.column == finest.method && s.points.back().error_bar > 0;
    });
    if (one == series.end()) continue;
    const double scale = scale_of({*one});
    (one->points.back().error_bar > too_far_apart * scale ? unsure : sure)
        .push_back(quantity.first);
  }
  if (!unsure.empty())
    sentences.push_back(
        fmt::format("Too coarse to say of {}: the error bar is more than half of the scale.",
                    names_html(unsure)));
  else if (!sure.empty())
    sentences.push_back(fmt::format("Refinement gives an error bar to {} {}.", sure.size(),
                                    sure.size() == 1 ? "quantity" : "quantities"));
  return sentences;
}

/// What a reader must know before the rest: runs without an end, bodies that are none any more.
Sentences warnings(const StudyReport& study) {
  Sentences sentences;
  for (const Breakdown& one : study.breakdowns)
    sentences.push_back(breakdown_sentence(one));
  for (const std::string& column : columns_of(study.runs)) {
    const RunSummary run = runs_of(study.runs, column).back();
    const std::string name = at_the_start(column_in_sentence(column));
    const bool is_told = std::any_of(study.breakdowns.begin(), study.breakdowns.end(),
                                     [&](const Breakdown& one) { return one.column == column; });
    if (!run.is_ended() && !is_told)
      sentences.push_back(fmt::format("{} did not come to its end on level {}: {}.", name,
                                      run.level, escaped(run.status)));
    if (!run.unmet.empty())
      sentences.push_back(fmt::format("{} does not hold what the case asks on level {}: {}.", name,
                                      run.level, escaped(run.unmet)));
    if (run.inverted_from)
      sentences.push_back(
          fmt::format("Cells of {} lie inside out from t = {} s on: what comes after "
                      "is not a body any more.",
                      column_in_sentence(column), number_html(*run.inverted_from)));
  }
  return sentences;
}

}  // namespace

std::string names_html(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    text += i == 0 ? "" : i + 1 == names.size() ? " and " : ", ";
    text += escaped(names[i]);
  }
  return text;
}

std::vector<std::string> Pair::fields() const {
  std::vector<std::string> common;
  for (const std::string& field : fields_of({a(), b()})) {
    if (std::isfinite(error_of(a(), field)) && std::isfinite(error_of(b(), field)))
      common.push_back(field);
  }
  return common;
}

std::string percent_html(double part) {
  if (!std::isfinite(part)) return "n/a";
  return std::abs(part) >= 1e-5 || part == 0 ? number_html(100 * part) + " %"
                                             : scientific_html(part);
}

std::string column_in_sentence(const std::string& column) {
  std::string title = column_title(column);
  if (method_of_column(column) == "fvm") title[0] = 'f';
  return escaped(title);
}

std::string at_the_start(std::string sentence) {
  if (!sentence.empty())
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

std::vector<std::string> verdict(const StudyReport& study) {
  Sentences sentences = warnings(study);
  Sentences more;
  if (const auto pair = pair_of(study)) {
    more = pair_sentences(study, *pair);
  } else {
    for (const std::string& method : methods_of(study.runs)) {
      const auto runs = finished(study, method);
      if (runs.empty()) continue;
      const Sentences one = single_sentences(study, runs);
      more.insert(more.end(), one.begin(), one.end());
    }
  }
  sentences.insert(sentences.end(), more.begin(), more.end());
  if (sentences.empty())
    sentences.emplace_back("No run has come to its end: there is nothing to say.");
  return sentences;
}

}  // namespace diptych::report
