/// The forms that a study of refinement is written in.

#include "benchmarks/convergence/convergence.hpp"
#include "benchmarks/terminal/text.hpp"
#include "common/base/text.hpp"
#include "postprocess/report/agreement.hpp"
#include "postprocess/report/orders.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

std::string titled(const Quantity& quantity) {
  return with_unit(quantity.name, quantity.unit);
}

/// Seven digits: enough to see what the third grid changes.
constexpr const char *value_format = "{:.7g}", *order_format = "{:.2f}", *bar_format = "{:.1e}";

std::string percent(double fraction) {
  return number_text(100 * fraction, "{:.2g} %");
}

/// What stands in a row of scalars, of the finest levels.
struct ScalarRow {
  std::string finest, extrapolated = "-", order = "-", index = "-", bar = "-", remark;
};

constexpr const char* of_two_grids = "two grids";

ScalarRow row_of(const ColumnConvergence& study, const Quantity& quantity) {
  const size_t last = quantity.values.size() - 1;
  ScalarRow row;
  row.finest = number_text(quantity.values[last], value_format);
  if (const auto g = estimate(study, quantity, last)) {
    row.extrapolated = number_text(g->extrapolated, value_format);
    row.order = number_text(g->order, order_format);
    row.index = percent(g->index);
    row.bar = number_text(g->error_bar, bar_format);
    if (g->kind != report::Convergence::monotone) row.remark = report::convergence_name(g->kind);
  } else if (const double bar = error_bar(study, quantity, last); std::isfinite(bar)) {
    row.bar = number_text(bar, bar_format);
    row.index = quantity.values[last] != 0 ? percent(bar / std::abs(quantity.values[last])) : "-";
    row.remark = of_two_grids;
  }
  return row;
}

std::string csv_cell(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : quoted(text);
}
std::string csv_number(double value) {
  return number_text(value, "{:.17g}", "");
}

/// Text for LaTeX: special characters escaped, m^2 as m$^{2}$.
std::string tex(const std::string& text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '^' && i + 1 < text.size()) {
      result += fmt::format("$^{{{}}}$", text[++i]);
    } else if (c == '\\' || c == '~' || c == '^') {
      result += fmt::format("{{\\char{}}}", static_cast<int>(c));
    } else {
      if (std::string("_%&#${}").find(c) != std::string::npos) result += '\\';
      result += c;
    }
  }
  return result;
}

