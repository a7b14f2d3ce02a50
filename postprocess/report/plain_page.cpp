#include "postprocess/report/plain_page.hpp"

#include "postprocess/report/assets.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/line_plot.hpp"

#include <fmt/format.h>

namespace diptych::report {

std::string plain_page(const std::string& title,
                       const std::string& lead,
                       const std::string& svg,
                       const std::vector<std::string>& legend,
                       const std::string& table) {
  std::string names;
  for (size_t i = 0; i < legend.size(); ++i) {
    names += fmt::format("<li><span style=\"color:{}\">&#9632;</span> {}</li>\n", curve_colour(i),
                         escaped(legend[i]));
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{0}</title>\n<style>\n{1}\nfigure svg{{max-width:100%;height:auto}}"
      "figure ul{{list-style:none;padding:0}}</style>\n</head>\n<body>\n"
      "<header>\n<p class=\"kicker\">Diptych</p>\n<h1>{0}</h1>\n<p class=\"lead\">{2}</p>\n"
      "</header>\n<main>\n<section>\n<figure>\n{3}<ul>\n{4}</ul>\n</figure>\n"
      "<div class=\"scroll\" tabindex=\"0\"><pre>{5}</pre></div>\n</section>\n</main>\n</body>\n"
      "</html>\n",
      escaped(title), style_css, escaped(lead), svg, names, escaped(table));
}

}  // namespace diptych::report
