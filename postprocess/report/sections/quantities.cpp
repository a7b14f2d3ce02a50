/// Scalars against the spacing, with the error bars of the grid convergence index.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"
#include "postprocess/report/verdict.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::report {
namespace {

std::string titled(const std::pair<std::string, std::string>& quantity) {
  return escaped(quantity.first) +
         (quantity.second == "-" ? "" : " [" + escaped(quantity.second) + "]");
}

/// Of the finest values of the two methods.
std::string agreement(const std::vector<GridSeries>& all) {
  const std::vector<GridSeries> series = series_of_methods(all);
  if (series.size() != 2) return "";
  const Verdict verdict = verdict_on(series[0], series[1]);
  return verdict.agreement == Agreement::apart ? "apart" : escaped(verdict_text(verdict));
}

std::string rows_of(const std::pair<std::string, std::string>& quantity,
                    const std::vector<GridSeries>& series) {
  std::string rows;
  const std::vector<GridSeries> methods = series_of_methods(series);
  const std::string last = methods.empty() ? "" : methods.back().column;
  for (const GridSeries& one : series) {
    const GridPoint& finest = one.points.back();
    const auto& e = one.estimate;
    const bool has_order = e && std::isfinite(e->order);
    rows += "<tr><th scope=\"row\">" + titled(quantity) + "</th>" + cell(column_mark(one.column)) +
            cell(precise_html(finest.value)) +
            cell(finest.error_bar > 0 ? "± " + number_html(finest.error_bar) : "") +
            cell(e && std::isfinite(e->extrapolated) ? precise_html(e->extrapolated) : "") +
            cell(has_order ? fmt::format("{:.2f}", e->order) : "") +
            cell(e                        ? convergence_name(e->kind)
                 : one.points.size() == 2 ? "two grids"
                                          : "") +
            cell(one.column == last ? agreement(series) : "") + "</tr>\n";
  }
  return rows;
}

}  // namespace

std::string quantities_section(const StudyReport& study) {
  if (study.quantities.empty()) return "";
  std::string options, rows;
  size_t number = 0;
  for (const auto& [quantity, series] : study.quantities) {
    options += fmt::format("<option value=\"{}\">{}</option>\n", number++, titled(quantity));
    rows += rows_of(quantity, series);
  }
  std::string head;
  for (const char* name : {"quantity", "method", "finest grid", "error bar", "extrapolated",
                           "order", "convergence", "the methods"}) {
    head += heading_cell(name);
  }
  return section(
      "quantities", "Quantities against spacing",
      "<p>Values at the end. A bar is the numerical uncertainty that a level and the two before it "
      "give (grid convergence index; on the second level with the formal order and a factor of "
      "3). The methods agree where their finest values are no further apart than the sum of their "
      "bars. Unresolved: one of them shows no order within 0.5 of its own, or its bar is wider "
      "than 5 % of the largest size of the quantity over the run of the finest level (of kinetic "
      "and "
      "strain energy and dissipations: of their sum); near or far: within, or beyond, three times "
      "what the "
      "last three levels change by, where that is below the same 5 %.</p>\n<p "
      "class=\"choice\"><label>Quantity <select "
      "id=\"quantity\">\n" +
          options + "</select></label></p>\n" +
          chart("quantity-chart", "A quantity against spacing with error bars",
                "Three levels that converge monotonically give an extrapolated value: the hollow "
                "mark at zero.") +
          table(head, rows));
}

}  // namespace diptych::report
