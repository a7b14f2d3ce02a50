#include "postprocess/report/curve_page.hpp"

#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych::report {
namespace {

using Json = nlohmann::ordered_json;

std::string panels_json(const std::vector<Panel>& panels) {
  Json all = Json::array();
  for (const Panel& panel : panels) {
    Json curves = Json::array();
    for (const Curve& curve : panel.curves) {
      Json points = Json::array();
      for (size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]) && curve.x[i] > 0 &&
            curve.y[i] > 0)
          points.push_back({{"x", curve.x[i]}, {"y", curve.y[i]}});
      }
      curves.push_back({{"name", curve.name}, {"points", points}});
    }
    all.push_back(
        {{"title", panel.title}, {"x", panel.x_label}, {"y", panel.y_label}, {"curves", curves}});
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
  std::string html = page_head(title);
  html += fmt::format(
      "<header>\n<p class=\"kicker\">Diptych</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}"
      "</header>\n<main>\n",
      escaped(title), escaped(lead), plot_hint());
  if (!verdict.empty())
    html += section("verdict", "Verdict", "<p class=\"verdict\">" + verdict + "</p>\n");
  html += "<section>\n";
  for (size_t k = 0; k < panels.size(); ++k) {
    html += fmt::format("<h2>{}</h2>\n{}", escaped(panels[k].title),
                        chart(fmt::format("panel-{}", k), escaped(panels[k].title), ""));
  }
  html += fmt::format(
      "</section>\n<section>\n<h2>The numbers</h2>\n<div class=\"scroll\" "
      "tabindex=\"0\"><pre>{}</pre></div>\n</section>\n"
      "</main>\n",
      escaped(table));
  return html + page_scripts(panels_json(panels), chart_script, curve_page_js);
}

}  // namespace diptych::report
