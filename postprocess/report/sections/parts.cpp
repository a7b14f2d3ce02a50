#include "postprocess/report/sections/parts.hpp"

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"

#include <fmt/format.h>

namespace diptych::report {

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

std::string method_mark(const std::string& method) {
  return fmt::format("<span class=\"mark {0}\"></span>{1}", escaped(method),
                     escaped(method_title(method)));
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
