#include "postprocess/report/curve_page.hpp"

#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace diptych::report {
namespace {

using Json = nlohmann::ordered_json;

/// The points of a curve that are drawn.
std::vector<std::pair<double, double>> points_of(const Panel& panel, const Curve& curve) {
  std::vector<std::pair<double, double>> points;
  for (size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    const double x = curve.x[i], y = curve.y[i];
    const bool has_logarithms = x > 0 && y > 0;
    if (std::isfinite(x) && std::isfinite(y) && (has_logarithms || !panel.logarithmic))
      points.emplace_back(x, y);
  }
  if (!panel.logarithmic) std::sort(points.begin(), points.end());
  return points;
}

bool spans_decades(const Panel& panel) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Curve& curve : panel.curves) {
    for (const auto& [x, y] : points_of(panel, curve)) {
      least = std::min(least, x);
      most = std::max(most, x);
    }
  }
  return least > 0 && most > 20 * least;
}

std::string panels_json(const std::vector<Panel>& panels) {
  Json all = Json::array();
  for (const Panel& panel : panels) {
    Json curves = Json::array();
    for (const Curve& curve : panel.curves) {
      Json points = Json::array();
      for (const auto& [x, y] : points_of(panel, curve))
        points.push_back({{"x", x}, {"y", y}});
      curves.push_back({{"name", curve.name}, {"points", points}});
    }
    all.push_back({{"x", panel.x_label},
                   {"y", panel.y_label},
                   {"logarithmic", panel.logarithmic || spans_decades(panel)},
                   {"curves", curves},
                   {"logarithmic_y", panel.logarithmic},
                   {"title", panel.title}});
  }
  return Json{{"panels", all}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string curve_page(const std::string& title,
                       const std::string& lead,
                       const std::string& verdict,
                       const std::vector<Panel>& panels,
                       const std::string& table,
                       const std::string& chart_script) {
  std::string plots;
  for (size_t k = 0; k < panels.size(); ++k) {
    plots += fmt::format("<h3>{}</h3>\n{}", escaped(panels[k].title),
                         chart(fmt::format("panel-{}", k), escaped(panels[k].title), ""));
  }
  std::string html = page_head(title);
  html += fmt::format(
      "<header>\n<p class=\"kicker\">Diptych</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}"
      "</header>\n<main>\n",
      escaped(title), escaped(lead), plot_hint());
  if (!verdict.empty())
    html += section("verdict", "Verdict", "<p class=\"verdict\">" + verdict + "</p>\n");
  return html + section("plots", "Plots", plots) +
         section("table", "Table",
                 "<div class=\"scroll\" tabindex=\"0\"><pre>" + escaped(table) + "</pre></div>\n") +
         "</main>\n" + page_scripts(panels_json(panels), chart_script, curve_page_js);
}

}  // namespace diptych::report
