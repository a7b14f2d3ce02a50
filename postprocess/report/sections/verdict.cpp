/// What the study says, at the top of its page.

#include "postprocess/report/verdict.hpp"

#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

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

}  // namespace

std::string verdict_section(const StudyReport& study) {
  return section("verdict", "Verdict", sentences_html(study));
}

}  // namespace diptych::report
