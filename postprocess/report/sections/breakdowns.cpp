/// Runs that broke down, before anything else on the page.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"

#include <fmt/format.h>

namespace diptych::report {

std::string breakdowns_section(const StudyReport& study) {
  std::string lines;
  for (const Breakdown& one : study.breakdowns) {
    std::string where;
    if (one.node >= 0) where = fmt::format(" at node {}", one.node);
    if (one.place) {
      const auto& X = *one.place;
      where += fmt::format(", ({:.6g}, {:.6g}, {:.6g}) m", X[0], X[1], X[2]);
    }
    const std::string what = one.message.substr(0, one.message.find('\n'));
    lines += fmt::format(
        "<p class=\"warning\">{} broke down on level {} at t = {:.6g} s, in step {}{}: {}. Nothing "
        "of that run is on this page.</p>\n",
        escaped(method_title(one.method)), one.level, one.time, one.step, where, escaped(what));
  }
  return lines;
}

}  // namespace diptych::report