/// 1.2e-03 as $1.2\cdot10^{-3}$.
std::string tex_number(const std::string& text) {
  const size_t e = text.find('e');
  if (e == std::string::npos || text == "-") return text == "-" ? "--" : text;
  return fmt::format("${}\\cdot10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

std::string tex_errors(const ColumnConvergence& study) {
  std::vector<const Quantity*> columns;
  for (const Quantity& error : study.errors) {
    if (error.name.ends_with(" L2")) columns.push_back(&error);
  }
  if (columns.empty()) return "";
  std::string text = fmt::format("% {}, {}: relative L2 errors and observed orders\n",
                                 report::column_title(study.column), study.case_name);
  text += "\\begin{tabular}{rr";
  for (size_t i = 0; i < columns.size(); ++i)
    text += "rr";
  text += "}\n\\hline\n$h$ [m] & nodes";
  for (const Quantity* column : columns)
    text += " & " + tex(column->name.substr(0, column->name.size() - 9)) + " [-] & order [-]";
  text += " \\\\\n\\hline\n";
  for (size_t i = 0; i < study.levels.size(); ++i) {
    text += fmt::format("{} & {}", tex_number(fmt::format("{:.4g}", study.levels[i].spacing)),
                        study.levels[i].nodes);
    for (const Quantity* column : columns) {
      text += fmt::format(" & {} & {}", tex_number(number_text(column->values[i], "{:.2e}")),
                          tex_number(number_text(order_of_error(study, *column, i), order_format)));
    }
    text += " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n";
}

std::string tex_scalars(const ColumnConvergence& study) {
  if (study.scalars.empty()) return "";
  std::string text =
      fmt::format("% {}, {}: values at the end, extrapolated from the finest grids\n",
                  report::column_title(study.column), study.case_name);
  text +=
      "\\begin{tabular}{lrrrrrl}\n\\hline\nquantity [unit] & finest grid & extrapolated & "
      "order [-] & index [\\%] & error bar & \\\\\n\\hline\n";
  for (const Quantity& quantity : study.scalars) {
    const ScalarRow row = row_of(study, quantity);
    std::string index = row.index;
    if (index.ends_with(" %")) index.resize(index.size() - 2);
    text += fmt::format("{} & {} & {} & {} & {} & {} & {} \\\\\n", tex(titled(quantity)),
                        tex_number(row.finest), tex_number(row.extrapolated), tex_number(row.order),
                        tex_number(index), tex_number(row.bar), row.remark);
  }
  return text + "\\hline\n\\end{tabular}\n";
}

/// Of a quantity that both methods have; empty where one of them has no error bar.
std::string agreement_line(const ColumnConvergence& first,
                           const Quantity& one,
                           const ColumnConvergence& second,
                           const Quantity& other,
                           const std::map<std::string, std::string>& causes) {
  const auto side = [](const ColumnConvergence& study, const Quantity& quantity) {
    const size_t last = quantity.values.size() - 1;
    return report::ScalarOfMethod{study.column, quantity.values[last],
                                  error_bar(study, quantity, last), estimate(study, quantity, last),
                                  report::formal_order(study.levels.back())};
  };
  const report::Verdict verdict =
      report::verdict_on(side(first, one), side(second, other), std::max(one.scale, other.scale));
  if (!std::isfinite(verdict.difference + verdict.allowed)) return "";
  std::string text = report::verdict_text(verdict);
  if (verdict.agreement == report::Agreement::apart) {
    const auto cause = causes.find(one.name);
    text += cause == causes.end() ? ": the case has no [[apart]] for it" : ": " + cause->second;
  }
  return base::folded(fmt::format("{:<32} {:>10.2e} {:>10.2e}  {}\n",
                                  (one.name + " [" + one.unit + "]").substr(0, 32),
                                  verdict.difference, verdict.allowed, text),
                      56);
}

}  // namespace

std::string quantity_table(const ColumnConvergence& study) {
  if (study.scalars.empty()) return "";
  std::string text = fmt::format("{}, {}: values at the end, extrapolated from the finest levels\n",
                                 report::column_title(study.column), study.case_name);
  const auto line = [&](const std::string& name, const ScalarRow& row) {
    std::string cells =
        fmt::format("{:<33}{:>14}{:>14}{:>7}{:>10}{:>10}  {}", name.substr(0, 33), row.finest,
                    row.extrapolated, row.order, row.index, row.bar, row.remark);
    cells.erase(cells.find_last_not_of(' ') + 1);
    text += cells + "\n";
  };
  line("quantity", {"finest", "extrapolated", "order", "GCI", "error bar", ""});
  text += std::string(100, '-') + "\n";
  for (const Quantity& quantity : study.scalars)
    line(titled(quantity), row_of(study, quantity));
  if (!study.zero.empty())
    text += fmt::format("zero on every level: {}\n", fmt::join(study.zero, ", "));
  return text;
}

std::string agreement_table(const std::vector<ColumnConvergence>& columns,
                            const std::map<std::string, std::string>& causes) {
  std::vector<const ColumnConvergence*> methods;
  for (const ColumnConvergence& column : columns) {
    if (column.levels.back().variant.empty()) methods.push_back(&column);
  }
  if (methods.size() != 2) return "";
  const ColumnConvergence &first = *methods[0], &second = *methods[1];
  if (first.levels.back().level != second.levels.back().level) return "";
  std::string lines;
  for (const Quantity& one : first.scalars) {
    for (const Quantity& other : second.scalars) {
      if (other.name == one.name) lines += agreement_line(first, one, second, other, causes);
    }
  }
  if (lines.empty()) return "";
  std::string text = fmt::format("{}, {} and {} on level {}: apart, and by how much they may be\n",
                                 first.case_name, report::column_title(first.column),
                                 report::column_title(second.column), first.levels.back().level);
  text += std::string(80, '-') + "\n";
  return text + lines;
}

std::string convergence_csv(const std::vector<ColumnConvergence>& studies) {
  std::string text =
      "method,quantity,unit,level,spacing [m],nodes,steps,value,order,extrapolated,error bar,"
      "GCI,convergence\n";
  for (const ColumnConvergence& study : studies) {
    for (const auto* group : {&study.errors, &study.scalars}) {
      for (const Quantity& quantity : *group) {
        for (size_t i = 0; i < study.levels.size(); ++i) {
          const auto& run = study.levels[i];
          text += fmt::format("{},{},{},{},{:.17g},{},{},{}", csv_cell(study.column),
                              csv_cell(quantity.name), csv_cell(quantity.unit), run.level,
                              run.spacing, run.nodes, run.steps, csv_number(quantity.values[i]));
          if (quantity.is_error) {
            text += fmt::format(",{},,,,\n", csv_number(order_of_error(study, quantity, i)));
          } else if (const auto g = estimate(study, quantity, i)) {
            text += fmt::format(",{},{},{},{},{}\n", csv_number(g->order),
                                csv_number(g->extrapolated), csv_number(g->error_bar),
                                csv_number(g->index), report::convergence_name(g->kind));
          } else if (const double bar = error_bar(study, quantity, i); std::isfinite(bar)) {
            text += fmt::format(",,,{},{},{}\n", csv_number(bar),
                                csv_number(bar / std::abs(quantity.values[i])), of_two_grids);
          } else {
            text += ",,,,,\n";
          }
        }
      }
    }
  }
  return text;
}

std::string convergence_tex(const std::vector<ColumnConvergence>& studies) {
  std::string text;
  for (const ColumnConvergence& study : studies) {
    for (const std::string& part : {tex_errors(study), tex_scalars(study)}) {
      if (!part.empty()) text += (text.empty() ? "" : "\n") + part;
    }
  }
  return text;
}

}  // namespace diptych::harness
