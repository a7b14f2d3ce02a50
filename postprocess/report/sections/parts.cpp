#include "postprocess/report/sections/parts.hpp"

#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"

#include <fmt/format.h>
#include <map>

namespace diptych::report {

namespace {

constexpr int variant_looks = 3;  // of one method; later variants have the looks of the first ones

}  // namespace

std::string page_head(const std::string& title, const std::string& styles) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n",
      escaped(title), style_css, styles);
}

std::string page_scripts(const std::string& json,
                         const std::string& chart_script,
                         const std::string& page_script) {
  return "<noscript><p class=\"warning\">The charts need JavaScript; the tables do "
         "not.</p></noscript>\n<script type=\"application/json\" id=\"study\">" +
         json_safe(json) + "</script>\n<script>" + script_safe(chart_script) +
         "</script>\n<script>" + script_safe(page_script) + "</script>\n</body>\n</html>\n";
}

std::string plot_hint() {
  return "<p class=\"hint\" id=\"plot-hint\">Plots of curves: drag over a part to enlarge it, or "
         "spread two fingers, or click the plot and turn the wheel or press + − and the arrows. A "
         "double click, 0 or “Show all” goes back. A name in a legend hides its curve. “Save as "
         "SVG” "
         "gives what is seen as a file for a paper.</p>\n";
}

std::string section(std::string_view id, std::string_view heading, const std::string& body) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, heading, body);
}

std::string cell(const std::string& content) {
  return "<td>" + content + "</td>";
}
std::string heading_cell(const std::string& content) {
  return "<th scope=\"col\">" + content + "</th>";
}

std::string table(const std::string& head, const std::string& rows) {
  return fmt::format(
      "<div class=\"scroll\" "
      "tabindex=\"0\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n"
      "</table></div>\n",
      head, rows);
}

std::string field_heading(const std::string& field) {
  const std::string symbol = field_symbol(field);
  return symbol.empty() ? escaped(field_title(field)) : "<i>" + symbol + "</i>";
}

const io::ErrorNorms* norms_of(const io::RunSummary& run, const std::string& field) {
  const auto found = run.errors.find(field);
  return found == run.errors.end() ? nullptr : &found->second;
}

std::string column_classes(const std::string& classes, const std::string& column) {
  const std::string method = method_of_column(column);
  if (method == column) return fmt::format("class=\"{} {}\"", classes, escaped(column));
  return fmt::format("class=\"{} {}\" data-column=\"{}\"", classes, escaped(method),
                     escaped(column));
}

std::string variant_styles(const std::vector<std::string>& columns) {
  std::map<std::string, int> n_of_method;
  std::string rules;
  for (const std::string& column : columns) {
    const std::string method = method_of_column(column);
    if (method == column) continue;
    const int number = n_of_method[method]++ % variant_looks + 1;
    rules += fmt::format(
        "[data-column=\"{0}\"] {{ --own: var(--{1}-{2}); }}\n"
        ".mark[data-column=\"{0}\"] {{ clip-path: var(--shape-{1}-{2}); }}\n",
        escaped(column), escaped(method), number);
  }
  return rules;
}

std::string column_mark(const std::string& column) {
  return fmt::format("<span {}></span>{}", column_classes("mark", column),
                     escaped(column_title(column)));
}

std::string run_head(const io::RunSummary& run) {
  return fmt::format("<th scope=\"row\">{}<span class=\"level\">level {}</span></th>",
                     column_mark(run.column()), run.level);
}

std::string chart(std::string_view id,
                  std::string_view spoken,
                  std::string_view caption,
                  bool low) {
  return fmt::format(
      "<figure>\n<div class=\"plot{}\"><canvas id=\"{}\" role=\"img\" "
      "aria-label=\"{}\"></canvas></div>\n"
      "<figcaption id=\"{}-caption\">{}</figcaption>\n</figure>\n",
      low ? " low" : "", id, spoken, id, caption);
}

std::string field_choice(const std::string& group, const std::vector<std::string>& fields) {
  std::string html =
      fmt::format("<fieldset class=\"choice\" data-chart=\"{}\">\n<legend>Field</legend>\n", group);
  for (size_t i = 0; i < fields.size(); ++i) {
    html += fmt::format(
        "<label><input type=\"radio\" name=\"{}-field\" value=\"{}\"{}><span>{} "
        "<i>{}</i></span></label>\n",
        group, escaped(fields[i]), i == 0 ? " checked" : "", escaped(field_title(fields[i])),
        escaped(field_symbol(fields[i])));
  }
  return html + "</fieldset>\n";
}

}  // namespace diptych::report
