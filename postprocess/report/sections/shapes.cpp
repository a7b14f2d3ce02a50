/// The deformed body of each method, and where the two are apart. Drawn by scripts/shapes.js.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <fmt/format.h>

namespace diptych::report {
namespace {

/// A picture, its scale of colours and a line for what is under the pointer.
std::string picture(const std::string& name, std::string_view spoken) {
  return fmt::format(
      "<div class=\"shape\"><canvas id=\"shape-{0}\" role=\"img\" aria-label=\"{1}\" "
      "data-shape=\"{0}\"></canvas></div>\n"
      "<div class=\"scale\" data-shape=\"{0}\"></div>\n"
      "<p class=\"reading\" data-shape=\"{0}\"></p>\n",
      name, spoken);
}

std::string controls(const ShapeRecord& record) {
  std::string html = "<fieldset class=\"shape-field choice\">\n<legend>Colour</legend>\n";
  for (size_t f = 0; f < record.fields.size(); ++f) {
    html += fmt::format(
        "<label><input type=\"radio\" name=\"shape-field\" value=\"{}\"{}><span>{}</span></label>"
        "\n",
        f, f == 0 ? " checked" : "", escaped(record.fields[f].name));
  }
  return html +
         "</fieldset>\n<div class=\"player\"><button type=\"button\" id=\"shape-play\">Play"
         "</button><input type=\"range\" id=\"shape-frame\" min=\"0\" value=\"0\" step=\"1\" "
         "aria-label=\"Output time\"><output id=\"shape-time\"></output></div>\n";
}

/// What of the run is in the pictures, where it is not everything.
std::string extent(const ShapeRecord& record, size_t n_frames) {
  std::string note;
  const size_t n_points = record.surface.nodes.size();
  if (n_points < record.surface.n_points_of_mesh) {
    note += fmt::format(" To keep the file small it is drawn on {} of its {} nodes.",
                        count_html(static_cast<std::int64_t>(n_points)),
                        count_html(static_cast<std::int64_t>(record.surface.n_points_of_mesh)));
  }
  if (n_frames < record.n_outputs) {
    note += fmt::format(" {} of the {} output times are kept.", n_frames, record.n_outputs);
  }
  return note;
}

}  // namespace

std::string shapes_section(const StudyReport& study) {
  const size_t n_frames = n_common_frames(study.shapes);
  if (n_frames == 0) return "";
  const ShapeRecord& first = study.shapes.begin()->second;
  std::string pictures;
  for (const std::string& method : methods_of(study.runs)) {
    if (study.shapes.count(method) == 0) continue;
    pictures += fmt::format("<div>\n<h3>{}</h3>\n{}</div>\n", column_mark(method),
                            picture(escaped(method), "Deformed body, coloured by a field"));
  }
  const bool is_solid = first.surface.dimension == 3;
  std::string html = fmt::format(
      "<p>{} on the finest level at its true size, {}on one scale of colours for all "
      "times.{}{}</p>\n",
      is_solid ? "Surface of the body" : "The body", study.shapes.size() > 1 ? "both methods " : "",
      is_solid ? " Drag to turn it." : "", extent(first, n_frames));
  html += controls(first) + "<div class=\"pair\">\n" + pictures + "</div>\n";
  if (study.shapes.size() == 2) {
    html += fmt::format(
        "<h3>Where the two methods differ</h3>\n<p>Distance between the places of a node in the "
        "two runs, |<i>u</i><sub>SPH</sub> − <i>u</i><sub>FV</sub>|, on the shape of {}.</p>\n"
        "<div class=\"alone\">\n{}</div>\n",
        escaped(method_title(methods_of(study.runs).front())),
        picture("difference", "Deformed body, coloured by the distance of the methods"));
  }
  return section("shapes", "The body over time", html);
}

}  // namespace diptych::report
