/// What the study says, at the top of its page, and the bounds that it was asked to meet.

#include "postprocess/report/verdict.hpp"

#include "postprocess/report/html.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::report {
namespace {

/// What broke down and two sentences in large letters, the others below them.
std::string sentences_html(const StudyReport& study) {
  const std::vector<std::string> sentences = verdict(study);
  const size_t n_broken = study.breakdowns.size();
  std::string broken, large, small;
  for (size_t i = 0; i < sentences.size(); ++i) {
    std::string& text = i < n_broken ? broken : i < n_broken + 2 ? large : small;
    text += (text.empty() ? "" : " ") + sentences[i];
  }
  std::string html;
  if (!broken.empty()) html += "<p class=\"verdict missed\">" + broken + "</p>\n";
  if (!large.empty()) html += "<p class=\"verdict\">" + large + "</p>\n";
  return html + (small.empty() ? "" : "<p>" + small + "</p>\n");
}

std::string bounds_html(const StudyReport& study) {
  const auto n_passed = std::count_if(study.acceptance.begin(), study.acceptance.end(),
                                      [](const AcceptanceLine& line) { return line.passed; });
  const auto n_all = static_cast<std::ptrdiff_t>(study.acceptance.size());
  if (n_all == 0) return "";
  const std::string sentence =
      n_passed == n_all
          ? (n_all == 1 ? "The bound is met" : fmt::format("All {} bounds are met", n_all))
          : fmt::format("{} of {} bounds not met", n_all - n_passed, n_all);
  std::string rows;
  for (const AcceptanceLine& line : study.acceptance) {
    rows += fmt::format(
        "<tr class=\"{}\"><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td "
        "class=\"outcome\">{}</td></tr>\n",
        line.passed ? "met" : "missed", escaped(line.name), escaped(line.asked),
        escaped(line.measured), line.passed ? "✓ met" : "✗ not met");
  }
  return fmt::format("<div id=\"bounds\">\n<p class=\"verdict {}\">{} {}</p>\n{}</div>\n",
                     n_passed == n_all ? "met" : "missed", n_passed == n_all ? "✓" : "✗", sentence,
                     table(heading_cell("bound") + heading_cell("asked") +
                               heading_cell("measured") + heading_cell("outcome"),
                           rows));
}

}  // namespace

std::string verdict_section(const StudyReport& study) {
  return section("verdict", "Verdict", sentences_html(study) + bounds_html(study));
}

}  // namespace diptych::report
