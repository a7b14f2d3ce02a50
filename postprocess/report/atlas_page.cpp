#include "postprocess/report/atlas_page.hpp"

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::report {
namespace {

constexpr int least_width = 34, most_width = 96, cell_height = 26, line_height = 18;
constexpr double letter_width = 7.2;  // of the labels, at 13 px

/// What stands in a cell besides its colour.
const char* letter_of(const std::string& state) {
  if (state == "stopped") return "S";
  if (state == "wrong") return "W";
  if (state == "refused") return "–";
  if (state == "unfinished") return "U";
  return "";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

int label_width(const AtlasPicture& picture) {
  size_t longest = picture.row_axes.size();
  for (const auto& row : picture.rows)
    longest = std::max(longest, joined(row).size());
  return static_cast<int>(letter_width * static_cast<double>(longest)) + 14;
}

/// Of a column: as wide as the names right above the cells, within reason.
int width_of_cells(const AtlasPicture& picture) {
  size_t longest = 0;
  for (const auto& column : picture.columns)
    longest = std::max(longest, column.empty() ? 0 : column.back().size());
  return std::clamp(static_cast<int>(letter_width * static_cast<double>(longest)) + 8, least_width,
                    most_width);
}

/// Names of the columns, a line for each axis; a name that stays stands once over its columns, cut
/// to their width, and the columns' titles have it whole.
std::string column_labels(const AtlasPicture& picture, int left) {
  const int cell_width = width_of_cells(picture);
  std::string svg;
  const size_t n_axes = picture.columns.empty() ? 0 : picture.columns.front().size();
  for (size_t axis = 0; axis < n_axes; ++axis) {
    for (size_t first = 0; first < picture.columns.size();) {
      const auto is_same = [&](size_t column) {
        return std::equal(picture.columns[first].begin(),
                          picture.columns[first].begin() + static_cast<std::ptrdiff_t>(axis) + 1,
                          picture.columns[column].begin());
      };
      size_t last = first;
      while (last + 1 < picture.columns.size() && is_same(last + 1))
        ++last;
      const std::string& name = picture.columns[first][axis];
      const double width = static_cast<double>(cell_width) * static_cast<double>(last - first + 1);
      const auto fit = static_cast<size_t>(width / letter_width);
      const std::string shown = name.size() <= fit ? name : name.substr(0, fit - 1) + "…";
      svg += fmt::format(
          "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}<title>{}</title></text>\n",
          left + static_cast<double>(cell_width) * static_cast<double>(first) + width / 2,
          line_height * static_cast<int>(axis + 2) - 5, escaped(shown), escaped(name));
      first = last + 1;
    }
  }
  return svg;
}

std::string cell_svg(
    const AtlasCell& cell, const std::string& place, int x, int y, int cell_width) {
  if (cell.state.empty()) return "";
  std::string spoken = place + ": " + cell.state;
  if (!cell.reason.empty()) spoken += ": " + cell.reason;
  if (!cell.before.empty()) spoken += " (before: " + cell.before + ")";
  std::string svg = fmt::format(
      "<g><title>{}</title><rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
      escaped(spoken), escaped(cell.state), x + 1, y + 1, cell_width - 2, cell_height - 2);
  if (!cell.before.empty() && cell.before != cell.state)
    svg += fmt::format("<path class=\"{} before\" d=\"M{} {}h11l-11 11z\"/>", escaped(cell.before),
                       x + 1, y + 1);
  return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text></g>\n",
                           x + cell_width / 2, y + cell_height / 2 + 5, letter_of(cell.state));
}

std::string svg_of(const AtlasPicture& picture) {
  const int left = label_width(picture), cell_width = width_of_cells(picture);
  const size_t n_axes = picture.columns.empty() ? 0 : picture.columns.front().size();
  const int top = line_height * static_cast<int>(n_axes + 1) + 4;
  const int width = left + cell_width * static_cast<int>(picture.columns.size()) + 2;
  const int height = top + cell_height * static_cast<int>(picture.rows.size()) + 2;
  std::string svg = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><svg class=\"atlas\" role=\"img\" aria-label=\"Map of "
      "{}\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n",
      escaped(method_title(picture.method)), width, height, width, height);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" class=\"axis\">{}</text>\n", left, line_height - 5,
                     escaped(picture.column_axes));
  svg += fmt::format("<text x=\"0\" y=\"{}\" class=\"axis\">{}</text>\n", top - 9,
                     escaped(picture.row_axes));
  svg += column_labels(picture, left);
  for (size_t row = 0; row < picture.rows.size(); ++row) {
    const int y = top + cell_height * static_cast<int>(row);
    svg += fmt::format("<text x=\"0\" y=\"{}\">{}</text>\n", y + cell_height / 2 + 5,
                       escaped(joined(picture.rows[row])));
    for (size_t column = 0; column < picture.columns.size(); ++column) {
      svg += cell_svg(picture.cells[row][column],
                      joined(picture.rows[row]) + ", " + joined(picture.columns[column]),
                      left + cell_width * static_cast<int>(column), y, cell_width);
    }
  }
  return svg + "</svg></div>\n";
}

std::string reasons_of(const AtlasPicture& picture) {
  std::string head = heading_cell(escaped(picture.row_axes)), rows;
  for (const auto& column : picture.columns)
    head += heading_cell(escaped(joined(column)));
  for (size_t row = 0; row < picture.rows.size(); ++row) {
    rows += "<tr><th scope=\"row\">" + escaped(joined(picture.rows[row])) + "</th>";
    for (const AtlasCell& one : picture.cells[row]) {
      std::string text = escaped(one.state);
      if (!one.reason.empty()) text += ": " + escaped(one.reason);
      if (!one.before.empty() && one.before != one.state)
        text += " <small>(before: " + escaped(one.before) + ")</small>";
      rows += fmt::format("<td class=\"{}\">{}</td>", escaped(one.state), text);
    }
    rows += "</tr>\n";
  }
  return table(head, rows);
}

/// What the colours and letters mean.
std::string legend() {
  std::string text = "<ul class=\"atlas-legend\">\n";
  for (const auto& [state, meaning] :
       {std::pair("stable", "stable: came to its end, whole"),
        std::pair("stopped", "S stopped by the program (code 3)"),
        std::pair("wrong", "W wrong: came to its end, and is no solution"),
        std::pair("refused", "– refused: could not be begun (code 2)"),
        std::pair("unfinished", "U unfinished: its step limit ended it before its end")})
    text += fmt::format("<li><span class=\"{}\"></span>{}</li>\n", state, meaning);
  return text + "</ul>\n";
}

}  // namespace

std::string atlas_page(const std::string& title,
                       const std::string& lead,
                       const std::string& verdict,
                       const std::vector<AtlasPicture>& pictures,
                       const std::string& text) {
  std::string html = page_head(title);
  html += fmt::format(
      "<header>\n<p class=\"kicker\">Diptych</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n"
      "</header>\n<main>\n",
      escaped(title), escaped(lead));
  html += section("verdict", "Verdict", "<p class=\"verdict\">" + verdict + "</p>\n");
  std::string maps = legend(), reasons;
  for (const AtlasPicture& picture : pictures) {
    const std::string heading = "<h3>" + column_mark(picture.method) + "</h3>\n";
    maps += heading + svg_of(picture);
    reasons += heading + reasons_of(picture);
  }
  html += section("maps", "Maps", maps);
  html += section("reasons", "Reasons", reasons);
  html += section("causes", "Counts and causes",
                  "<div class=\"scroll\" tabindex=\"0\"><pre>" + escaped(text) + "</pre></div>\n");
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace diptych::report
